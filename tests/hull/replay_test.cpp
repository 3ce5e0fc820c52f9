#include "prohull/detail/replay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "effort.h"
#include "geometry/predicates.h"
#include "hull/parts.h"
#include "mesh/half_edge_mesh.h"
#include "meshes.h"
#include "progress.h"
#include "prohull/enclosure.h"
#include "prohull/hull_builder.h"
#include "prohull/sample.h"
#include "prohull/verification.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

TriangleMesh original() { return make_sample("asteroid", 600); }

ProgressiveHull hull_of(const TriangleMesh& mesh, HullSide side = HullSide::Outer) {
  return build_hull(mesh, {.target_faces = mesh.face_count() / 4, .side = side}).hull;
}

/// The definition: with the finer mesh in place, does the vertex lie on the right side of every face that replaces its
/// star? For all splits, through the mesh's own half-edges.
bool proves_enclosure(const ProgressiveHull& hull) {
  const Side wrong = hull.side() == HullSide::Outer ? Side::Inside : Side::Outside;
  HalfEdgeMesh mesh(hull.positions(), hull.base_corners());
  for (std::size_t i = hull.splits().size(); i-- > 0;) {
    const VertexSplit& split = hull.splits()[i];
    mesh.split(hull.made_vertex(i), split);
    for (const VertexId end : {split.o, split.d}) {
      HalfEdgeId h = mesh.out(end);
      do {
        const Vec3 &a = mesh.position(end), &b = mesh.position(mesh.tip(h)), &c = mesh.position(mesh.tip(mesh.next(h)));
        if (exact_side(a, b, c, mesh.position(hull.made_vertex(i))) == wrong) return false;
        h = mesh.rotated(h);
      } while (h != mesh.out(end));
    }
  }
  return true;
}

TEST(Replay, HoldsForHullsOfBothSides) {
  for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
    const TriangleMesh mesh = original();
    const ProgressiveHull hull = hull_of(mesh, side);
    const ReplayReport report = verify_replay(hull, mesh);
    EXPECT_TRUE(report.holds) << report.why_not;
    EXPECT_EQ(report.why_not, "");
    EXPECT_EQ(report.splits, hull.splits().size());
    EXPECT_GE(report.signs, 5 * report.splits) << "a star has at least five faces";
  }
}

// Hundreds of hulls, each with one apex moved to about where it becomes wrong; truth by exact signs.
TEST(Replay, AgreesWithExactSignsOnApexesMovedAcrossATightPlane) {
  const TriangleMesh mesh = original();
  std::mt19937 random(test_seed());
  for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
    const ProgressiveHull hull = hull_of(mesh, side);
    int wrong = 0, right = 0;
    for (int i = 0; i < rounds(400); ++i) {
      HullParts parts = parts_of(hull);
      const std::size_t step = random() % parts.splits.size();
      Vec3& apex = parts.positions[hull.made_vertex(step)];
      // Onto a plane of the star that it replaces: a convex combination of the corners of a face of that star.
      HalfEdgeMesh finer(parts.positions, parts.corners);
      for (std::size_t k = parts.splits.size(); k-- > step;) finer.split(hull.made_vertex(k), parts.splits[k]);
      const auto face = finer.corners(FaceId{parts.splits[step].od / 3});
      const Vec3 a = finer.position(face[0]), b = finer.position(face[1]), c = finer.position(face[2]);
      const Vec3 normal = cross(b - a, c - a) / norm(cross(b - a, c - a));
      apex = apex - normal * dot(normal, apex - a);
      for (int axis = 0; axis < 3; ++axis)
        for (int ulps = static_cast<int>(random() % 3); ulps > 0; --ulps)
          apex[axis] = std::nextafter(apex[axis], random() % 2 ? 1e9 : -1e9);
      const ProgressiveHull mutant = parts.joined();
      const bool truth = proves_enclosure(mutant);
      const ReplayReport report = verify_replay(mutant, mesh);
      ASSERT_EQ(report.holds, truth) << "split " << step << ": " << report.why_not;
      ++(truth ? right : wrong);
    }
    EXPECT_GT(wrong, rounds(50));
  }
}

TEST(Replay, TellsOneUlpBelowATightPlane) {
  // A box whose top is a flat fan around two inner vertices; the apex lies exactly in the top.
  const TriangleMesh mesh = subdivided(subdivided(box({0, 0, 0}, {1, 1, 1})));
  for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
    SCOPED_TRACE(int(side));
    const ProgressiveHull hull = build_hull(mesh, {.target_faces = 150, .side = side}).hull;
    ASSERT_TRUE(verify_replay(hull, mesh).holds);
    int tested = 0;
    for (std::size_t i = 0; i < hull.splits().size(); ++i) {
      HullParts parts = parts_of(hull);
      Vec3& apex = parts.positions[hull.made_vertex(i)];
      if (apex.z != 1) continue;
      ++tested;
      apex.z = std::nextafter(1.0, side == HullSide::Outer ? 0.0 : 2.0);
      EXPECT_FALSE(verify_replay(parts.joined(), mesh).holds) << "split " << i;
    }
    EXPECT_GT(tested, 0);
  }
}

TEST(Replay, RejectsAnyChangeOfASplit) {
  const TriangleMesh mesh = original();
  const ProgressiveHull hull = hull_of(mesh);
  const auto reject = [&](std::size_t i, const char* what, auto&& change) {
    HullParts parts = parts_of(hull);
    change(parts.splits[i]);
    EXPECT_FALSE(verify_replay(parts.joined(), mesh).holds) << "split " << i << ": " << what;
  };
  for (std::size_t i = 0; i<hull.splits().size(); i += rounds(10)> 9 ? 7 : 40) {
    reject(i, "l and r", [](VertexSplit& s) { std::swap(s.l, s.r); });
    reject(i, "o and d", [](VertexSplit& s) { std::swap(s.o, s.d); });
    reject(i, "r is l", [](VertexSplit& s) { s.r = s.l; });
    reject(i, "d is o", [](VertexSplit& s) { s.d = s.o; });
    reject(i, "od is do", [](VertexSplit& s) { s.od = s.do_; });
    reject(i, "far o", [](VertexSplit& s) { s.o = VertexId{0xfffffffe}; });
    reject(i, "far l", [](VertexSplit& s) { s.l = VertexId{0xfffffffe}; });
    reject(i, "far od", [](VertexSplit& s) { s.od = 0xfffffffe; });
  }
}

TEST(Replay, RejectsABaseThatIsNotWhole) {
  const TriangleMesh mesh = original();
  HullParts parts = parts_of(hull_of(mesh));
  const auto face = std::ranges::find_if(parts.corners, [](VertexId v) { return v != ProgressiveHull::kAbsent; });
  const auto intact = parts;
  *face = VertexId{0xfffffffe};
  EXPECT_FALSE(verify_replay(parts.joined(), mesh).holds);
  parts = intact;
  parts.positions.pop_back();
  EXPECT_FALSE(verify_replay(parts.joined(), mesh).holds);
  parts = intact;
  parts.positions[VertexId{0}].x = NAN;
  EXPECT_FALSE(verify_replay(parts.joined(), mesh).holds);
}

TEST(Replay, RejectsTheHullOfAnotherMeshAndOfTheOtherSide) {
  const TriangleMesh mesh = original();
  const ProgressiveHull hull = hull_of(mesh);
  EXPECT_FALSE(verify_replay(hull, make_sample("asteroid", 500)).holds);
  TriangleMesh nearly = mesh;
  nearly.positions[VertexId{17}].x = std::nextafter(nearly.positions[VertexId{17}].x, 1e9);
  EXPECT_FALSE(verify_replay(hull, nearly).holds) << "an ulp off";
  EXPECT_FALSE(verify_replay(hull, together(mesh, moved(octahedron(), {9, 9, 9}))).holds) << "a part is missing";
  HullParts parts = parts_of(hull);
  parts.side = HullSide::Inner;
  EXPECT_FALSE(verify_replay(parts.joined(), mesh).holds);
}

TEST(Replay, TakesTheOriginalInAnyOrderAndTurned) {
  const TriangleMesh mesh = original();
  const ProgressiveHull hull = hull_of(mesh);
  EXPECT_TRUE(verify_replay(hull, inside_out(mesh)).holds);
  EXPECT_TRUE(verify_replay(hull, soup(mesh)).holds);
  TriangleMesh shuffled = mesh;
  std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), std::mt19937(test_seed()));
  for (auto& t : shuffled.triangles) std::rotate(t.begin(), t.begin() + 1, t.end());
  EXPECT_TRUE(verify_replay(hull, shuffled).holds);
}

// Turned inside out as a whole, an inner hull is a sound record of a hull that grows around an inside-out mesh.
TEST(Replay, RejectsAHullWhoseFinestLevelIsInsideOut) {
  const TriangleMesh mesh = original();
  const ProgressiveHull inner = hull_of(mesh, HullSide::Inner);
  HullParts parts = parts_of(inner);
  const auto turned = [](std::uint32_t corner) { return corner % 3 == 0 ? corner : corner / 3 * 3 + 3 - corner % 3; };
  for (std::size_t f = 0; f < parts.corners.size(); f += 3) std::swap(parts.corners[f + 1], parts.corners[f + 2]);
  for (VertexSplit& s : parts.splits) {
    const auto second = [&](std::uint32_t od) { return turned(od % 3 == 2 ? od - 2 : od + 1); };
    s = {s.o, s.d, s.r, s.l, second(s.do_), second(s.od)};
  }
  parts.side = HullSide::Outer;
  const ProgressiveHull impostor = parts.joined();
  ASSERT_EQ(first_defect(impostor), std::nullopt);
  ASSERT_EQ(impostor.original(), inside_out(mesh));
  ASSERT_FALSE(verify_enclosure(mesh, impostor.base()).encloses);
  EXPECT_FALSE(verify_replay(impostor, mesh).holds);
}

TEST(Replay, RejectsAComponentThatIsInsideOutButNotACavity) {
  const TriangleMesh ball = sphere(2), beside = moved(scaled(ball, 0.5), {3, 0, 0}), cavity = scaled(ball, 0.5);
  const auto holds = [](const TriangleMesh& mesh) {
    return verify_replay(build_hull(mesh, {.target_faces = 200}).hull, mesh).holds;
  };
  EXPECT_TRUE(holds(together(ball, beside)));
  EXPECT_TRUE(holds(together(ball, inside_out(cavity))));
  EXPECT_FALSE(holds(together(ball, inside_out(beside)))) << "what is called its hull shrinks around the second ball";
}

// Two parts meet in an edge with four faces. Compared without orientation, the triangles are those of the original.
TEST(Replay, RejectsAFinestLevelOfWhichOnePartIsTurned) {
  TriangleMesh mesh;
  mesh.positions = {{{0, 0, 0}, {0, 0, 2}, {0, 0, 1}, {0, 0, 1}, {4, -2, 1}, {4, 2, 1}, {-2, -1, 1}, {-2, 1, 1}}};
  const auto add = [&](std::initializer_list<std::array<std::uint32_t, 3>> faces) {
    for (const auto& [a, b, c] : faces) mesh.triangles.push_back({VertexId{a}, VertexId{b}, VertexId{c}});
  };
  add({{0, 4, 2}, {2, 4, 1}, {1, 5, 3}, {3, 5, 0}, {0, 5, 4}, {1, 4, 5}});
  add({{0, 3, 6}, {3, 1, 6}, {1, 2, 7}, {2, 0, 7}, {0, 6, 7}, {1, 7, 6}});
  ASSERT_EQ(turned_outwards(mesh), mesh);
  EXPECT_TRUE(verify_replay(parts_of(mesh).joined(), mesh).holds);
  TriangleMesh turned = mesh;
  for (std::uint32_t f = 6; f < 12; ++f) std::swap(turned.triangles[FaceId{f}][1], turned.triangles[FaceId{f}][2]);
  ASSERT_FALSE(verify_hull(turned, mesh).encloses);
  EXPECT_FALSE(verify_replay(parts_of(turned).joined(), mesh).holds);
  EXPECT_FALSE(verify_hull(parts_of(turned).joined(), mesh).encloses);
}

TEST(Replay, OfAMeshWithMoreUnusedVerticesThanCorners) {
  TriangleMesh mesh = octahedron();
  TriangleMesh gaps;
  gaps.positions = PerVertex<Vec3>(5000);
  for (const Vec3& p : mesh.positions) gaps.positions.push_back(p);
  for (const auto& [a, b, c] : mesh.triangles)
    gaps.triangles.push_back({VertexId{index(a) + 5000}, VertexId{index(b) + 5000}, VertexId{index(c) + 5000}});
  const ProgressiveHull hull = build_hull(gaps, {.target_faces = 6, .guards = {.max_normal_deviation = 1.5}}).hull;
  EXPECT_TRUE(verify_replay(hull, gaps).holds);
  EXPECT_TRUE(verify_replay(hull, mesh).holds);
  EXPECT_EQ(hull.original(), gaps);
}

TEST(Replay, CanBeCancelled) {
  const TriangleMesh mesh = make_sample("asteroid", 12000);
  const ProgressiveHull hull = build_hull(mesh, {.target_faces = 1000}).hull;
  const UnthrottledProgress unthrottled;
  double last = 0;
  EXPECT_TRUE(
      verify_replay(hull, mesh, [&](std::string_view, double fraction) { return last = fraction, true; }).holds);
  EXPECT_GT(last, 0.5);
  EXPECT_THROW(verify_replay(hull, mesh, [](std::string_view, double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace prohull
