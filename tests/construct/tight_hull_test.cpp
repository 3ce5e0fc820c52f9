#include "prohull/tight_hull.h"

#include <gtest/gtest.h>

#include <utility>

#include "construct/tight/few_faces.h"
#include "construct/turned.h"
#include "effort.h"
#include "geometry/float32.h"
#include "meshes.h"
#include "progress.h"
#include "prohull/detail/float32_hull.h"
#include "prohull/distance.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/mesh_report.h"
#include "prohull/sample.h"

namespace prohull {
namespace {

using namespace meshes;

/// What is told of all hulls of few faces is true after few trials too.
HullOptions few(HullOptions options) {
  options.tight_trials = effort(60, 12);
  return options;
}

class TightHulls : public testing::TestWithParam<const char*> {};

TEST_P(TightHulls, EncloseWithLessVoidAndDoNotIntersectThemselves) {
  const TriangleMesh mesh = make_sample(GetParam(), effort(3000, 1000));
  const double volume = signed_volume(mesh);
  for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
    const HullOptions options{.target_faces = 300, .side = side};
    const TightHull tight = build_tight_hull(mesh, few(options));
    EXPECT_EQ(tight.stopped, Stopped::TargetReached);
    EXPECT_EQ(tight.mesh.face_count(), 300u);
    EXPECT_GT(tight.moved_vertices, 0u);
    EXPECT_TRUE(inspect(tight.mesh).is_closed_manifold());
    EXPECT_EQ(count_self_intersections(tight.mesh), 0u);
    const bool outer = side == HullSide::Outer;
    EXPECT_TRUE((outer ? verify_enclosure(mesh, tight.mesh) : verify_enclosure(tight.mesh, mesh)).encloses);
    const double loose_void = std::abs(signed_volume(build_hull(mesh, options).hull.base()) - volume);
    EXPECT_LT(std::abs(signed_volume(tight.mesh) - volume), loose_void);
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, TightHulls, testing::Values("asteroid", "knot", "pony"),
                         [](const auto& sample) { return std::string(sample.param); });

TEST(TightHull, OfSeveralComponentsAndHandlesEncloses) {
  const TriangleMesh ball = sphere(effort(4, 3));
  const TriangleMesh mesh = together(together(ball, moved(ball, {2.1, 0, 0})), moved(torus(40, 20), {0, 4, 0}));
  const TightHull tight = build_tight_hull(mesh, few({.target_faces = 200}));
  EXPECT_TRUE(verify_enclosure(mesh, tight.mesh).encloses);
  EXPECT_EQ(count_self_intersections(tight.mesh), 0u);
}

TEST(TightHull, OfFloat32CoordinatesHasThemAndEncloses) {
  const TriangleMesh mesh = make_sample("asteroid", 2000);
  const TightHull tight = build_tight_hull(mesh, few({.target_faces = 200, .float32_coordinates = true}));
  const Float32Hull rounded = with_float32_coordinates(tight.mesh, HullSide::Outer);
  for (const Vec3& p : rounded.mesh.positions) EXPECT_TRUE(is_float32(p));
  EXPECT_TRUE(verify_enclosure(mesh, rounded.mesh).encloses);
}

// A coordinate that a float32 rounds to infinity is no number for the exact predicates: GMP divides by zero there.
TEST(TightHull, BeyondFloat32HasFiniteCoordinates) {
  const TriangleMesh mesh = scaled(moved(subdivided(octahedron()), {1e9, 1e9, 1e9}), 1e30);
  for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
    const TriangleMesh tight =
        build_tight_hull(mesh, few({.target_faces = 8, .side = side, .float32_coordinates = true})).mesh;
    EXPECT_TRUE(inspect(tight).is_closed_manifold()) << "not finite, for instance";
    EXPECT_TRUE((side == HullSide::Outer ? verify_enclosure(mesh, tight) : verify_enclosure(tight, mesh)).encloses);
  }
}

TEST(TightHull, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = make_sample("pony", effort(6000, 2000));
  const TriangleMesh one = build_tight_hull(mesh, few({.target_faces = 200, .threads = 1})).mesh;
  for (const unsigned threads : {2u, 3u, 0u})
    EXPECT_EQ(one, build_tight_hull(mesh, few({.target_faces = 200, .threads = threads})).mesh) << threads;
}

// The progressive hulls leave much to gain.
TEST(TightHull, OfFewFacesIsSearchedOnFromAndNeverWorse) {
  const TriangleMesh mesh = make_sample("asteroid", 600);
  for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
    const auto oriented = [&](const TriangleMesh& m) { return side == HullSide::Inner ? turned(m) : m; };
    const auto level = [&](std::size_t faces) {
      return oriented(build_hull(mesh, {.target_faces = faces, .side = side}).hull.base());
    };
    const TriangleMesh hull = level(40);
    const Original original = Original::closed(oriented(mesh), side, 1);
    const TriangleMesh found =
        with_less_volume(hull, original, few({.target_faces = hull.face_count(), .side = side, .threads = 1}));
    EXPECT_LT(signed_volume(found), signed_volume(hull));
    EXPECT_LE(found.face_count(), hull.face_count());
    EXPECT_TRUE(inspect(oriented(found)).is_closed_manifold());
    EXPECT_EQ(count_self_intersections(found), 0u);
    EXPECT_TRUE(
        (side == HullSide::Outer ? verify_enclosure(mesh, found) : verify_enclosure(oriented(found), mesh)).encloses);
  }
}

TEST(TightHull, OfFewFacesMayHaveComponentsOfTwoFaces) {
  const TriangleMesh leaf = make({{3, 0, 0}, {4, 0, 0}, {3, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
  const TriangleMesh mesh = together(octahedron(), leaf);
  const Original original = Original::closed(mesh, HullSide::Outer, 1);
  for (unsigned seed = 0; seed < 20; ++seed) {
    const TriangleMesh found = with_less_volume(mesh, original, {.target_faces = 10, .seed = seed});
    EXPECT_TRUE(inspect(found).is_closed_manifold()) << seed;
    EXPECT_TRUE(verify_enclosure(mesh, found).encloses) << seed;
  }
}

TEST(TightHull, OfFewFacesHasLessVoidThanWithoutSearch) {
  const TriangleMesh mesh = make_sample("pony", 2000);
  const auto with_trials = [&](unsigned trials) {
    return signed_volume(build_tight_hull(mesh, {.target_faces = 50, .tight_trials = trials}).mesh);
  };
  constexpr unsigned kTrials = 60;
  EXPECT_LT(with_trials(kTrials), with_trials(0));
}

TEST(TightHull, IsNotSymmetric) {
  EXPECT_THROW(build_tight_hull(make_sample("box", 500), {.target_faces = 100, .mirror = Axis::X}), InputError);
}

TEST(TightHull, GoesForwardAndCancels) {
  const TriangleMesh mesh = make_sample("asteroid", effort(2000, 500));
  expect_progress("tighten", 20, [&](const Progress& progress) {
    build_tight_hull(mesh, few({.target_faces = 100, .threads = 1, .progress = progress}));
  });
}

TEST(TightHullWithin, KeepsTheDistanceWithFewerFacesThanLevelsHave) {
  const TriangleMesh mesh = make_sample("asteroid", effort(1000, 300));
  std::size_t faces = 0, faces_of_levels = 0;
  for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
    const bool float32 = side == HullSide::Outer;
    const HullOptions options{.target_faces = 50, .side = side, .float32_coordinates = float32};
    const double distance = 0.04 * bounding_box(mesh).diagonal();
    const auto stored_as = [&](const TriangleMesh& h) { return float32 ? with_float32_coordinates(h, side).mesh : h; };
    const auto is_near = [&](const TriangleMesh& h) { return distance_bounds(stored_as(h), mesh).upper <= distance; };
    const TightHull hull = build_tight_hull_within(mesh, is_near, few(options));
    const TriangleMesh stored = stored_as(hull.mesh);
    EXPECT_LE(distance_bounds(stored, mesh).upper, distance);
    EXPECT_TRUE((side == HullSide::Outer ? verify_enclosure(mesh, stored) : verify_enclosure(stored, mesh)).encloses);
    EXPECT_GT(hull.mesh.face_count(), 50u);
    faces += hull.mesh.face_count();
    faces_of_levels += faces_within(build_hull(mesh, options).hull, is_near);
  }
  EXPECT_LT(faces, faces_of_levels);
}

TEST(TightHullWithin, StopsAtTheTargetOrAtTheMeshItself) {
  const TriangleMesh mesh = make_sample("asteroid", effort(500, 200));
  const TightHull far = build_tight_hull_within(
      mesh, [](const TriangleMesh&) { return true; }, few({.target_faces = 100}));
  EXPECT_EQ(far.mesh, build_tight_hull(mesh, few({.target_faces = 100})).mesh);
  const auto is_itself = [&](const TriangleMesh& hull) { return hull == mesh; };
  EXPECT_EQ(build_tight_hull_within(mesh, is_itself, few({.target_faces = 100})).mesh, mesh);
}

TEST(TightHullWithin, EndsWhereTheMostFacesAreNotAccepted) {
  const TriangleMesh mesh = make_sample("asteroid", 200);
  int asked = 0;
  const auto is_itself = [&](const TriangleMesh& hull) { return ++asked > 0 && hull == mesh; };
  build_tight_hull_within(mesh, is_itself, few({.target_faces = 20}));
  const int without_limit = std::exchange(asked, 0);
  EXPECT_EQ(build_tight_hull_within(mesh, is_itself, few({.target_faces = 20}), nullptr, 0, 80).mesh, mesh);
  EXPECT_LT(asked, without_limit - 4) << "tight hulls of 20 and 80 faces, and the levels";
}

TEST(TightHullWithin, GoesForwardAndCancels) {
  const TriangleMesh mesh = make_sample("asteroid", effort(500, 200));
  const double distance = 0.01 * bounding_box(mesh).diagonal();
  const auto is_near = [&](const TriangleMesh& h) { return distance_bounds(h, mesh).upper <= distance; };
  expect_progress("search", 20, [&](const Progress& progress) {
    build_tight_hull_within(mesh, is_near, few({.target_faces = 50, .progress = progress}));
  });
}

}  // namespace
}  // namespace prohull
