#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "effort.h"
#include "few_trials.h"
#include "geometry/float32.h"
#include "prohull/collide.h"
#include "prohull/convex_hull.h"
#include "prohull/distance.h"
#include "prohull/enclosing_hull.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/sample.h"
#include "prohull/verification.h"
#include "random.h"
#include "soups.h"

namespace prohull {
namespace {

using namespace meshes;

/// How often a mesh winds around a point off its surface: the sum of the solid angles of its faces.
double winding_number(const TriangleMesh& mesh, const Vec3& p) {
  double sum = 0;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    const Vec3 a = t.a - p, b = t.b - p, c = t.c - p;
    const double x = norm(a), y = norm(b), z = norm(c);
    sum += std::atan2(dot(a, cross(b, c)), x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y);
  }
  return sum / (2 * std::numbers::pi);
}

/// By other means than those of the construction: points near the triangles are inside, and no face is.
void expect_padding(const TriangleMesh& triangles, const EnclosingHull& hull, double padding, SoupMaker& random) {
  ASSERT_TRUE(hull.certified);
  EXPECT_EQ(hull.verdict.proof, "padding");
  EXPECT_GE(hull.padding, padding);
  EXPECT_FALSE(hull.levels);
  const CollisionIndex surface(hull.mesh, StandsFor::Surface), parts(soup(triangles), StandsFor::Surface);
  EXPECT_GE(separation(surface, {}, parts, {}).lower, padding);
  for (int i = 0; i < rounds(100); ++i) {
    const FaceId f{static_cast<std::uint32_t>(random.uniform(0, int(triangles.face_count()) - 1))};
    const Triangle t = triangles.triangle(f);
    const double u = random.real(0, 1), v = random.real(0, 1 - u);
    const Vec3 towards{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
    const Vec3 p = t.a + (t.b - t.a) * u + (t.c - t.a) * v + towards * (0.999 * padding / norm(towards));
    ASSERT_GT(winding_number(hull.mesh, p), 0.5) << "at " << p.x << " " << p.y << " " << p.z;
  }
}

EnclosingHull padded(const TriangleMesh& mesh, std::size_t faces, double padding, EnclosingOptions options = {}) {
  options.hull.relax_guards = true;
  options.hull.tight_trials = few_trials;
  options.padding = padding;
  return enclosing_hull(mesh, faces, options);
}

TEST(Padding, OfACubeIsALargerCube) {
  SoupMaker random(test_seed());
  const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1});
  const EnclosingHull hull = padded(cube, 12, 0.25);
  expect_padding(cube, hull, 0.25, random);
  EXPECT_EQ(hull.mesh.face_count(), 12u);
  for (const Vec3& p : hull.mesh.positions)
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(std::abs(p[axis] - 0.5), 0.75, 1e-6);
}

TEST(Padding, OfSamplesIsProven) {
  SoupMaker random(test_seed());
  for (const std::string_view name : {"asteroid", "bracket", "box", "knot", "pony", "sphere", "torus"})
    for (const double share : {0.002, 0.05}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(share));
      const TriangleMesh mesh = make_sample(name, effort<std::size_t>(200, 60));
      const double padding = share * bounding_box(mesh).diagonal();
      expect_padding(mesh, padded(mesh, effort<std::size_t>(60, 40), padding), padding, random);
    }
}

TEST(Padding, OfSoupsIsProven) {
  SoupMaker random(test_seed());
  for (int i = 0; i < effort(10, 6); ++i) {
    const Soup soup = random.soup();
    const double padding = soup.size() * std::pow(10.0, random.real(-4, 0.5));
    SCOPED_TRACE("soup " + std::to_string(i) + " padding " + std::to_string(padding / soup.size()));
    // Where doubles are coarser than the padding is not tested here.
    if (!std::ranges::all_of(soup.mesh.positions, is_finite)) continue;
    if (norm(bounding_box(soup.mesh).center()) > 1e6 * soup.size()) continue;
    expect_padding(soup.mesh, padded(soup.mesh, std::size_t(random.uniform(12, 200)), padding), padding, random);
  }
}

TEST(Padding, ClosesWhatIsNarrowerThanTwiceOfIt) {
  SoupMaker random(test_seed());
  const TriangleMesh ring = torus(24, 12);  // its hole is 1.2 wide
  const TriangleMesh pair = together(box({0, 0, 0}, {1, 1, 1}), box({1.1, 0, 0}, {2, 1, 1}));
  for (const TriangleMesh& mesh : {ring, pair})
    for (const double padding : {0.04, 0.2, 0.7, 5.0}) {
      SCOPED_TRACE(padding);
      const EnclosingHull hull = padded(mesh, 200, padding);
      expect_padding(mesh, hull, padding, random);
      EXPECT_EQ(hull.self_intersections, 0u);
      EXPECT_LE(signed_volume(hull.mesh), 1.1 * signed_volume(padded_convex_hull(mesh, padding)));
    }
}

// A hull that keeps the larger gap keeps the smaller one, too. The last digits of a gap once decided whether a wrap
// came down to so few faces.
TEST(Padding, ThatIsSmallerNeedsHardlyMoreVoid) {
  const TriangleMesh bracket = make_sample("bracket", 1000);
  double least = std::numeric_limits<double>::infinity();
  for (const double gap : {0.08, 0.0625, 0.05}) {
    const double ratio = padded(bracket, 60, gap).void_ratio;
    EXPECT_LT(1 + ratio, 1.2 * (1 + least)) << gap;
    least = std::min(least, ratio);
  }
}

// Hulls that keep away from the triangles while they are built had a void of 53 %, where that without a gap has 13.
TEST(Padding, ThatIsTinyNeedsHardlyMoreVoidThanNone) {
  const TriangleMesh bracket = make_sample("bracket", 3000);
  for (const double gap : {1e-30, 1e-5}) EXPECT_LT(padded(bracket, 100, gap).void_ratio, 0.2) << gap;
}

TEST(Padding, OfNeedlesAndSheetsIsProven) {
  SoupMaker random(test_seed());
  const TriangleMesh needle = tetrahedron({0, 0, 0}, {0, 1e-3, 0}, {0, 0, 1e-3}, {1, 0, 0});
  const TriangleMesh triangle = make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const TriangleMesh segment = make({{0, 0, 0}, {1, 2, 3}}, {{0, 1, 1}});
  for (const TriangleMesh& mesh : {signed_volume(needle) > 0 ? needle : inside_out(needle), triangle, segment})
    for (const double padding : {0.01, 0.5}) {
      SCOPED_TRACE(padding);
      expect_padding(mesh, padded(mesh, 100, padding), padding, random);
    }
}

TEST(Padding, HoldsForTheCoordinatesOfTheFile) {
  SoupMaker random(test_seed());
  const TriangleMesh mesh = make_sample("pony", effort<std::size_t>(200, 80));
  const double diagonal = bounding_box(mesh).diagonal();
  for (const double away : effort<std::vector<double>>({0.0, 100.0}, {100.0}))
    for (const double padding : {1e-4 * diagonal, 0.02 * diagonal}) {
      SCOPED_TRACE(std::to_string(away) + " " + std::to_string(padding));
      const TriangleMesh there = moved(mesh, Vec3{1, -2, 3} * (away * diagonal));
      const EnclosingHull hull =
          padded(there, effort<std::size_t>(100, 80), padding, {.hull = {.float32_coordinates = true}});
      expect_padding(there, hull, padding, random);
      EXPECT_TRUE(std::ranges::all_of(hull.mesh.positions, is_float32));
    }
}

TEST(Padding, IsKeptByTightHullsAndWithBounds) {
  SoupMaker random(test_seed());
  const TriangleMesh mesh = make_sample("asteroid", effort<std::size_t>(200, 80));
  const double diagonal = bounding_box(mesh).diagonal(), padding = 0.02 * diagonal;
  for (const Repair repair : {Repair::Auto, Repair::Wrap}) {
    const EnclosingHull tight = padded(mesh, 60, padding, {.tight = true, .repair = repair});
    expect_padding(mesh, tight, padding, random);
    EXPECT_LT(signed_volume(tight.mesh), 1.03 * signed_volume(padded(mesh, 60, padding, {.repair = repair}).mesh));
    const EnclosingHull near = padded(mesh, 20, padding, {.bounds = {.max_distance = 2 * padding}, .repair = repair});
    expect_padding(mesh, near, padding, random);
    EXPECT_TRUE(near.within_bounds);
    EXPECT_LE(distance_bounds(near.mesh, mesh).upper, 2 * padding);
  }
}

// No wrap with that padding is as fine as half of what is left of the distance.
TEST(Padding, MayBeNearlyTheLargestDistance) {
  const TriangleMesh mesh = make_sample("bracket", effort<std::size_t>(200, 80));
  const double padding = 0.03 * bounding_box(mesh).diagonal();
  for (const Repair repair : {Repair::Auto, Repair::Wrap})
    EXPECT_TRUE(padded(mesh, 20, padding, {.bounds = {.max_distance = 1.1 * padding}, .repair = repair}).certified);
}

TEST(Padding, IsLessThanTheLargestDistance) {
  const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1});
  EXPECT_THROW(padded(cube, 12, 0.2, {.bounds = {.max_distance = 0.2}}), InputError);
  // The convex hull moved away has corners that are sqrt(3) times as far.
  const EnclosingHull hull = padded(cube, 12, 0.1, {.bounds = {.max_distance = 0.17}, .repair = Repair::None});
  EXPECT_FALSE(hull.within_bounds);
}

TEST(Padding, CountsForBoundsOfTheVoid) {
  const TriangleMesh mesh = make_sample("asteroid", effort<std::size_t>(500, 80));
  const EnclosingHull hull =
      padded(mesh, 20, 0.005 * bounding_box(mesh).diagonal(), {.bounds = {.max_void_ratio = 0.3}});
  EXPECT_TRUE(hull.within_bounds);
  EXPECT_LE(hull.void_ratio, 0.3);
}

// Two blocks: the gap between them is narrower than two paddings, and faces of either would pass through the other's.
// Its coarse levels pass through themselves when they move away by the gap.
TEST(Padding, WithABoundMayNeedAFinerLevel) {
  const TriangleMesh bracket = make_sample("bracket", 500);
  const EnclosingHull hull = padded(bracket, 60, 0.1, {.bounds = {.max_void_ratio = 0.633}});
  EXPECT_TRUE(hull.within_bounds);
  EXPECT_EQ(hull.source, Source::Mesh);
  EXPECT_LE(hull.mesh.face_count(), bracket.face_count());
}

TEST(Padding, OfTightHullsOfNarrowGapsIsProven) {
  SoupMaker random(test_seed());
  const TriangleMesh mesh = together(box({0, 0, 0}, {1, 1, 1}), box({1.03, 0, 0}, {2, 1, 1}));
  const EnclosingHull hull = padded(mesh, 300, 0.02, {.tight = true});
  expect_padding(mesh, hull, 0.02, random);
  EXPECT_EQ(hull.self_intersections, 0u);
}

/// The void of a hull by that between the mesh and its offset surface. The torus has the radii 1 and `tube`.
double void_by_least(const TriangleMesh& torus_mesh, const EnclosingHull& hull, double tube, double gap) {
  constexpr double kPi = std::numbers::pi;
  const double ideal = 2 * kPi * kPi, volume = signed_volume(torus_mesh);
  const double least = ideal * std::abs((tube + gap) * (tube + gap) - tube * tube);
  return std::abs(signed_volume(hull.mesh) - volume) / least;
}

TEST(Padding, OfTightHullsIsHardlyMoreThanTheOffsetSurface) {
  constexpr double kTube = 0.4;
  const TriangleMesh ring = torus(80, 40);
  const double gap = 0.02 * bounding_box(ring).diagonal();
  EXPECT_LT(void_by_least(ring, padded(ring, 1000, gap, {.tight = true}), kTube, gap), 1.055)
      << "a hull that is not tight has 1.060";
}

EnclosingHull inner(const TriangleMesh& mesh, std::size_t faces, double padding, EnclosingOptions options = {}) {
  options.hull.side = HullSide::Inner;
  return padded(mesh, faces, padding, options);
}

void expect_gap_inside(const TriangleMesh& mesh, const EnclosingHull& hull, double gap) {
  ASSERT_TRUE(hull.certified);
  EXPECT_EQ(hull.verdict.proof, "padding");
  EXPECT_EQ(hull.self_intersections, 0u);
  EXPECT_GT(signed_volume(hull.mesh), 0);
  EXPECT_TRUE(verify_hull(hull.mesh, mesh, HullSide::Inner, {.gap = gap}).certified);
}

TEST(Padding, InsideOfACubeIsASmallerCube) {
  const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1});
  const EnclosingHull hull = inner(cube, 12, 0.25);
  expect_gap_inside(cube, hull, 0.25);
  EXPECT_NEAR(signed_volume(hull.mesh), 0.125, 1e-5);
}

TEST(Padding, InsideOfSamplesIsProven) {
  for (const std::string_view name : {"bracket", "pony"})
    for (const double share : {0.001, 0.01}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(share));
      const TriangleMesh mesh = make_sample(name, effort<std::size_t>(300, 100));
      const double gap = share * bounding_box(mesh).diagonal();
      expect_gap_inside(mesh, inner(mesh, effort<std::size_t>(80, 60), gap), gap);
    }
}

// Inner hulls that keep away from the triangles while they are built lost 26.6 % with a gap of 0.05 % of the diagonal.
TEST(Padding, InsideThatIsTinyLosesHardlyMoreThanNone) {
  const TriangleMesh mesh = make_sample("asteroid", 1500);
  const double gap = 0.0005 * bounding_box(mesh).diagonal();
  EXPECT_GT(inner(mesh, 60, gap).void_ratio, inner(mesh, 60, 0).void_ratio - 0.02);
}

TEST(Padding, InsideLeavesOutWhatIsThin) {
  // A cube, and a plate beside it that is 0.1 thick.
  const TriangleMesh mesh = together(box({0, 0, 0}, {1, 1, 1}), box({2, 0, 0}, {2.1, 1, 1}));
  const EnclosingHull hull = inner(mesh, 200, 0.2);
  expect_gap_inside(mesh, hull, 0.2);
  EXPECT_LT(bounding_box(hull.mesh).max.x, 1);
}

TEST(Padding, InsideOfWhatIsTooThinIsRefused) {
  try {
    inner(box({0, 0, 0}, {1, 1, 1}), 100, 0.6);
    FAIL() << "there is no room";
  } catch (const InputError& error) {
    EXPECT_NE(std::string_view(error.what()).find("thicker than twice the gap"), std::string_view::npos)
        << error.what();
  }
}

TEST(Padding, InsideIsKeptByTightHullsAndFloat32) {
  const TriangleMesh mesh = make_sample("asteroid", effort<std::size_t>(500, 100));
  const double gap = 0.01 * bounding_box(mesh).diagonal();
  expect_gap_inside(mesh, inner(mesh, 80, gap, {.tight = true}), gap);
  const EnclosingHull stored = inner(mesh, 80, gap, {.hull = {.float32_coordinates = true}});
  expect_gap_inside(mesh, stored, gap);
  EXPECT_TRUE(std::ranges::all_of(stored.mesh.positions, is_float32));
}

TEST(Padding, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = make_sample("pony", effort<std::size_t>(1000, 300));
  const TriangleMesh one = padded(mesh, 100, 0.05, {.hull = {.threads = 1}}).mesh;
  EXPECT_EQ(padded(mesh, 100, 0.05, {.hull = {.threads = 3}}).mesh, one);
}

TEST(Padding, IsRefusedWhereItMeansNothing) {
  EXPECT_THROW(padded(octahedron(), 100, -1), InputError);
  EXPECT_THROW(padded(octahedron(), 100, std::numeric_limits<double>::infinity()), InputError);
  EXPECT_THROW(padded(octahedron(), 100, 1e38, {.hull = {.float32_coordinates = true}}), InputError);
  EXPECT_THROW(padded(octahedron(), 100, 1, {.levels = true}), InputError);
}

}  // namespace
}  // namespace prohull
