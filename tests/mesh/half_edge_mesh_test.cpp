#include "mesh/half_edge_mesh.h"

#include <gtest/gtest.h>

#include <random>

#include "construct/star.h"
#include "effort.h"
#include "meshes.h"
#include "prohull/mesh_report.h"
#include "prohull/sample.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

/// Everything that a split must bring back.
struct Snapshot {
  std::vector<std::array<VertexId, 3>> corners;
  std::vector<HalfEdgeId> twins;
  std::vector<EdgeId> edges;
  std::vector<std::uint32_t> valences;

  bool operator==(const Snapshot&) const = default;
};

Snapshot snapshot(const HalfEdgeMesh& mesh, std::size_t vertices) {
  Snapshot all;
  for (std::uint32_t f = 0; f < mesh.face_id_count(); ++f) {
    all.corners.push_back(mesh.corners(FaceId(f)));
    if (!mesh.has(FaceId(f))) continue;
    for (std::uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
      all.twins.push_back(mesh.twin(HalfEdgeId(h)));
      all.edges.push_back(mesh.edge(HalfEdgeId(h)));
    }
  }
  for (std::uint32_t v = 0; v < vertices; ++v)
    if (mesh.has(VertexId(v))) all.valences.push_back(mesh.valence(VertexId(v)));
  return all;
}

bool may_collapse(const HalfEdgeMesh& mesh, EdgeId edge) {
  Star star;
  gather_star(mesh, edge, star);
  return satisfies_link_condition(star);
}

EdgeId edge_between(const HalfEdgeMesh& mesh, VertexId v, VertexId w) {
  HalfEdgeId h = mesh.out(v);
  while (mesh.tip(h) != w) h = mesh.rotated(h);
  return mesh.edge(h);
}

class RandomCollapses {
 public:
  explicit RandomCollapses(const TriangleMesh& original) : mesh(original), random_(test_seed()) {}

  /// Somewhere, if the link condition allows it.
  bool collapse() {
    const EdgeId edge{
        std::uniform_int_distribution<std::uint32_t>(0, static_cast<std::uint32_t>(mesh.edge_id_count()) - 1)(random_)};
    if (!mesh.has(edge) || !may_collapse(mesh, edge)) return false;
    const HalfEdgeId h = mesh.half_edge(edge);
    splits.push_back(mesh.collapse(h, mesh.position(mesh.tip(h))));
    made.push_back(VertexId(index(mesh.positions().next_id()) - 1));
    return true;
  }

  void split_last() {
    mesh.split(made.back(), splits.back());
    splits.pop_back(), made.pop_back();
  }

  HalfEdgeMesh mesh;
  std::vector<VertexSplit> splits;
  std::vector<VertexId> made;

 private:
  std::mt19937 random_;
};

void check_undoing(const TriangleMesh& original, int attempts) {
  ASSERT_TRUE(inspect(original).is_closed_manifold());
  RandomCollapses random(original);
  std::vector<Snapshot> history{snapshot(random.mesh, original.vertex_count())};
  for (int i = 0; i < attempts; ++i) {
    if (!random.collapse()) continue;
    ASSERT_EQ(first_defect(random.mesh), std::nullopt) << "after " << random.splits.size() << " collapses";
    ASSERT_EQ(random.mesh.face_count(), original.face_count() - 2 * random.splits.size());
    history.push_back(snapshot(random.mesh, original.vertex_count() + random.splits.size()));
  }
  EXPECT_GT(random.splits.size(), original.face_count() / 8);
  const MeshReport coarse = inspect(random.mesh.triangle_mesh());
  EXPECT_TRUE(coarse.is_closed_manifold()) << coarse.first_defect;
  EXPECT_EQ(coarse.euler_characteristic, inspect(original).euler_characteristic);
  while (!random.splits.empty()) {
    random.split_last();
    history.pop_back();
    ASSERT_EQ(first_defect(random.mesh), std::nullopt) << "after a split, " << random.splits.size() << " to go";
    ASSERT_EQ(snapshot(random.mesh, original.vertex_count() + random.splits.size()), history.back());
  }
  EXPECT_EQ(random.mesh.triangle_mesh(), original);
}

TEST(HalfEdgeMesh, SplitsUndoCollapsesExactly) {
  check_undoing(octahedron(), 20);
  check_undoing(sphere(3), 1500);
  check_undoing(torus(15, 10), 1500);
  check_undoing(make_sample("bracket", 800), 2500);
  check_undoing(make_sample("pony", 600), 2000);
}

TEST(HalfEdgeMesh, CollapsesAndSplitsMayAlternate) {
  const TriangleMesh original = make_sample("knot", 600);
  RandomCollapses random(original);
  std::mt19937 coin(test_seed());
  for (int i = 0; i < rounds(3000); ++i) {
    if (coin() % 3 != 0)
      random.collapse();
    else if (!random.splits.empty())
      random.split_last();
    ASSERT_EQ(first_defect(random.mesh), std::nullopt);
  }
  while (!random.splits.empty()) random.split_last();
  EXPECT_EQ(random.mesh.triangle_mesh(), original);
}

TEST(HalfEdgeMesh, RotatesCounterClockwiseSeenFromOutside) {
  const HalfEdgeMesh mesh(octahedron());
  HalfEdgeId h = mesh.out(VertexId(4));  // at (0, 0, 1)
  for (int i = 0; i < 4; ++i, h = mesh.rotated(h)) {
    const Vec3 a = mesh.position(mesh.tip(h)), b = mesh.position(mesh.tip(mesh.rotated(h)));
    EXPECT_EQ(cross(a, b), (Vec3{0, 0, 1}));
  }
  EXPECT_EQ(h, mesh.out(VertexId(4)));
  EXPECT_EQ(mesh.valence(VertexId(4)), 4u);
}

TEST(HalfEdgeMesh, ACollapseNamesWhatItReplaces) {
  HalfEdgeMesh mesh(octahedron());
  const HalfEdgeId h = mesh.half_edge(edge_between(mesh, VertexId(0), VertexId(2)));
  const VertexId o = mesh.tail(h), d = mesh.tip(h);
  const VertexSplit split = mesh.collapse(h, {2, 2, 0});
  EXPECT_EQ((std::pair{split.o, split.d}), (std::pair{o, d}));
  EXPECT_EQ(std::minmax(split.l, split.r), std::minmax(VertexId(4), VertexId(5)));
  EXPECT_EQ(mesh.face_count(), 6u);
  const VertexId s{6};
  EXPECT_EQ(mesh.position(s), (Vec3{2, 2, 0}));
  EXPECT_EQ(mesh.valence(s), 4u);
  EXPECT_EQ(mesh.valence(VertexId(4)), 3u);
  EXPECT_FALSE(mesh.has(VertexId(0)) || mesh.has(VertexId(2)));
}

TEST(HalfEdgeMesh, AFlipPutsTheOtherDiagonal) {
  HalfEdgeMesh mesh(octahedron());
  const HalfEdgeId h = mesh.half_edge(edge_between(mesh, VertexId(0), VertexId(2)));
  const VertexId o = mesh.tail(h), d = mesh.tip(h);
  const VertexId l = mesh.tail(mesh.previous(h)), r = mesh.tail(mesh.previous(mesh.twin(h)));
  ASSERT_TRUE(mesh.can_flip(h));
  mesh.flip(h);
  EXPECT_EQ(first_defect(mesh), std::nullopt);
  EXPECT_EQ((std::pair{mesh.tail(h), mesh.tip(h)}), (std::pair{r, l}));
  EXPECT_EQ((std::pair{mesh.valence(o), mesh.valence(d)}), (std::pair{3u, 3u}));
  EXPECT_EQ((std::pair{mesh.valence(l), mesh.valence(r)}), (std::pair{5u, 5u}));
  EXPECT_FALSE(mesh.can_flip(mesh.half_edge(edge_between(mesh, o, l)))) << "o would have two faces";
}

TEST(HalfEdgeMesh, FourFlipsOfAnEdgeUndoEachOtherAndAnyKeepItSound) {
  std::mt19937 random(test_seed());
  HalfEdgeMesh mesh(make_sample("bracket", 400));
  std::size_t flips = 0;
  for (int i = 0; i < rounds(500); ++i) {
    const HalfEdgeId h = mesh.half_edge(EdgeId{static_cast<std::uint32_t>(random() % mesh.edge_id_count())});
    if (!mesh.can_flip(h)) continue;
    const Snapshot before = snapshot(mesh, mesh.positions().size());
    for (int k = 0; k < 4; ++k) mesh.flip(h);
    ASSERT_EQ(snapshot(mesh, mesh.positions().size()), before);
    mesh.flip(h);
    ASSERT_EQ(first_defect(mesh), std::nullopt);
    ASSERT_TRUE(inspect(mesh.triangle_mesh()).is_closed_manifold());
    ++flips;
  }
  EXPECT_GT(flips, 0u);
}

/// Two tetrahedra whose tips lie far from each other, joined along a triangular neck 0-1-2 that is no face.
TriangleMesh two_tetrahedra_joined_by_a_neck() {
  return make({{1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}, {0, 0, 3}, {0, 0, -3}},
              {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}});
}

TEST(HalfEdgeMesh, ItsFirstDefectIsFound) {
  const TriangleMesh mesh = octahedron();
  std::vector<VertexId> corners;
  for (const auto& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  std::vector<HalfEdgeId> twins;
  const HalfEdgeMesh sound(mesh);
  for (std::uint32_t h = 0; h < corners.size(); ++h) twins.push_back(sound.twin(HalfEdgeId{h}));
  const auto defect = [&] { return first_defect(HalfEdgeMesh(mesh.positions, corners, twins)).value_or("none"); };
  EXPECT_EQ(defect(), "none");
  const HalfEdgeId twin = std::exchange(twins[0], kNoHalfEdge);
  EXPECT_EQ(defect(), "half-edge 0: has no twin");
  twins[0] = sound.next(twin);
  EXPECT_NE(defect(), "none") << "a twin of another";
  twins[0] = twin;
  std::swap(corners[0], corners[1]);
  EXPECT_NE(defect(), "none") << "a face that is turned";
  std::swap(corners[0], corners[1]);
  EXPECT_EQ(defect(), "none");

  // A collapse that the link condition forbids pinches the surface.
  HalfEdgeMesh neck(two_tetrahedra_joined_by_a_neck());
  neck.collapse(neck.half_edge(edge_between(neck, VertexId(0), VertexId(1))), {0, 0, 0});
  EXPECT_NE(first_defect(neck), std::nullopt);
}

TEST(LinkCondition, LetsAnEdgeOfAPrismCollapse) {
  HalfEdgeMesh prism(make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                          {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}}));
  EXPECT_EQ(first_defect(prism), std::nullopt);
  EXPECT_TRUE(may_collapse(prism, edge_between(prism, VertexId(0), VertexId(3))));
}

TEST(LinkCondition, NeverLetsATetrahedronCollapse) {
  const HalfEdgeMesh mesh(tetrahedron());
  for (std::uint32_t e = 0; e < 6; ++e) EXPECT_FALSE(may_collapse(mesh, EdgeId(e)));
}

TEST(LinkCondition, RefusesAnEdgeOfANeck) {
  const TriangleMesh joined = two_tetrahedra_joined_by_a_neck();
  ASSERT_TRUE(inspect(joined).is_closed_manifold());
  const HalfEdgeMesh mesh(joined);
  for (const auto& [v, w] : {std::pair{0, 1}, {1, 2}, {2, 0}})
    EXPECT_FALSE(may_collapse(mesh, edge_between(mesh, VertexId(v), VertexId(w)))) << "edge " << v << "-" << w;
  for (const int v : {0, 1, 2}) EXPECT_TRUE(may_collapse(mesh, edge_between(mesh, VertexId(v), VertexId(3))));
}

TEST(LinkCondition, RefusesAnEdgeAroundAThinHandle) {
  const TriangleMesh ring = torus(8, 3);  // a tube of triangular section
  const HalfEdgeMesh mesh(ring);
  EXPECT_FALSE(may_collapse(mesh, edge_between(mesh, VertexId(0), VertexId(1)))) << "across the tube";
  EXPECT_TRUE(may_collapse(mesh, edge_between(mesh, VertexId(0), VertexId(3)))) << "along it";
}

// The condition is exact: collapses that it refuses do break the surface, whatever the mesh.
TEST(LinkCondition, RefusesExactlyWhatWouldBreakTheSurface) {
  for (const TriangleMesh& mesh : {tetrahedron(), octahedron(), two_tetrahedra_joined_by_a_neck(), torus(3, 3),
                                   torus(8, 3), box({0, 0, 0}, {1, 1, 1}), make_sample("box", 100)}) {
    const HalfEdgeMesh half_edges(mesh);
    for (std::uint32_t e = 0; e < half_edges.edge_id_count(); ++e) {
      const HalfEdgeId h = half_edges.half_edge(EdgeId(e));
      const VertexId o = half_edges.tail(h), d = half_edges.tip(h);
      TriangleMesh collapsed;
      collapsed.positions = mesh.positions;
      for (auto t : mesh.triangles) {
        const bool goes = std::ranges::count(t, o) + std::ranges::count(t, d) == 2;
        std::ranges::replace(t, d, o);
        if (!goes) collapsed.triangles.push_back(t);
      }
      const MeshReport report = inspect(collapsed);
      EXPECT_EQ(may_collapse(half_edges, EdgeId(e)), report.is_closed_manifold() && report.faces >= 4)
          << "edge " << index(o) << "-" << index(d) << " of a mesh of " << mesh.face_count()
          << " faces: " << report.first_defect;
    }
  }
}

TEST(Star, ListsItsLinkCounterClockwiseFromL) {
  const HalfEdgeMesh mesh(octahedron());
  Star star;
  gather_star(mesh, edge_between(mesh, VertexId(0), VertexId(2)), star);
  const HalfEdgeId h = star.edge;
  ASSERT_EQ(star.link.size(), 4u);
  EXPECT_EQ(star.link[0], mesh.tip(mesh.next(h)));
  EXPECT_EQ(star.link[star.o_faces], mesh.tip(mesh.next(mesh.twin(h))));
  measure_star(mesh, star);
  ASSERT_EQ(star.planes.size(), 6u);
  for (std::size_t i = 0; i < star.planes.size(); ++i) {
    const HalfSpace plane = star.planes[i];
    EXPECT_NEAR(norm(plane.normal), 1, 1e-15);
    EXPECT_LT(dot(plane.normal, (Vec3{} - star.origin) / star.scale), plane.offset) << "the middle is inside";
  }
}

}  // namespace
}  // namespace prohull
