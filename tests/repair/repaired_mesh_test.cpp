#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "meshes.h"
#include "prohull/error.h"
#include "prohull/repair.h"
#include "prohull/sample.h"

namespace prohull {
namespace {

using namespace meshes;

const TriangleMesh kBox = box({0, 0, 0}, {4, 4, 4});
const TriangleMesh kSmallBox = box({1, 1, 1}, {2, 2, 2});

/// Without the faces that lie at the lowest and highest z.
TriangleMesh without_ends(const TriangleMesh& mesh) {
  TriangleMesh result{mesh.positions, {}};
  for (const FaceId f : mesh.triangles.ids())
    if (const Triangle t = mesh.triangle(f); t.a.z != t.b.z || t.b.z != t.c.z)
      result.triangles.push_back(mesh.triangles[f]);
  return result;
}

/// The boundary of unit cubes at these integer corners, on welded vertices: an edge at which two of them meet
/// diagonally has four faces.
TriangleMesh cubes(const std::vector<Vec3>& corners) {
  TriangleMesh all;
  for (const Vec3& p : corners)
    for (const auto& [normal, u, v] : {std::array<Vec3, 3>{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                       {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}},
                                       {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}})
      for (const bool is_far : {false, true}) {
        if (std::ranges::find(corners, is_far ? p + normal : p - normal) != corners.end()) continue;
        const Vec3 a = is_far ? p + normal : p;
        const Vec3 b = a + (is_far ? u : v), d = a + (is_far ? v : u);
        std::array<VertexId, 4> square{};
        const std::array points{a, b, a + u + v, d};
        for (std::size_t i = 0; i < 4; ++i) square[i] = all.positions.push_back(points[i]);
        all.triangles.push_back({square[0], square[1], square[2]});
        all.triangles.push_back({square[0], square[2], square[3]});
      }
  return all;
}

// Below, a floor joins the two cubes that meet in an edge, so that the faces there form fans that leave it open.
TEST(RepairedMesh, PairsFacesOfAnEdgeOfFourByWedges) {
  const RepairedMesh repaired = repaired_mesh(cubes({{0, 0, 0}, {1, 1, 0}, {0, 0, -1}, {1, 0, -1}, {1, 1, -1}}), {});
  ASSERT_TRUE(repaired.closed) << repaired.obstacle;
  EXPECT_EQ(repaired.caps.face_count(), 0u);
  EXPECT_DOUBLE_EQ(signed_volume(repaired.closed->mesh), 5);
}

// A floor and a ceiling join the second two cubes: their wedges share both ends. The first two ask for wedges.
TEST(RepairedMesh, SeparatesWedgesThatShareBothEndsOfAnEdge) {
  const std::vector<Vec3> floor{{0, 0, 0}, {1, 1, 0}, {0, 0, -1}, {1, 0, -1}, {1, 1, -1}};
  std::vector<Vec3> corners = floor;
  for (const Vec3& p : floor) corners.push_back(p + Vec3{9, 0, 0});
  for (const Vec3& p : {Vec3{9, 0, 1}, {10, 0, 1}, {10, 1, 1}}) corners.push_back(p);
  const TriangleMesh mesh = cubes(corners);
  const RepairedMesh repaired = repaired_mesh(mesh, {});
  ASSERT_TRUE(repaired.closed) << repaired.obstacle;
  EXPECT_EQ(repaired.caps.face_count(), 0u);
  EXPECT_EQ(repaired.closed->mesh.face_count(), mesh.face_count() + 2) << "two faces without area";
  EXPECT_DOUBLE_EQ(signed_volume(repaired.closed->mesh), 13);
}

TEST(RepairedMesh, LeavesASoundMeshAlone) {
  for (const TriangleMesh& mesh : {kBox, torus(9, 5), together(kBox, moved(kBox, {9, 0, 0}))}) {
    const RepairedMesh repaired = repaired_mesh(mesh);
    ASSERT_TRUE(repaired.closed);
    EXPECT_EQ(repaired.closed->mesh, mesh);
    EXPECT_EQ(repaired.original, mesh);
    EXPECT_EQ(repaired.dropped.face_count(), 0u);
    EXPECT_FALSE(repaired.repairs.any());
    EXPECT_TRUE(repaired.obstacle.empty());
  }
}

TEST(RepairedMesh, DropsFacesThatAreNotFinite) {
  TriangleMesh mesh = kBox;
  const VertexId nowhere = mesh.positions.push_back({0, std::numeric_limits<double>::infinity(), 0});
  mesh.triangles.push_back({VertexId(0), VertexId(1), nowhere});
  const RepairedMesh repaired = repaired_mesh(mesh);
  ASSERT_TRUE(repaired.closed);
  EXPECT_EQ(repaired.repairs.dropped_non_finite_faces, 1u);
  EXPECT_EQ(repaired.original.face_count(), 12u);
  EXPECT_EQ(describe(repaired.repairs), std::vector<std::string>{"dropped 1 face with a corner that is not finite"});
  for (Vec3& p : mesh.positions) p.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(repaired_mesh(mesh), InputError);
  EXPECT_THROW(repaired_mesh({}), InputError);
}

TEST(RepairedMesh, DropsDuplicates) {
  TriangleMesh mesh = kBox;
  const auto [a, b, c] = mesh.triangles[FaceId(4)];
  mesh.triangles.push_back({b, c, a});
  const RepairedMesh repaired = repaired_mesh(mesh);
  ASSERT_TRUE(repaired.closed);
  EXPECT_EQ(repaired.closed->mesh, kBox);
  EXPECT_EQ(repaired.repairs.dropped_duplicate_faces, 1u);
  EXPECT_EQ(repaired.dropped.face_count(), 0u) << "its twin is there";
}

TEST(RepairedMesh, TurnsSingleFaces) {
  TriangleMesh mesh = make_sample("knot", 600);
  for (std::uint32_t f = 0; f < mesh.face_count(); f += 3)
    std::swap(mesh.triangles[FaceId(f)][1], mesh.triangles[FaceId(f)][2]);
  const RepairedMesh repaired = repaired_mesh(soup(mesh));
  ASSERT_TRUE(repaired.closed) << repaired.obstacle;
  EXPECT_EQ(repaired.repairs.turned_single_faces, (mesh.face_count() + 2) / 3);
  EXPECT_DOUBLE_EQ(repaired.closed->report.volume, signed_volume(make_sample("knot", 600)));
  EXPECT_EQ(repaired.dropped.face_count(), 0u);
}

TEST(RepairedMesh, FillsWhatCrossesOthersIfAskedTo) {
  const TriangleMesh bar = inside_out(box({-0.5, -0.5, -1.5}, {0.5, 0.5, 1.5}));
  TriangleMesh crossed = together(box({-1, -1, -1}, {1, 1, 1}), bar);
  EXPECT_FALSE(repaired_mesh(crossed, {.fill_crossing = true}).closed) << "the bar is a hole";
  crossed.triangles.pop_back();
  EXPECT_FALSE(repaired_mesh(crossed).closed);
  const RepairedMesh filled = repaired_mesh(crossed, {.fill_crossing = true});
  ASSERT_TRUE(filled.closed);
  EXPECT_DOUBLE_EQ(filled.closed->report.volume, 8 + 3);
  EXPECT_EQ(describe(filled.repairs).back(),
            "counted 1 component that is inside out and crosses or repeats others as solid (12 faces)");
}

TEST(RepairedMesh, SplitsVerticesWherePartsMeet) {
  const TriangleMesh touching = soup(together(kSmallBox, box({2, 2, 2}, {3, 3, 3})));
  const RepairedMesh repaired = repaired_mesh(touching);
  ASSERT_TRUE(repaired.closed) << repaired.obstacle;
  EXPECT_EQ(repaired.repairs.split_vertices, 1u);
  EXPECT_EQ(repaired.closed->report.components, 2u);
  EXPECT_DOUBLE_EQ(repaired.closed->report.volume, 2);
}

TEST(RepairedMesh, CountsAVertexOnceThatThreePartsShare) {
  const TriangleMesh two = together(kSmallBox, box({2, 2, 2}, {3, 3, 3}));
  const TriangleMesh third = tetrahedron({2, 2, 2}, {3, 1, 3}, {3, 1.5, 3}, {2.5, 1, 3});
  const RepairedMesh repaired = repaired_mesh(soup(together(two, third)));
  ASSERT_TRUE(repaired.closed) << repaired.obstacle;
  EXPECT_EQ(repaired.repairs.split_vertices, 1u);
  EXPECT_EQ(repaired.closed->report.components, 3u);
}

TEST(RepairedMesh, LeavesNoVertexThatIsNotFinite) {
  TriangleMesh mesh = kSmallBox;
  const VertexId nan = mesh.positions.push_back({std::nan(""), 0, 0});
  mesh.triangles.push_back({mesh.triangles[FaceId(0)][0], mesh.triangles[FaceId(0)][1], nan});
  const RepairedMesh repaired = repaired_mesh(mesh);
  EXPECT_EQ(repaired.original, kSmallBox);
  EXPECT_EQ(describe(repaired.repairs), std::vector<std::string>{"dropped 1 face with a corner that is not finite"});
}

TEST(RepairedMesh, DropsWhatLiesInsideOfOthers) {
  const TriangleMesh cavity = inside_out(box({0.5, 0.5, 0.5}, {3.5, 3.5, 3.5}));
  const TriangleMesh matryoshka = together(together(kBox, cavity), kSmallBox);
  const RepairedMesh repaired = repaired_mesh(matryoshka);
  ASSERT_TRUE(repaired.closed);
  EXPECT_EQ(repaired.repairs.dropped_components, 2u);
  EXPECT_EQ(repaired.repairs.dropped_component_faces, 24u);
  EXPECT_EQ(repaired.dropped.face_count(), 24u);
  EXPECT_DOUBLE_EQ(repaired.closed->report.volume, 64);
  EXPECT_EQ(repaired.original, matryoshka);
  EXPECT_EQ(repaired_mesh(matryoshka, {.keep_cavities = true}).closed->mesh, matryoshka);
}

TEST(RepairedMesh, KeepsWhatOnlyTouchesOrSticksOut) {
  for (const TriangleMesh& other : {box({0, 0, 0}, {1, 1, 1}), box({1, 1, 1}, {4, 2, 2}), box({3, 1, 1}, {5, 2, 2}),
                                    moved(kBox, {5, 0, 0}), kBox}) {
    const RepairedMesh repaired = repaired_mesh(together(kBox, other));
    ASSERT_TRUE(repaired.closed) << repaired.obstacle;
    EXPECT_EQ(repaired.repairs.dropped_components, 0u);
  }
}

TEST(RepairedMesh, ClosesOpenings) {
  TriangleMesh open = kBox;
  open.triangles.pop_back();
  const RepairedMesh repaired = repaired_mesh(open);
  ASSERT_TRUE(repaired.closed) << repaired.obstacle;
  EXPECT_EQ(repaired.original, open) << "the caps are apart";
  EXPECT_EQ(repaired.caps.face_count(), 1u);
  EXPECT_DOUBLE_EQ(repaired.closed->report.volume, 64);
  EXPECT_EQ(repaired.repairs.closed_openings, 1u);
  EXPECT_DOUBLE_EQ(repaired.repairs.largest_opening, std::sqrt(32));
  EXPECT_EQ(describe(repaired.repairs), std::vector<std::string>{"closed 1 opening, 5.657 across"});
}

TEST(RepairedMesh, ClosesEachOpeningOfATube) {
  const TriangleMesh tube = without_ends(box({0, 0, 0}, {1, 1, 3}));
  const RepairedMesh repaired = repaired_mesh(tube);
  ASSERT_TRUE(repaired.closed) << repaired.obstacle;
  EXPECT_DOUBLE_EQ(repaired.closed->report.volume, 3);
  EXPECT_EQ(repaired.repairs.closed_openings, 2u);
  EXPECT_EQ(describe(repaired.repairs), std::vector<std::string>{"closed 2 openings, the largest 1.414 across"});
}

TEST(RepairedMesh, KeepsOpeningsIfAskedTo) {
  const TriangleMesh tube = without_ends(box({0, 0, 0}, {1, 1, 3}));
  const RepairedMesh repaired = repaired_mesh(tube, {.open_shells = OpenShells::Keep});
  EXPECT_FALSE(repaired.closed);
  EXPECT_EQ(repaired.repairs.closed_openings, 0u);
  EXPECT_EQ(repaired.caps.face_count(), 0u);
}

// A leaf, a bedsheet: a cap as large as the sheet itself would close nothing that anybody sees as closed.
TEST(RepairedMesh, LeavesASheetASheet) {
  const TriangleMesh leaf = make({{0, 0, 0}, {1, -0.5, 0.1}, {2, 0, 0}, {1, 0.5, 0.1}, {1, 0, 0}},
                                 {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  const RepairedMesh repaired = repaired_mesh(leaf);
  EXPECT_FALSE(repaired.closed);
  EXPECT_EQ(repaired.caps.face_count(), 0u);
  EXPECT_EQ(repaired.repairs.closed_openings, 0u);
}

// A small sheet beside a part with an opening does not keep that from being closed.
TEST(RepairedMesh, ClosesTheOpeningsOfPartsBesideASmallSheet) {
  const TriangleMesh tube = without_ends(box({0, 0, 0}, {1, 1, 3}));
  const TriangleMesh label = make({{5, 0, 0}, {5, 0.2, 0}, {5, 0, 0.2}}, {{0, 1, 2}});
  EXPECT_EQ(repaired_mesh(together(tube, label)).caps.face_count(), 5u) << "the label gets a back";
}

TEST(RepairedMesh, TellsWhatIsLeftToDo) {
  TriangleMesh open = kBox;
  open.triangles.pop_back();
  const RepairedMesh repaired = repaired_mesh(open, {.open_shells = OpenShells::Keep});
  EXPECT_FALSE(repaired.closed);
  EXPECT_EQ(repaired.caps.face_count(), 0u);
  EXPECT_EQ(repaired.original, open);
  EXPECT_EQ(repaired.obstacle, "edge 1-5 has 1 face, expected 2 (in all: 3 open edges)");
  EXPECT_FALSE(repaired_mesh(make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}})).closed)
      << "closed, but without volume";
  EXPECT_FALSE(repaired_mesh(make({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}, {{0, 1, 2}})).closed);
}

}  // namespace
}  // namespace prohull
