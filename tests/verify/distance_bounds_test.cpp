#include "prohull/distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "effort.h"
#include "meshes.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "prohull/sample.h"
#include "prohull/tolerances.h"
#include "prohull/union_verification.h"
#include "verify/offenders.h"

namespace prohull {
namespace {

using namespace meshes;

/// The farthest of points spread over the faces of one mesh from the other, by looking at all its faces.
double sampled_distance(const TriangleMesh& from, const TriangleMesh& to, int steps) {
  double farthest = 0;
  for (const FaceId f : from.triangles.ids()) {
    const Triangle t = from.triangle(f);
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const Vec3 p = t.a + (t.b - t.a) * (double(i) / steps) + (t.c - t.a) * (double(j) / steps);
        double nearest = std::numeric_limits<double>::infinity();
        for (const FaceId g : to.triangles.ids()) nearest = std::min(nearest, verify::distance(p, to.triangle(g)));
        farthest = std::max(farthest, nearest);
      }
  }
  return farthest;
}

TEST(DistanceBounds, OfABoxAroundABoxIsThatOfItsCorners) {
  const DistanceBounds bounds = distance_bounds(box({-2, -2, -2}, {2, 2, 2}), box({-1, -1, -1}, {1, 1, 1}));
  EXPECT_NEAR(bounds.lower, std::sqrt(3.0), 1e-12);
  EXPECT_GE(bounds.upper, std::sqrt(3.0));
  EXPECT_LE(bounds.upper, 1.01 * std::sqrt(3.0) + 1e-12);
  EXPECT_EQ(std::abs(bounds.farthest.x * bounds.farthest.y * bounds.farthest.z), 8);
}

TEST(DistanceBounds, IsFoundWhereNoCornerIs) {
  // A lid over a V-shaped valley.
  const TriangleMesh valley = make({{-1, -5, 1}, {0, -5, 0}, {1, -5, 1}, {-1, 5, 1}, {0, 5, 0}, {1, 5, 1}},
                                   {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}});
  const TriangleMesh lid = make({{-1, -5, 1}, {1, -5, 1}, {1, 5, 1}, {-1, 5, 1}}, {{0, 1, 2}, {0, 2, 3}});
  const DistanceBounds bounds = distance_bounds(lid, valley, {.relative_gap = 0.001});
  EXPECT_NEAR(bounds.upper, std::sqrt(0.5), 0.002);
  EXPECT_NEAR(bounds.farthest.x, 0, 0.01);
}

TEST(DistanceBounds, OfNeedlesHoldToo) {
  const TriangleMesh needle = box({0, 0, 0}, {1e6, 1e-6, 1e-6});
  EXPECT_EQ(distance_bounds(needle, needle).lower, 0) << "the closest points that are found are others";
  const TriangleMesh rod = box({0, 0, 0}, {1e4, 1e-3, 1e-3}), beside = box({0, 1e-9, 0}, {1e4, 1e-3 + 1e-9, 1e-3});
  const DistanceBounds bounds = distance_bounds(rod, beside);
  EXPECT_LE(bounds.lower, 1e-9 * (1 + 1e-6)) << "it was 2.5e-4";
  EXPECT_GE(bounds.upper, 1e-9);
}

TEST(DistanceBounds, OfAMeshFromItselfHaveNoFarthestPoint) {
  const TriangleMesh mesh = make_sample("knot", 1000);
  const DistanceBounds bounds = distance_bounds(mesh, mesh);
  EXPECT_EQ(bounds.lower, 0);
  EXPECT_EQ(bounds.farthest, (Vec3{}));
  TriangleMesh more = box({2, 2, 2}, {3, 3, 3});
  append(more, mesh);
  EXPECT_EQ(distance_bounds(mesh, more).upper, 0) << "it is a component";
  EXPECT_EQ(distance_bounds(inside_out(mesh), mesh).upper, 0) << "inside out";
}

TEST(DistanceBounds, HoldTheSampledDistanceOfHulls) {
  const TriangleMesh mesh = make_sample("knot", 1000);
  const ProgressiveHull hull = build_hull(mesh, {.target_faces = 100}).hull;
  for (const std::size_t faces : {100, 200, 500}) {
    const TriangleMesh level = hull.level(faces);
    const double sampled = sampled_distance(level, mesh, rounds(8));
    const DistanceBounds bounds = distance_bounds(level, mesh);
    EXPECT_GE(bounds.upper, sampled);
    EXPECT_LE(bounds.upper, 1.010001 * bounds.lower);
    EXPECT_GE(bounds.lower, 0.9 * sampled);
    const DistanceBounds hasty = distance_bounds(level, mesh, {.max_cells = 1});
    EXPECT_GE(hasty.upper, bounds.lower) << "loose, and true";
  }
}

// Bounds that are 1 % apart leave it open.
TEST(DistanceBounds, DecideWhatTheyAreAskedFor) {
  const TriangleMesh mesh = make_sample("knot", 1000), hull = build_hull(mesh, {.target_faces = 100}).hull.base();
  const double least = distance_bounds(hull, mesh, {.relative_gap = 1e-6}).lower;
  for (const double factor : {1.00001, 1.001, 1.005})
    EXPECT_LE(distance_bounds(hull, mesh, {.relative_gap = 0.1, .decides = factor * least}).upper, factor * least);
  for (const double factor : {0.5, 0.995, 0.99999})
    EXPECT_GT(distance_bounds(hull, mesh, {.relative_gap = 0.1, .decides = factor * least}).lower, factor * least);
}

TEST(DistanceBounds, OfAMeshFromItselfIsNextToNothing) {
  const TriangleMesh mesh = octahedron();
  EXPECT_LT(distance_bounds(mesh, mesh).upper, 1e-12);
}

TEST(DistanceBounds, OfFacesInOnePlaneTakeFewParts) {
  const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1});
  TriangleMesh divided = subdivided(subdivided(cube));
  for (Vec3& p : divided.positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] *= 0.7 + 0.3 * p[axis];  // its faces lie in those of the cube
  EXPECT_LT(distance_bounds(cube, divided, {.max_cells = 1000 * divided.face_count()}).upper, 1e-12);
}

// Parts whose longest sides were never cut, as their corners kept on one line.
TEST(DistanceBounds, OfOverlapsInOnePlaneAreNear) {
  const auto triangles = [](const std::vector<Vec3>& corners) {
    TriangleMesh mesh;
    for (std::size_t i = 0; i < corners.size(); i += 3)
      append(mesh, make({corners[i], corners[i + 1], corners[i + 2]}, {{0, 1, 2}}));
    return mesh;
  };
  const TriangleMesh from = triangles({{5.6, -1.406, 0.6468},
                                       {-0.6, -1.167, 1.017},
                                       {-0.6, -1.531, 0.2246},
                                       {-12, 23, 22},
                                       {-13.15, 23, 22.23},
                                       {-1.083, 23, 30.38},
                                       {-12, 23, 22},
                                       {-5.585e-08, 23, 29.75},
                                       {12, 23, 22},
                                       {12, 23, 22},
                                       {-5.585e-08, 23, 29.75},
                                       {0.625, 23, 29.92}}),
                     to = triangles({{-14.75, 23, 25.25},   {14.75, 23, 25.25},     {-14.75, 23, 56.75},
                                     {-14.75, 23, 25.25},   {-12.68, 23, 22.4},     {-11.75, 23, 22.25},
                                     {-14.75, 23, 25.25},   {-11.75, 23, 22.25},    {14.75, 23, 25.25},
                                     {14.75, 23, 25.25},    {-11.75, 23, 22.25},    {11.75, 23, 22.25},
                                     {5.6, 0.2093, -1.485}, {-0.6, 0.6193, -1.366}, {5.6, 0.6193, -1.366},
                                     {5.6, -1.26, 0.8145},  {-0.6, -1.26, 0.8145},  {-0.6, -1.438, 0.4267},
                                     {-1.083, 23, 30.38},   {-13.15, 23, 22.23},    {-14.12, 23, 22.88},
                                     {-12, 23, 22},         {-0.625, 23, 29.92},    {-5.585e-08, 23, 29.75}});
  const DistanceBounds bounds = distance_bounds(from, to);
  EXPECT_LE(bounds.upper, 1.010001 * bounds.lower) << "they were 18 % apart";
}

TEST(DistanceBounds, OfNeedlesAndPointsAreThoseOfTheirCorners) {
  const TriangleMesh needle = make({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}});
  const TriangleMesh point = make({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, {{0, 1, 2}});
  EXPECT_NEAR(distance_bounds(needle, point).upper, std::sqrt(5.0), 0.03);
  EXPECT_NEAR(distance_bounds(point, needle).upper, 1, 1e-12);
}

// From 1e-150 to 1e150: the same bounds, times the unit. Distances of the small ones have squares of 0.
TEST(DistanceBounds, AreTheSameInEveryUnit) {
  const TriangleMesh mesh = make_sample("knot", 200), hull = build_hull(mesh, {.target_faces = 50}).hull.level(50);
  const DistanceBounds bounds = distance_bounds(hull, mesh), reach = union_reach(std::vector{hull}, mesh);
  const std::vector<Ball> balls{{{0, 0, 0}, bounding_box(mesh).diagonal()}};
  const DistanceBounds of_balls = union_reach(balls, mesh);
  const double away = std::nextafter(bounds.lower, 0), near = bounds.upper;
  for (const int exponent : {-498, -400, -260, -190, 190, 330, 498}) {
    const double unit = std::ldexp(1.0, exponent);
    const auto scaled = [&](TriangleMesh any) {
      for (Vec3& p : any.positions) p = p * unit;
      return any;
    };
    const auto expect = [&](const DistanceBounds& found, const DistanceBounds& expected) {
      EXPECT_EQ(found.lower, expected.lower * unit) << exponent;
      EXPECT_GE(found.upper, expected.upper * unit) << exponent;
      EXPECT_LE(found.upper, std::nextafter(expected.upper * unit, 1e300)) << exponent;
    };
    expect(distance_bounds(scaled(hull), scaled(mesh)), bounds);
    expect(union_reach(std::vector{scaled(hull)}, scaled(mesh)), reach);
    expect(union_reach(std::vector<Ball>{{{0, 0, 0}, balls[0].radius * unit}}, scaled(mesh)), of_balls);
    const auto are_within = [&](double distance) {
      return verify_tolerances(scaled(mesh), scaled(hull), PerFace<double>(hull.face_count(), distance * unit)).holds;
    };
    EXPECT_TRUE(are_within(near)) << exponent;
    EXPECT_FALSE(are_within(away)) << exponent;
  }
}

TEST(DistanceBounds, RefuseWhatHasNoDistance) {
  EXPECT_THROW(distance_bounds(TriangleMesh{}, octahedron()), InputError);
  TriangleMesh broken = octahedron();
  broken.positions[VertexId{1}].x = std::nan("");
  EXPECT_THROW(distance_bounds(octahedron(), broken), InputError);
  EXPECT_THROW(distance_bounds(make_sample("knot", 5000), make_sample("sphere", 5000),
                               {.relative_gap = 0, .progress = [](std::string_view, double) { return false; }}),
               Cancelled);
}

TEST(FacesWithin, IsACoarserLevelForAGreaterDistance) {
  const TriangleMesh mesh = make_sample("asteroid", 3000);
  const ProgressiveHull hull = build_hull(mesh, {.target_faces = 50}).hull;
  const double reach = bounding_box(mesh).diagonal();
  const auto is_within = [&](double distance) {
    return [&mesh, distance](const TriangleMesh& level) { return distance_bounds(level, mesh).upper <= distance; };
  };
  std::size_t finer = mesh.face_count() + 1;
  for (const double distance : {0.001, 0.01, 0.03}) {
    const std::size_t faces = faces_within(hull, is_within(distance * reach));
    EXPECT_LT(faces, finer);
    EXPECT_LE(distance_bounds(hull.level(faces), mesh).upper, distance * reach);
    finer = faces;
  }
  EXPECT_EQ(faces_within(hull, is_within(100 * reach)), hull.base_face_count());
  EXPECT_EQ(faces_within(hull, is_within(0)), mesh.face_count());
}

TEST(HullBounds, OfWhatIsNotKnownDoNotHold) {
  const TriangleMesh hull = box({0, 0, 0}, {2, 2, 2}), mesh = box({0, 0, 0}, {1, 1, 1});
  const double nan = std::nan("");
  for (const double volume : {nan, -1.0, 0.0})
    EXPECT_FALSE((HullBounds{.max_void_ratio = 9}.hold(hull, mesh, volume))) << volume;
  EXPECT_FALSE((HullBounds{.max_added_volume = 9}.hold(hull, mesh, nan)));
  EXPECT_TRUE((HullBounds{.max_distance = 2}.hold(hull, mesh, nan)));
  for (const double bound : {nan, -1.0})
    for (const HullBounds& bounds : {HullBounds{.max_distance = bound}, HullBounds{.max_void_ratio = bound},
                                     HullBounds{.max_added_volume = bound}})
      EXPECT_THROW(bounds.hold(hull, mesh, 1), InputError) << bound;
}

TEST(HullBounds, HoldEachByItself) {
  const TriangleMesh inner = box({0, 0, 0}, {4, 4, 4}), outer = box({-1, 0, 0}, {5, 4, 4});  // 64 and 96
  const auto hold = [&](const HullBounds& bounds) { return bounds.hold(outer, inner, 64); };
  EXPECT_TRUE(hold({}));
  EXPECT_FALSE(HullBounds{}.any());
  EXPECT_TRUE(hold({.max_distance = 1.02}));
  EXPECT_FALSE(hold({.max_distance = 0.99}));
  EXPECT_TRUE(hold({.max_void_ratio = 0.5001}));
  EXPECT_FALSE(hold({.max_void_ratio = 0.49}));
  EXPECT_TRUE(hold({.max_added_volume = 32.01}));
  EXPECT_FALSE(hold({.max_added_volume = 31}));
  EXPECT_FALSE(hold({.max_distance = 1.02, .max_void_ratio = 0.1}));
  EXPECT_TRUE((HullBounds{.max_added_volume = 32.01}.hold(inner, outer, 96))) << "an inner hull";
  TriangleMesh twice = outer;
  append(twice, box({-0.5, 1, 1}, {5.5, 2, 2}));  // 6, of which 5.5 lie in the other
  EXPECT_TRUE((HullBounds{.max_added_volume = 32.6}.hold(twice, inner, 64))) << "overlaps count once";
}

}  // namespace
}  // namespace prohull
