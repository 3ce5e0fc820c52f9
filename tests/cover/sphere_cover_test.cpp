#include "prohull/sphere_cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "effort.h"
#include "geometry/float32.h"
#include "meshes.h"
#include "progress.h"
#include "prohull/convex_cover.h"
#include "prohull/error.h"
#include "prohull/mesh_query.h"
#include "prohull/sample.h"
#include "prohull/union_verification.h"
#include "random.h"

namespace prohull {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool is_in(const std::vector<Ball>& balls, const Vec3& p) {
  return std::ranges::any_of(balls, [&](const Ball& b) { return norm(p - b.center) <= b.radius; });
}

/// Points of the triangles at random, and their corners.
std::vector<Vec3> points_on(const TriangleMesh& mesh) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> fraction(0, 1);
  std::vector<Vec3> points;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    if (!is_finite(t.a) || !is_finite(t.b) || !is_finite(t.c)) continue;
    points.insert(points.end(), {t.a, t.b, t.c});
    for (int i = 0; i < 20; ++i) {
      const double u = fraction(random), v = fraction(random) * (1 - u);
      points.push_back(t.a * (1 - u - v) + t.b * u + t.c * v);
    }
  }
  return points;
}

/// Covered at all points tried, and proven.
void expect_covers(const SphereCover& cover, const TriangleMesh& mesh) {
  EXPECT_TRUE(cover.verdict.certified);
  EXPECT_FALSE(cover.balls.empty());
  EXPECT_GE(cover.verdict.distance().upper, cover.verdict.distance().lower);
  EXPECT_GE(cover.verdict.distance().lower, 0);
  for (const Ball& ball : cover.balls) ASSERT_TRUE(is_finite(ball.center) && ball.radius > 0);
  for (const Vec3& p : points_on(mesh)) ASSERT_TRUE(is_in(cover.balls, p)) << p.x << " " << p.y << " " << p.z;
}

double diagonal(const TriangleMesh& mesh) { return bounding_box(mesh).diagonal(); }

/// How far points on the balls are out of the solid, at most.
double sampled_reach(const std::vector<Ball>& balls, const TriangleMesh& solid) {
  MeshQuery query{QueryIndex(solid)};
  std::mt19937 random(test_seed());
  std::normal_distribution<double> normal;
  double most = 0;
  for (const Ball& ball : balls)
    for (int i = 0; i < 200; ++i) {
      const Vec3 direction{normal(random), normal(random), normal(random)};
      most = std::max(most, query.signed_distance(ball.center + direction * (ball.radius / norm(direction))).lower);
    }
  return most;
}

TEST(SphereCover, OneBallIsAboutTheSmallestAroundTheMesh) {
  const TriangleMesh mesh = meshes::box({-1, -1, -1}, {1, 1, 1});
  const SphereCover cover = sphere_cover(mesh, {.max_balls = 1});
  expect_covers(cover, mesh);
  ASSERT_EQ(cover.balls.size(), 1U);
  EXPECT_NEAR(cover.balls[0].radius, std::sqrt(3.0), 0.02);
  EXPECT_NEAR(cover.verdict.distance().upper, std::sqrt(3.0) - 1, 0.03);
}

TEST(SphereCover, HasFloat32NumbersNearTheOrigin) {
  const auto is_stored = [](const Ball& ball) {
    return is_float32(ball.center) && nearest_float32(ball.radius) == ball.radius;
  };
  const TriangleMesh mesh = meshes::moved(meshes::octahedron(), {0.1, 0.2, 0.3});
  EXPECT_TRUE(std::ranges::all_of(sphere_cover(mesh, {.max_balls = 8}).balls, is_stored));
  const SphereCover far = sphere_cover(meshes::moved(mesh, {1e6, 1e6, 1e6}), {.max_balls = 8});
  EXPECT_TRUE(far.verdict.certified && !std::ranges::all_of(far.balls, is_stored));
}

TEST(SphereCover, OfABallIsThatBall) {
  const TriangleMesh mesh = meshes::sphere(2);
  const SphereCover cover = sphere_cover(mesh, {.max_balls = 3});
  expect_covers(cover, mesh);
  EXPECT_LT(cover.verdict.distance().upper, 0.1);
}

TEST(SphereCover, OfSamplesReachesOutLittle) {
  for (const char* name : {"bracket", "knot"}) {
    const TriangleMesh mesh = make_sample(name, effort(1500, 500));
    const SphereCover cover = sphere_cover(mesh, {.max_balls = effort<std::size_t>(64, 16)});
    expect_covers(cover, mesh);
    EXPECT_LE(cover.balls.size(), 64U);
    EXPECT_LT(cover.verdict.distance().upper, effort(0.08, 0.2) * diagonal(mesh)) << name;
    EXPECT_TRUE(cover.within_bounds);
    EXPECT_GE(cover.verdict.distance().upper, sampled_reach(cover.balls, mesh)) << name;
    EXPECT_GT(cover.volume, 0.5 * cover.original_volume) << name;
  }
}

TEST(SphereCover, MoreBallsReachOutLess) {
  const TriangleMesh mesh = make_sample("bracket", 500);
  double before = kInfinity;
  for (const std::size_t count : {4, 16, 64}) {
    const SphereCover cover = sphere_cover(mesh, {.max_balls = count});
    EXPECT_LE(cover.balls.size(), count);
    EXPECT_LT(cover.verdict.distance().upper, before);
    before = cover.verdict.distance().upper;
  }
}

// Two tetrahedra that share a face: it is in the solid, and repairs leave triangles without area in it.
TEST(SphereCover, FewBallsAroundACubeAreOneOrOfItsOctants) {
  for (const double at : {0.0, -0.1}) {
    const TriangleMesh cube = meshes::box({at, at, at}, {at + 0.2, at + 0.2, at + 0.2});
    const auto reach = [&](std::size_t count) {
      const SphereCover cover = sphere_cover(cube, {.max_balls = count});
      EXPECT_TRUE(cover.verdict.certified);
      return cover.verdict.distance().upper;
    };
    const double of_one = reach(1);
    EXPECT_LE(reach(2), of_one);
    EXPECT_LE(reach(4), of_one);
    EXPECT_LE(reach(8), 0.04);
    const SphereCover near = sphere_cover(cube, {.max_balls = 64, .max_distance = 0.038});
    EXPECT_TRUE(near.within_bounds);
    EXPECT_EQ(near.balls.size(), 8U);
  }
}

TEST(SphereCover, OfTetrahedraWithAFaceInCommonReachesOutLittle) {
  const TriangleMesh joined =
      meshes::make({{1, 0, 0}, {-0.5, 0.8660254, 0}, {-0.5, -0.8660254, 0}, {0, 0, 1}, {0, 0, -1}},
                   {{3, 0, 1}, {3, 1, 2}, {3, 2, 0}, {2, 1, 0}, {4, 1, 0}, {4, 2, 1}, {4, 0, 2}, {2, 0, 1}});
  double before = kInfinity;
  for (const std::size_t count : {8, 16, 32, 64}) {
    const SphereCover cover = sphere_cover(joined, {.max_balls = count});
    expect_covers(cover, joined);
    EXPECT_LT(cover.verdict.distance().upper, before);
    EXPECT_LT(cover.verdict.distance().upper, 1.1 * cover.verdict.distance().lower);
    before = cover.verdict.distance().upper;
  }
}

// Both sides of a triangle are closed, and bound nothing.
TEST(SphereCover, ReachesOutLittleOfASheetWithTwoSidesBesideASolid) {
  const TriangleMesh sheet = meshes::make({{5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
  const TriangleMesh mesh = meshes::together(meshes::box({0, 0, 0}, {1, 1, 1}), sheet);
  const SphereCover cover = sphere_cover(mesh, {.max_balls = 64});
  expect_covers(cover, mesh);
  EXPECT_LT(cover.verdict.distance().upper, 0.15);
  EXPECT_TRUE(sphere_cover(mesh, {.max_balls = 64, .max_distance = 0.3}).within_bounds);
}

// Repairs close a loose triangle by its other side, which is a face of the original.
TEST(SphereCover, CountsNoCapThatIsAFaceOfTheOriginal) {
  const TriangleMesh loose = meshes::make({{5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{0, 1, 2}});
  const TriangleMesh mesh = meshes::together(meshes::box({0, 0, 0}, {1, 1, 1}), loose);
  EXPECT_EQ(sphere_cover(mesh, {.max_balls = 4}).verdict.cap_faces, 0U);
  EXPECT_EQ(convex_cover(mesh, {.max_pieces = 2}).verdict.cap_faces, 0U);
  TriangleMesh open = meshes::box({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  EXPECT_EQ(sphere_cover(open, {.max_balls = 4}).verdict.cap_faces, 1U);
  EXPECT_EQ(convex_cover(open, {.max_pieces = 2}).verdict.cap_faces, 1U);
}

TEST(SphereCover, KeepsADistanceWithFewBalls) {
  const TriangleMesh mesh = make_sample("bracket", 500);
  const double distance = 0.08 * diagonal(mesh);
  const SphereCover cover = sphere_cover(mesh, {.max_balls = 500, .max_distance = distance});
  expect_covers(cover, mesh);
  EXPECT_TRUE(cover.within_bounds);
  EXPECT_LE(cover.verdict.distance().upper, distance);
  EXPECT_LT(cover.balls.size(), 100U);
  EXPECT_LT(sphere_cover(mesh, {.max_balls = 500, .max_distance = 2 * distance}).balls.size(), cover.balls.size());
}

TEST(SphereCover, KeepsADistanceThatIsKeptWithoutIt) {
  for (const auto& [name, factor] : {std::pair("knot", 1.0), std::pair("bracket", 1.05)}) {
    const TriangleMesh mesh = make_sample(name, 200);
    const double reach = sphere_cover(mesh, {.max_balls = 16}).verdict.distance().upper;
    const SphereCover cover = sphere_cover(mesh, {.max_balls = 16, .max_distance = factor * reach});
    expect_covers(cover, mesh);
    EXPECT_TRUE(cover.within_bounds) << name;
    EXPECT_LE(cover.verdict.distance().upper, factor * reach) << name;
    EXPECT_LE(cover.balls.size(), 16U);
    EXPECT_TRUE(cover.notes.empty()) << name;
  }
}

TEST(SphereCover, SaysWhereADistanceIsNotKept) {
  const TriangleMesh mesh = make_sample("bracket", 500);
  for (const double distance : {0.02 * diagonal(mesh), 1e-9, std::numeric_limits<double>::denorm_min()}) {
    const SphereCover cover = sphere_cover(mesh, {.max_balls = 5, .max_distance = distance});
    expect_covers(cover, mesh);
    EXPECT_LE(cover.balls.size(), 5U);
    EXPECT_FALSE(cover.within_bounds);
    EXPECT_FALSE(cover.notes.empty());
  }
}

TEST(SphereCover, FillsTheInside) {
  const TriangleMesh mesh = meshes::box({0, 0, 0}, {3, 2, 2});
  const SphereCover cover = sphere_cover(mesh, {.max_balls = 30, .fill = true});
  expect_covers(cover, mesh);
  EXPECT_TRUE(cover.verdict.encloses_solid == Answer::Yes);
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> x(0, 3), y(0, 2);
  for (int i = 0; i < 10000; ++i) ASSERT_TRUE(is_in(cover.balls, {x(random), y(random), y(random)}));
  EXPECT_GT(cover.volume, 12);
}

TEST(SphereCover, FillsWhatIsNotClosed) {
  TriangleMesh open = meshes::soup(make_sample("bracket", 500));
  for (std::size_t i = 0; i < 60; ++i) open.triangles.pop_back();
  const SphereCover cover = sphere_cover(open, {.max_balls = 64, .fill = true});
  expect_covers(cover, open);
  EXPECT_TRUE(cover.verdict.encloses_solid == Answer::Yes);
}

TEST(SphereCover, ReachesNowhereOutWithinACavity) {
  const TriangleMesh hollow = meshes::together(meshes::box({0, 0, 0}, {1, 1, 1}),
                                               meshes::inside_out(meshes::box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75})));
  const SphereCover cover = sphere_cover(hollow, {.max_balls = 12});
  EXPECT_DOUBLE_EQ(cover.original_volume, 1);
  EXPECT_EQ(cover.notes.size(), 1u);
  EXPECT_EQ(cover.verdict.distance().upper, union_reach(cover.balls, hollow).upper) << "verify says the same";
  EXPECT_EQ(cover.verdict.distance().upper, union_reach(cover.balls, meshes::box({0, 0, 0}, {1, 1, 1})).upper);
}

TEST(SphereCover, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = make_sample("bracket", 500);
  for (const bool fill : {false, true}) {
    const SphereCover one = sphere_cover(mesh, {.max_balls = 20, .fill = fill, .threads = 1});
    EXPECT_EQ(one.balls, sphere_cover(mesh, {.max_balls = 20, .fill = fill}).balls);
  }
}

// Squares of its lengths squared underflow, so that finer searches find nothing, and coarser ones find too much.
// Radii were kept as float32, in which no ball of 1e64 reached anything, and areas of lengths of 1e77 overflowed: the
// search did not end.
TEST(SphereCover, IsTheSameInAnyUnit) {
  const TriangleMesh bracket = make_sample("bracket", 200);
  const SphereCover cover = sphere_cover(bracket, {.max_balls = 5});
  for (const int exponent : {60, 120, 210, 300}) {
    TriangleMesh scaled = bracket;
    const double unit = std::ldexp(1.0, exponent);
    for (Vec3& p : scaled.positions) p = p * unit;
    const SphereCover same = sphere_cover(scaled, {.max_balls = 5});
    EXPECT_TRUE(same.verdict.certified);
    ASSERT_EQ(same.balls.size(), cover.balls.size()) << exponent;
    for (std::size_t i = 0; i < cover.balls.size(); ++i) {
      EXPECT_EQ(same.balls[i].center, cover.balls[i].center * unit) << exponent;
      EXPECT_EQ(same.balls[i].radius, cover.balls[i].radius * unit) << exponent;
    }
  }
}

TEST(SphereCover, OfATinyBoxEnds) {
  const SphereCover cover = sphere_cover(meshes::box({0, 0, 0}, {1e-98, 1e-98, 1e-98}), {.max_balls = 4});
  EXPECT_TRUE(cover.verdict.certified);
}

TEST(SphereCover, CoversTrianglesThatBoundNothing) {
  const TriangleMesh plate = meshes::make({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const TriangleMesh needle = meshes::make({{0, 0, 0}, {1, 0, 0}, {2, 1e-12, 0}}, {{0, 1, 2}});
  const TriangleMesh segment = meshes::make({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}});
  for (const TriangleMesh& mesh : {plate, needle, segment}) {
    const SphereCover cover = sphere_cover(mesh, {.max_balls = 16});
    expect_covers(cover, mesh);
    EXPECT_LE(cover.verdict.distance().upper, 0.2 * diagonal(mesh) + 1e-6);
  }
}

TEST(SphereCover, CoversDirtyTriangles) {
  const TriangleMesh box = meshes::box({0, 0, 0}, {2, 1, 1});
  TriangleMesh with_holes = make_sample("knot", 600);
  for (int i = 0; i < 40; ++i) with_holes.triangles.pop_back();
  TriangleMesh with_nan = box;
  with_nan.positions.push_back({kNaN, 0, kInfinity});
  with_nan.triangles.push_back({VertexId(0), VertexId(1), VertexId(8)});
  for (const TriangleMesh& mesh :
       {meshes::soup(box), meshes::together(box, box), meshes::inside_out(box), with_holes, with_nan,
        meshes::together(box, meshes::moved(box, {0.5, 0.5, 0.5})),
        meshes::together(box, meshes::moved(box, {20, 0, 0})), meshes::together(box, meshes::scaled(box, 0.1)),
        meshes::moved(box, {1e7, -1e7, 3e7}), meshes::scaled(box, 1e-30), meshes::scaled(box, 1e30)}) {
    const SphereCover cover = sphere_cover(mesh, {.max_balls = 32});
    expect_covers(cover, mesh);
    EXPECT_LE(cover.balls.size(), 32U);
  }
}

// A loose triangle, thin or without an area, gets spheres of its own.
TEST(SphereCover, CoversATriangleBesideASolidByManyBalls) {
  for (const double width : {0.0, 1e-3}) {
    TriangleMesh mesh = meshes::sphere(1);
    append(mesh, meshes::make({{3, 0, 0}, {3, 0, width}, {13, 0, 0}}, {{0, 1, 2}}));
    const SphereCover cover = sphere_cover(mesh, {.max_balls = 16});
    EXPECT_TRUE(cover.verdict.certified);
    EXPECT_GT(cover.balls.size(), 8u);
    EXPECT_LT(cover.verdict.distance_to_triangles->upper, 1);
    EXPECT_LT(cover.volume, 3 * signed_volume(meshes::sphere(1)));
  }
}

TEST(SphereCover, RefusesWhatCannotBeCovered) {
  const TriangleMesh box = meshes::box({0, 0, 0}, {1, 1, 1});
  EXPECT_THROW(sphere_cover({}), InputError);
  EXPECT_THROW(sphere_cover(meshes::make({{0, 0, kNaN}}, {{0, 0, 0}})), InputError);
  EXPECT_THROW(sphere_cover(meshes::make({{1, 2, 3}}, {{0, 0, 0}})), InputError);
  EXPECT_THROW(sphere_cover(box, {.max_balls = 0}), InputError);
  EXPECT_THROW(sphere_cover(box, {.max_balls = kMostCoverBalls + 1}), InputError);
  for (const double distance : {0.0, -1.0, kNaN})
    EXPECT_THROW(sphere_cover(box, {.max_distance = distance}), InputError);
}

TEST(SphereCover, StopsWhenItIsTold) {
  const UnthrottledProgress unthrottled;
  const TriangleMesh mesh = make_sample("bracket", 300);
  int calls = 0;
  bool searched = false;
  // On one thread, as the number of questions hangs on what other threads leave to the caller's.
  sphere_cover(mesh, {.max_balls = 8, .threads = 1, .progress = [&](std::string_view stage, double) {
                        searched |= stage == "spheres";
                        return ++calls > 0;
                      }});
  EXPECT_TRUE(searched);
  for (int last = 1; last < calls; last += 1 + calls / effort(20, 4)) {
    int count = 0;
    EXPECT_THROW(sphere_cover(mesh, {.max_balls = 8,
                                     .threads = 1,
                                     .progress = [&](std::string_view, double) { return ++count != last; }}),
                 Cancelled);
  }
}

}  // namespace
}  // namespace prohull
