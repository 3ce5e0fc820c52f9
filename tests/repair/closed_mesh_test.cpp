#include <gtest/gtest.h>

#include <limits>
#include <string_view>

#include "input_error.h"
#include "meshes.h"
#include "prohull/error.h"
#include "prohull/repair.h"
#include "prohull/sample.h"

namespace prohull {
namespace {

using namespace meshes;

const TriangleMesh kBox = box({0, 0, 0}, {4, 4, 4});
const TriangleMesh kSmallBox = box({1, 1, 1}, {2, 2, 2});

/// What closed_mesh says of a mesh that it refuses.
Defect defect_of(const TriangleMesh& mesh) {
  const InputError error = error_of([&] { closed_mesh(mesh); });
  EXPECT_STRNE(error.what(), "");
  return error.defect();
}

TEST(ClosedMesh, LeavesASoundMeshAlone) {
  for (const TriangleMesh& mesh : {kBox, octahedron(), torus(9, 5), make_sample("bracket", 1000)}) {
    const ClosedMesh closed = closed_mesh(mesh);
    EXPECT_EQ(closed.mesh, mesh);
    EXPECT_FALSE(closed.repairs.any());
    EXPECT_TRUE(describe(closed.repairs).empty());
    EXPECT_TRUE(closed.report.is_closed_manifold());
  }
}

TEST(ClosedMesh, WeldsASoup) {
  const ClosedMesh closed = closed_mesh(soup(kBox));
  EXPECT_EQ(closed.repairs.welded_vertices, 36u - 8);
  EXPECT_EQ(closed.repairs.dropped_faces, 0u);
  EXPECT_EQ(closed.report.vertices, 8u);
  EXPECT_EQ(closed.mesh.face_count(), 12u);
  EXPECT_DOUBLE_EQ(closed.report.volume, 64);
  EXPECT_EQ(describe(closed.repairs), std::vector<std::string>{"welded 28 vertices at equal positions"});
}

TEST(ClosedMesh, WeldsMinusZeroToZero) {
  TriangleMesh mesh = soup(kBox);
  for (const VertexId v : mesh.positions.ids())
    if (index(v) % 2 == 0)
      for (int i = 0; i < 3; ++i)
        if (mesh.positions[v][i] == 0) mesh.positions[v][i] = -0.0;
  EXPECT_EQ(closed_mesh(mesh).repairs.welded_vertices, 28u);
}

TEST(ClosedMesh, WeldsOnlyWhatIsNotClosedWithout) {
  // Two boxes that touch in a corner: welding would make it a bow-tie.
  const TriangleMesh touching = together(kSmallBox, box({2, 2, 2}, {3, 3, 3}));
  const ClosedMesh closed = closed_mesh(touching);
  EXPECT_EQ(closed.mesh, touching);
  EXPECT_EQ(defect_of(soup(touching)), Defect::NonManifoldVertex);
}

TEST(ClosedMesh, DropsFacesWithAVertexTwice) {
  TriangleMesh mesh = octahedron();
  mesh.triangles.push_back({VertexId(0), VertexId(2), VertexId(2)});
  const ClosedMesh closed = closed_mesh(mesh);
  EXPECT_EQ(closed.repairs.dropped_faces, 1u);
  EXPECT_EQ(closed.mesh, octahedron());
}

TEST(ClosedMesh, DropsFacesThatWeldingCollapses) {
  // Edge 0-1 of a soup, split by a needle whose third corner is a copy of 1.
  TriangleMesh mesh = soup(tetrahedron());
  mesh.triangles.push_back(
      {mesh.positions.push_back({0, 0, 0}), mesh.positions.push_back({1, 0, 0}), mesh.positions.push_back({1, 0, 0})});
  const ClosedMesh closed = closed_mesh(mesh);
  EXPECT_EQ(closed.repairs.dropped_faces, 1u);
  EXPECT_EQ(closed.report.faces, 4u);
}

TEST(ClosedMesh, TurnsAMeshThatIsInsideOut) {
  const ClosedMesh closed = closed_mesh(inside_out(torus(9, 5)));
  EXPECT_EQ(closed.mesh, torus(9, 5));
  EXPECT_EQ(closed.repairs.turned_components, 1u);
  EXPECT_EQ(closed.repairs.turned_faces, 90u);
  EXPECT_GT(closed.report.volume, 0);
  EXPECT_EQ(describe(closed.repairs), std::vector<std::string>{"turned 1 component that was inside out (90 faces)"});
}

TEST(ClosedMesh, TurnsTheComponentThatIsInsideOut) {
  const TriangleMesh beside = moved(octahedron(), {20, 0, 0});
  for (const bool big_one_is_wrong : {false, true}) {
    const TriangleMesh mesh =
        big_one_is_wrong ? together(inside_out(kBox), beside) : together(kBox, inside_out(beside));
    const ClosedMesh closed = closed_mesh(mesh);
    EXPECT_EQ(closed.mesh, together(kBox, beside));
    EXPECT_EQ(closed.repairs.turned_components, 1u);
    EXPECT_EQ(closed.repairs.turned_faces, big_one_is_wrong ? 12u : 8u);
    EXPECT_DOUBLE_EQ(closed.report.volume, 64 + 4.0 / 3);
  }
}

TEST(ClosedMesh, KeepsACavity) {
  const TriangleMesh hollow = together(kBox, inside_out(kSmallBox));
  const ClosedMesh closed = closed_mesh(hollow);
  EXPECT_EQ(closed.mesh, hollow);
  EXPECT_FALSE(closed.repairs.any());
  EXPECT_DOUBLE_EQ(closed.report.volume, 63);
}

TEST(ClosedMesh, TurnsAComponentThatIsInsideOutAndTouchesAnother) {
  for (const Vec3& min : {Vec3{0.25, 0.25, 1}, Vec3{1, 0, 0}, Vec3{-0.5, 0.25, 1}}) {
    const TriangleMesh on_it = inside_out(box(min, min + Vec3{0.5, 0.5, 0.5}));
    const ClosedMesh closed = closed_mesh(together(box({0, 0, 0}, {1, 1, 1}), on_it));
    EXPECT_EQ(closed.repairs.turned_components, 1u) << min.x;
  }
}

TEST(ClosedMesh, RefusesAComponentThatIsInsideOutAndCrossesAnother) {
  const TriangleMesh cube = box({-1, -1, -1}, {1, 1, 1});
  // All corners of the bars lie outside of the cube, or on it. Two sides of the second bar lie in sides of the cube.
  // Two edges of the third one pass through the diagonals of two sides of the cube.
  for (const TriangleMesh& bar : {box({-0.5, -0.5, -1.5}, {0.5, 0.5, 1.5}), box({-1, -0.5, -1.5}, {1, 0.5, 1.5}),
                                  box({-0.25, -0.25, -1.5}, {0.25, 0.25, 1.5})})
    EXPECT_THROW(closed_mesh(together(cube, inside_out(bar))), InputError);
  EXPECT_THROW(closed_mesh(together(cube, inside_out(cube))), InputError) << "it repeats the other";
  const TriangleMesh larger = inside_out(box({-0.5, -0.5, -9}, {0.5, 0.5, 9}));
  const std::string refusal = error_of([&] { closed_mesh(together(cube, larger)); }).what();
  EXPECT_TRUE(refusal.starts_with("the component of face 0 looks outwards")) << refusal;
}

/// Squares about the z axis, from the highest to the lowest, joined to a closed mesh.
struct Square {
  double half_side, z;
};
TriangleMesh lofted(const std::vector<Square>& squares) {
  std::vector<Vec3> positions;
  for (const auto& [h, z] : squares)
    positions.insert(positions.end(), {{h, h, z}, {-h, h, z}, {-h, -h, z}, {h, -h, z}});
  std::vector<std::array<std::uint32_t, 3>> faces{{0, 1, 2}, {0, 2, 3}};
  for (std::uint32_t upper = 0; upper + 4 < positions.size(); upper += 4)
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t a = upper + k, b = upper + (k + 1) % 4;
      faces.push_back({a + 4, b + 4, b});
      faces.push_back({a + 4, b, a});
    }
  const auto last = static_cast<std::uint32_t>(positions.size() - 4);
  faces.push_back({last, last + 2, last + 1});
  faces.push_back({last, last + 3, last + 2});
  return make(positions, faces);
}

TEST(ClosedMesh, RefusesAComponentThatIsInsideOutAndCrossesAnotherAtSharedEdges) {
  const TriangleMesh cube = lofted({{0.5, 1}, {1, 1}, {1, -1}, {0.5, -1}});
  const TriangleMesh bar = lofted({{0.5, 1.5}, {0.5, 1}, {0.5, -1}, {0.5, -1.5}});
  EXPECT_NO_THROW(closed_mesh(together(cube, bar)));
  EXPECT_THROW(closed_mesh(together(cube, inside_out(bar))), InputError);
}

TEST(ClosedMesh, KeepsTheCavityOfAMeshThatIsInsideOut) {
  const TriangleMesh hollow = together(kBox, inside_out(kSmallBox));
  const ClosedMesh closed = closed_mesh(inside_out(hollow));
  EXPECT_EQ(closed.mesh, hollow);
  EXPECT_EQ(closed.repairs.turned_components, 2u);
  EXPECT_EQ(closed.repairs.turned_faces, 24u);
}

TEST(ClosedMesh, KeepsASolidInsideACavity) {
  const TriangleMesh matryoshka =
      together(together(kBox, inside_out(box({0.5, 0.5, 0.5}, {3.5, 3.5, 3.5}))), kSmallBox);
  EXPECT_EQ(closed_mesh(matryoshka).mesh, matryoshka);
  EXPECT_EQ(closed_mesh(inside_out(matryoshka)).mesh, matryoshka);
}

TEST(ClosedMesh, KeepsASolidInsideASolid) {
  const TriangleMesh twice = together(kBox, kSmallBox);
  EXPECT_EQ(closed_mesh(twice).mesh, twice) << "covered twice, as it came";
}

TEST(ClosedMesh, RefusesWhatItCannotClose) {
  TriangleMesh open = kBox;
  open.triangles.pop_back();
  EXPECT_EQ(defect_of(open), Defect::OpenEdge);

  TriangleMesh twisted = kBox;
  std::swap(twisted.triangles[FaceId(3)][0], twisted.triangles[FaceId(3)][1]);
  EXPECT_EQ(defect_of(twisted), Defect::InconsistentOrientation);

  TriangleMesh fin = together(tetrahedron(), tetrahedron({0, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}));
  EXPECT_EQ(closed_mesh(fin).mesh, fin) << "on its own, each is closed";
  EXPECT_EQ(defect_of(soup(fin)), Defect::NonManifoldEdge) << "welded they share an edge";

  TriangleMesh bow_tie = together(tetrahedron(), moved(tetrahedron(), {5, 0, 0}));
  for (auto& t : bow_tie.triangles) std::ranges::replace(t, VertexId(4), VertexId(0));
  EXPECT_EQ(defect_of(bow_tie), Defect::NonManifoldVertex);

  EXPECT_EQ(defect_of({}), Defect::EmptyMesh);
  EXPECT_EQ(defect_of(make({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}, {{0, 1, 2}})), Defect::EmptyMesh)
      << "nothing is left after welding";
}

TEST(ClosedMesh, NamesTheFirstOffenderAndCountsTheRest) {
  TriangleMesh open = octahedron();
  open.triangles.pop_back();
  const std::string refusal = error_of([&] { closed_mesh(open); }).what();
  EXPECT_TRUE(refusal.starts_with("edge 0-3 has 1 face, expected 2")) << refusal;
  EXPECT_NE(refusal.find("3 open edges"), std::string::npos) << refusal;
}

TEST(ClosedMesh, RefusesCoordinatesThatAreNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    TriangleMesh mesh = soup(kBox);
    mesh.positions[VertexId(5)].z = bad;
    EXPECT_EQ(defect_of(mesh), Defect::NonFiniteCoordinate);
    mesh = kBox;
    mesh.positions.push_back({bad, 0, 0});
    EXPECT_EQ(closed_mesh(mesh).mesh.face_count(), 12u) << "a vertex that no face uses does no harm";
  }
}

TEST(ClosedMesh, TakesLargeAndSmallButNotHugeAndTiny) {
  for (const double scale : {1e-90, 1e-30, 1e30, 1e90})
    EXPECT_GT(closed_mesh(scaled(soup(kBox), scale)).report.volume, 0) << scale;
  EXPECT_EQ(defect_of(scaled(kBox, 1e200)), Defect::NonFiniteCoordinate);
  EXPECT_EQ(defect_of(scaled(kBox, 1e300)), Defect::NonFiniteCoordinate);
  EXPECT_EQ(defect_of(scaled(kBox, 1e-200)), Defect::NoVolume);
}

TEST(ClosedMesh, RefusesWhatEnclosesNothing) {
  const TriangleMesh flat = make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
  EXPECT_EQ(defect_of(flat), Defect::NoVolume);
  EXPECT_EQ(defect_of(tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0})), Defect::NoVolume);
  EXPECT_EQ(defect_of(scaled(kBox, 0)), Defect::NoVolume);
}

}  // namespace
}  // namespace prohull
