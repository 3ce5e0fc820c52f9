#include "paper/refined_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "effort.h"
#include "mesh/half_edge_mesh.h"
#include "meshes.h"
#include "prohull/hull_builder.h"
#include "prohull/mesh_report.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

const ProgressiveHull& torus_hull() {
  static const ProgressiveHull hull = build_hull(torus(24, 16), {.target_faces = 40}).hull;
  return hull;
}

std::shared_ptr<const RefinableHull> refinable(const ProgressiveHull& hull) {
  return std::make_shared<const RefinableHull>(hull);
}

std::vector<VertexId> made_vertices(const ProgressiveHull& hull) {
  std::vector<VertexId> made;
  for (std::size_t i = 0; i < hull.splits().size(); ++i) made.push_back(hull.made_vertex(i));
  return made;
}

std::vector<VertexId> all_corners(const RefinedHull& refined) {
  std::vector<VertexId> corners;
  for (std::uint32_t f = 0; f < refined.refinable().hull().original_face_count(); ++f)
    for (const VertexId v : refined.corners(FaceId(f))) corners.push_back(v);
  return corners;
}

/// The faces around v with their corners, from a mesh that knows its neighbours.
std::set<std::pair<FaceId, std::array<VertexId, 3>>> star(const HalfEdgeMesh& mesh, VertexId v) {
  std::set<std::pair<FaceId, std::array<VertexId, 3>>> faces;
  HalfEdgeId h = mesh.out(v);
  do {
    const FaceId f{index(h) / 3};
    faces.insert({f, mesh.corners(f)});
    h = mesh.rotated(h);
  } while (h != mesh.out(v));
  return faces;
}

/// For each split the star that its vertex has when all are made in turn.
std::vector<std::set<std::pair<FaceId, std::array<VertexId, 3>>>> stars_in_level_order(const ProgressiveHull& hull) {
  std::vector<std::set<std::pair<FaceId, std::array<VertexId, 3>>>> stars(hull.splits().size());
  HalfEdgeMesh mesh(hull.positions(), hull.base_corners());
  for (std::size_t i = hull.splits().size(); i-- > 0;) {
    stars[i] = star(mesh, hull.made_vertex(i));
    mesh.split(hull.made_vertex(i), hull.splits()[i]);
  }
  return stars;
}

TEST(RefinedHull, IsTheMeshThatSplitsInPlaceMakeInWhateverOrder) {
  const ProgressiveHull& hull = torus_hull();
  const auto stars = stars_in_level_order(hull);
  std::mt19937 random(test_seed());
  RefinedHull refined(refinable(hull));
  for (int round = 0; round < rounds(20); ++round) {
    std::vector<VertexId> order = made_vertices(hull);
    std::ranges::shuffle(order, random);
    HalfEdgeMesh mesh(hull.positions(), hull.base_corners());
    for (const VertexId made : order) {
      const bool was_split = refined.is_split(made);
      const std::size_t before = refined.splits().size(), count = refined.split(made);
      ASSERT_EQ(count == 0, was_split);
      ASSERT_TRUE(refined.is_split(made));
      ASSERT_EQ(refined.splits().size(), before + count);
      for (const VertexId s : refined.splits().subspan(before)) {
        const std::size_t i = index(s) - hull.original_vertex_count();
        ASSERT_EQ(star(mesh, s), stars[i]) << "not the star of its collapse";
        mesh.split(s, hull.splits()[i]);
      }
      ASSERT_EQ(refined.face_count(), mesh.face_count());
      if (order.size() < 100 || random() % 16 == 0) {
        ASSERT_EQ(first_defect(mesh), std::nullopt);
        for (std::uint32_t f = 0; f < hull.original_face_count(); ++f)
          ASSERT_EQ(refined.corners(FaceId(f)), mesh.corners(FaceId(f)));
        ASSERT_EQ(refined.triangle_mesh(), mesh.triangle_mesh());
      }
    }
    EXPECT_EQ(refined.triangle_mesh(), hull.original());
    refined.roll_back();
    ASSERT_EQ(all_corners(refined), hull.base_corners());
    ASSERT_EQ(refined.face_count(), hull.base_face_count());
  }
}

TEST(RefinedHull, SplitsOnlyWhatTheLinkNeeds) {
  const ProgressiveHull& hull = torus_hull();
  RefinedHull refined(refinable(hull));
  for (const VertexId made : made_vertices(hull)) {
    // Whatever is split for the sake of `made` cannot be undone before it.
    const std::size_t count = refined.split(made);
    ASSERT_EQ(refined.splits().back(), made);
    ASSERT_EQ(refined.splits().size(), count);
    for (const VertexId s : refined.splits()) EXPECT_EQ(refined.can_unsplit(s), s == made);
    refined.roll_back();
  }
}

TEST(RefinedHull, CanUndoASplitWhereTheLinkOfItsEdgeIsInPlaceAndNowhereElse) {
  const ProgressiveHull& hull = torus_hull();
  std::mt19937 random(test_seed());
  // For each split the star of its edge, when all are made in turn.
  std::vector<std::set<std::pair<FaceId, std::array<VertexId, 3>>>> stars(hull.splits().size());
  HalfEdgeMesh mesh(hull.positions(), hull.base_corners());
  for (std::size_t i = hull.splits().size(); i-- > 0;) {
    mesh.split(hull.made_vertex(i), hull.splits()[i]);
    stars[i] = star(mesh, hull.splits()[i].o);
    stars[i].merge(star(mesh, hull.splits()[i].d));
  }
  RefinedHull refined(refinable(hull));
  const std::vector<VertexId> all = made_vertices(hull);
  int can = 0, cannot = 0;
  for (int round = 0; round < rounds(300); ++round) {
    refined.split(all[random() % all.size()]);
    for (const VertexId made : all) {
      const auto& edge_star = stars[index(made) - hull.original_vertex_count()];
      const bool in_place =
          std::ranges::all_of(edge_star, [&](const auto& f) { return refined.corners(f.first) == f.second; });
      ASSERT_EQ(refined.can_unsplit(made), in_place);
      ++(in_place ? can : cannot);
    }
    if (round % 30 == 29) refined.roll_back();
  }
  EXPECT_GT(can, rounds(300));
  EXPECT_GT(cannot, rounds(300));
}

TEST(RefinedHull, UndoesSplitsInAnyOrderThatIsPossible) {
  const ProgressiveHull& hull = torus_hull();
  const std::vector<VertexId> all = made_vertices(hull);
  std::mt19937 random(test_seed());
  RefinedHull refined(refinable(hull));
  for (int step = 0; step < rounds(3000); ++step) {
    const VertexId made = all[random() % all.size()];
    if (random() % 3 == 0)
      refined.split(made);
    else if (refined.can_unsplit(made))
      refined.unsplit(made);
    if (step % 50 != 0) continue;
    // The same by the splits that are left, on a fresh mesh.
    RefinedHull fresh(refinable(hull));
    for (const VertexId s : refined.splits()) ASSERT_EQ(fresh.split(s), 1u);
    ASSERT_EQ(all_corners(refined), all_corners(fresh));
    for (const VertexId s : all) ASSERT_EQ(refined.can_unsplit(s), fresh.can_unsplit(s));
    const MeshReport report = inspect(refined.triangle_mesh());
    ASSERT_TRUE(report.is_closed_manifold()) << report.first_defect;
    ASSERT_EQ(report.euler_characteristic, 0);
  }
  refined.roll_back();
  EXPECT_EQ(all_corners(refined), hull.base_corners());
}

TEST(RefinedHull, CoarsensToWhatIsWantedAndWhatThatNeeds) {
  const ProgressiveHull& hull = torus_hull();
  const std::vector<VertexId> all = made_vertices(hull);
  std::mt19937 random(test_seed());
  for (int round = 0; round < rounds(50); ++round) {
    RefinedHull refined(refinable(hull)), wanted_alone(refinable(hull));
    for (int i = 0; i < 30; ++i) refined.split(all[random() % all.size()]);
    const std::size_t before = refined.splits().size();
    std::set<VertexId> wanted;
    for (int i = 0; i < 3; ++i) wanted.insert(refined.splits()[random() % before]);
    const std::size_t undone = refined.coarsen([&](VertexId made) { return !wanted.contains(made); });
    for (const VertexId made : wanted) wanted_alone.split(made);
    EXPECT_EQ(refined.splits().size(), before - undone);
    EXPECT_EQ(refined.splits().size(), wanted_alone.splits().size());
    EXPECT_EQ(all_corners(refined), all_corners(wanted_alone));
    refined.roll_back();
    EXPECT_EQ(all_corners(refined), hull.base_corners());
  }
}

TEST(RefinedHull, TellsFacesOfTheOriginal) {
  const ProgressiveHull& hull = torus_hull();
  const TriangleMesh original = hull.original();
  RefinedHull refined(refinable(hull));
  refined.split(hull.made_vertex(0));
  std::size_t originals = 0, others = 0;
  for (const FaceId f : original.triangles.ids()) {
    if (!refined.has(f)) continue;
    ASSERT_EQ(refined.is_original(f), refined.corners(f) == original.triangles[f]);
    ++(refined.is_original(f) ? originals : others);
  }
  EXPECT_GT(originals, 0u);
  EXPECT_GT(others, 0u);
}

TEST(RefinedHull, KeepsAWordForTheCallerWithEachFace) {
  const ProgressiveHull& hull = torus_hull();
  RefinedHull refined(refinable(hull));
  for (std::uint32_t f = 0; f < hull.original_face_count(); ++f) {
    EXPECT_EQ(refined.tag(FaceId(f)), 0u);
    refined.tag(FaceId(f)) = f;
  }
  for (const VertexId made : made_vertices(hull)) refined.split(made);
  EXPECT_EQ(refined.triangle_mesh(), hull.original());
  refined.roll_back();
  EXPECT_EQ(all_corners(refined), hull.base_corners());
  for (std::uint32_t f = 0; f < hull.original_face_count(); ++f) EXPECT_EQ(refined.tag(FaceId(f)), f);
}

TEST(RefinableHull, BoundsAreThoseOfTheFacesThatSplitsBelowComplete) {
  const ProgressiveHull& hull = torus_hull();
  std::vector<VertexId> last_split(hull.original_face_count(), ProgressiveHull::kAbsent);
  PerVertex<VertexId> parents(hull.positions().size(), ProgressiveHull::kAbsent);
  HalfEdgeMesh mesh(hull.positions(), hull.base_corners());
  for (std::size_t i = hull.splits().size(); i-- > 0;) {
    const VertexId made = hull.made_vertex(i);
    mesh.split(made, hull.splits()[i]);
    for (const VertexId end : {hull.splits()[i].o, hull.splits()[i].d}) {
      parents[end] = made;
      for (const auto& [face, corners] : star(mesh, end)) last_split[index(face)] = made;
    }
  }
  PerVertex<Box> expected(hull.positions().size());
  const TriangleMesh original = hull.original();
  for (const FaceId f : original.triangles.ids())
    for (VertexId v = last_split[index(f)]; v != ProgressiveHull::kAbsent; v = parents[v])
      for (const VertexId corner : original.triangles[f]) expected[v].extend(original.positions[corner]);
  const RefinableHull refinable(hull);
  for (const VertexId made : made_vertices(hull)) {
    EXPECT_EQ(refinable.bounds(made).min, expected[made].min);
    EXPECT_EQ(refinable.bounds(made).max, expected[made].max);
  }
}

/// Two cones over a ring of `count` vertices, of which all but three are collapsed, each into the one before.
ProgressiveHull chain_of_collapses(std::uint32_t count) {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    positions.push_back({std::cos(angle), std::sin(angle), 0});
    triangles.push_back({i, (i + 1) % count, count});
    triangles.push_back({(i + 1) % count, i, count + 1});
  }
  positions.push_back({0, 0, 1});
  positions.push_back({0, 0, -1});
  HalfEdgeMesh mesh(make(positions, triangles));
  std::vector<VertexSplit> splits;
  HalfEdgeId h{0};  // from the vertex that remains to the next in the ring
  while (mesh.face_count() > 6) {
    const HalfEdgeId onwards = mesh.rotated(mesh.rotated(mesh.twin(h)));
    splits.push_back(mesh.collapse(h, mesh.position(mesh.tail(h))));
    h = onwards;
  }
  std::vector<VertexId> corners;
  for (std::uint32_t f = 0; f < mesh.face_id_count(); ++f)
    for (const VertexId v : mesh.corners(FaceId(f))) corners.push_back(v);
  return ProgressiveHull(HullSide::Outer, count + 2, mesh.positions(), corners, splits);
}

TEST(RefinedHull, FollowsLongChainsWithoutRecursion) {
  const ProgressiveHull hull = chain_of_collapses(static_cast<std::uint32_t>(rounds(200000)));
  ASSERT_EQ(first_defect(hull), std::nullopt);
  RefinedHull refined(refinable(hull));
  EXPECT_EQ(refined.split(hull.made_vertex(0)), hull.splits().size());
  EXPECT_EQ(refined.triangle_mesh(), hull.original());
  EXPECT_EQ(refined.coarsen([](VertexId) { return true; }), hull.splits().size());
  EXPECT_EQ(all_corners(refined), hull.base_corners());
}

TEST(RefinedHull, OfAMeshThatIsNotSimplifiedIsThatMesh) {
  const ProgressiveHull hull = torus_hull().with_base(1000000);
  ASSERT_TRUE(hull.splits().empty());
  RefinedHull refined(refinable(hull));
  EXPECT_EQ(refined.triangle_mesh(), hull.original());
  refined.roll_back();
  EXPECT_EQ(refined.triangle_mesh(), hull.original());
  EXPECT_TRUE(refined.is_original(FaceId{0}));
}

TEST(RefinedHull, TakesNoMoreMemoryHoweverOftenItIsRefined) {
  const ProgressiveHull& hull = torus_hull();
  const std::vector<VertexId> all = made_vertices(hull);
  RefinedHull refined(refinable(hull));
  for (const VertexId made : all) refined.split(made);
  const std::size_t memory = refined.memory_bytes();
  std::mt19937 random(test_seed());
  for (int i = 0; i < rounds(1000); ++i) {
    for (int k = 0; k < 10; ++k) refined.split(all[random() % all.size()]);
    refined.coarsen([&](VertexId) { return random() % 4 != 0; });
  }
  EXPECT_LE(refined.memory_bytes(), memory + 1000);
}

}  // namespace
}  // namespace prohull
