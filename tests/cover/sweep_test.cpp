#include "prohull/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/float32.h"
#include "geometry/predicates.h"
#include "input_error.h"
#include "meshes.h"
#include "prohull/error.h"
#include "prohull/union_verification.h"
#include "random.h"

namespace prohull {
namespace {

constexpr double kPi = std::numbers::pi;

using Real = long double;

/// Where the motion has the point at a time: by Rodrigues' formula in long double, which shares nothing with sweep.
Vec3 moved(const RigidMotion& motion, const Vec3& point, Real time) {
  const Vec3 p = placed(motion.start, point);
  const Real length = std::hypot(Real(motion.axis.x), Real(motion.axis.y), Real(motion.axis.z));
  Real u[3], d[3], result[3];
  for (int i = 0; i < 3; ++i) u[i] = Real(motion.axis[i]) / length, d[i] = Real(p[i]) - Real(motion.through[i]);
  const Real c = std::cos(time * Real(motion.angle)), s = std::sin(time * Real(motion.angle));
  const Real along = u[0] * d[0] + u[1] * d[1] + u[2] * d[2];
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Real across = u[j] * d[k] - u[k] * d[j];
    result[i] = Real(motion.through[i]) + time * Real(motion.shift[i]) + c * d[i] + s * across + (1 - c) * along * u[i];
  }
  return {double(result[0]), double(result[1]), double(result[2])};
}

TriangleMesh moved(const RigidMotion& motion, TriangleMesh mesh, Real time) {
  for (Vec3& p : mesh.positions) p = moved(motion, p, time);
  return mesh;
}

bool is_inside(const Vec3& p, const TriangleMesh& polytope) {
  return std::ranges::all_of(polytope.triangles, [&](const auto& t) {
    return side(polytope.positions[t[0]], polytope.positions[t[1]], polytope.positions[t[2]], p) != Side::Outside;
  });
}

bool is_in_one(const Vec3& p, const std::vector<TriangleMesh>& pieces) {
  return std::ranges::any_of(pieces, [&](const TriangleMesh& piece) { return is_inside(p, piece); });
}

/// Of the vertices of the mesh at `count` times, ends included, which no piece holds.
std::size_t outside(const Sweep& sweep, const TriangleMesh& mesh, const RigidMotion& motion, int count) {
  std::size_t outside = 0;
  for (int i = 0; i <= count; ++i)
    for (const Vec3& p : mesh.positions) outside += !is_in_one(moved(motion, p, Real(i) / count), sweep.pieces);
  return outside;
}

Vec3 random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> coordinate(-size, size);
  return {coordinate(random), coordinate(random), coordinate(random)};
}

TEST(Sweep, EnclosesRandomMotionsOfRandomMeshes) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> number(0, 1);
  for (int round = 0; round < 12; ++round) {
    const Vec3 far = random_vector(random, round % 3 == 0 ? 100 : 1);
    const TriangleMesh mesh = meshes::tetrahedron(far, far + random_vector(random, 1), far + random_vector(random, 1),
                                                  far + random_vector(random, round % 4 == 0 ? 1e-3 : 1));
    const Pose start = pose_of_quaternion(1, number(random), number(random), number(random), random_vector(random, 1));
    const RigidMotion motion{.start = start,
                             .through = random_vector(random, 1),
                             .axis = random_vector(random, 3),
                             .angle = 4 * number(random) - 2,
                             .shift = round % 2 == 0 ? Vec3{} : random_vector(random, 2)};
    const SweepOptions options{.max_distance = 0.3, .float32_coordinates = round % 2 == 1};
    const Sweep made = sweep(mesh, {{motion}}, options);
    EXPECT_EQ(outside(made, mesh, motion, 200), 0U) << round;
    for (const double time : {0., 0.1, 0.37, 0.5, 0.93, 1.})
      EXPECT_TRUE(verify_union(made.pieces, moved(motion, mesh, time)).certified) << round << " at " << time;
    if (!options.float32_coordinates) continue;
    for (const TriangleMesh& piece : made.pieces)
      EXPECT_TRUE(std::ranges::all_of(piece.positions, [](const Vec3& p) { return is_float32(p); }));
  }
}

/// Random points of the pieces are no farther from a fine sample of positions than the reach.
TEST(Sweep, ReachesNoFartherThanItSays) {
  std::mt19937 random(test_seed());
  const TriangleMesh mesh = meshes::box({1, -1, 0}, {2, 1, 0.2});
  for (const Vec3& shift : {Vec3{}, Vec3{0, 0, 1}}) {
    const RigidMotion motion{.axis = {0, 0, 1}, .angle = kPi / 2, .shift = shift};
    const Sweep made = sweep(mesh, {{motion}}, {.max_pieces = 1, .max_distance = 0.1});
    EXPECT_LT(made.verdict.distance().upper, 0.1 + 1e-9);
    for (int i = 0; i < 300; ++i) {
      const TriangleMesh& piece = made.pieces[random() % made.pieces.size()];
      const Vec3& p = piece.positions[VertexId(random() % piece.vertex_count())];
      double least = 1e9;
      for (int t = 0; t <= 1000; ++t) {  // by the box in its own frame
        const RigidMotion back{.start = {.translation = -shift * (t / 1000.0)}, .angle = -motion.angle};
        const Vec3 q = moved(back, p, Real(t) / 1000);
        const Vec3 beyond{std::max({1 - q.x, q.x - 2, 0.}), std::max({-1 - q.y, q.y - 1, 0.}),
                          std::max({-q.z, q.z - 0.2, 0.})};
        least = std::min(least, norm(beyond));
      }
      EXPECT_LE(least, made.verdict.distance().upper);
    }
  }
}

// The triangle of both ends alone would leave the arc out; without rounding outwards so would its ends.
TEST(Sweep, HoldsTheArcsOfALongLever) {
  const TriangleMesh mesh = meshes::box({0.1, 0.2, 0.3}, {1000.7, 0.4, 0.5});
  for (const double angle : {kPi / 7, kPi / 2, -2.0, 2 * kPi, 7.0, -40.0}) {
    const RigidMotion motion{.through = {0.3, 0.7, 0.1}, .axis = {0.1, 0.2, 0.3}, .angle = angle};
    const Sweep made = sweep(mesh, {{motion}}, {.max_distance = 1e9});
    EXPECT_EQ(outside(made, mesh, motion, 197), 0U) << angle;
    for (int i = 0; i <= int(made.pieces.size()); ++i)  // where slices meet
      for (const Vec3& p : mesh.positions)
        EXPECT_TRUE(is_in_one(moved(motion, p, Real(i) / Real(made.pieces.size())), made.pieces));
  }
}

TEST(Sweep, OfATranslationIsTheConvexHullOfBothEnds) {
  const RigidMotion motion{.shift = {3, 4, 5}};
  const Sweep made = sweep(meshes::box({0, 0, 0}, {1, 1, 1}), {{motion}});
  ASSERT_EQ(made.pieces.size(), 1U);
  EXPECT_NEAR(signed_volume(made.pieces[0]), 1 + 3 + 4 + 5, 1e-9);
  EXPECT_NEAR(made.volume, 13, 1e-9);
  EXPECT_LT(made.verdict.distance().upper, 1e-9);
  EXPECT_TRUE(made.verdict.encloses_solid == Answer::Yes);
}

TEST(Sweep, OfALongSlantedMotionHasItsVolume) {
  const Sweep made = sweep(meshes::box({0, 0, 0}, {1, 1, 1}), {{{.shift = {0, 1000, 1000}}}});
  EXPECT_NEAR(made.volume, 2001, 1);
}

// A turn of a cube about one of its edges: a quarter of a cylinder between two halves of the cube.
TEST(Sweep, OfManySlicesHasItsVolume) {
  for (const double angle : {kPi / 2, 2 * kPi}) {
    const Sweep made =
        sweep(meshes::box({0, 0, 0}, {1, 1, 1}), {{{.angle = angle}}}, {.max_pieces = 1, .max_distance = 1e-3});
    const double exact = std::min(1 + angle, 2 * kPi);  // the slices add up to 1e-3 times the area of the outside
    EXPECT_GT(made.pieces.size(), 40U);
    EXPECT_LT(made.volume_error, 2e-3 * exact);
    EXPECT_GT(made.volume, exact - 4 * made.volume_error);
    EXPECT_LT(made.volume, exact + 5e-3 + 4 * made.volume_error);
  }
}

TEST(Sweep, OfAMotionThatStandsStillIsTheCover) {
  for (const double angle : {0., 1e-300}) {
    const RigidMotion still{.axis = {0, 1, 0}, .angle = angle};
    const Sweep made = sweep(meshes::box({0, 0, 0}, {1, 1, 1}), {{still}});
    ASSERT_EQ(made.pieces.size(), 1U);
    EXPECT_NEAR(signed_volume(made.pieces[0]), 1, 1e-9);
  }
}

// A bar around its own middle makes a disk, in one turn or in many.
TEST(Sweep, OfWholeTurnsIsNoLargerThanThatOfOne) {
  const TriangleMesh bar = meshes::box({-1, -0.1, 0}, {1, 0.1, 0.2});
  const RigidMotion one{.angle = 2 * kPi}, many{.angle = -50};
  const Sweep disk = sweep(bar, {{one}}), same = sweep(bar, {{many}});
  EXPECT_EQ(disk.pieces.size(), same.pieces.size());
  const double exact = kPi * (1 + 0.01) * 0.2;
  EXPECT_GT(disk.volume, exact * 0.99);
  EXPECT_LT(disk.volume, exact * 1.05);
  EXPECT_EQ(outside(same, bar, many, 500), 0U);
}

// An L of two bars turns by a right angle. The volume of what it passes is sampled.
TEST(Sweep, IsHardlyLargerThanWhatIsPassed) {
  const TriangleMesh arm = meshes::box({0, -0.1, 0}, {1, 0.1, 0.2});
  TriangleMesh link = arm;
  append(link, meshes::box({0.8, 0.1, 0}, {1, 0.5, 0.2}));
  const RigidMotion quarter{.through = {0.1, 0, 0}, .angle = kPi / 2};
  const Sweep made = sweep(link, {{quarter}});
  std::mt19937 random(test_seed());
  std::size_t passed = 0, enclosed = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 p = random_vector(random, 1.2);
    const Vec3 at{p.x, p.y, 0.1};
    const bool is_passed = [&] {
      for (int t = 0; t <= 500; ++t) {
        const Vec3 q = moved({.through = quarter.through, .angle = -quarter.angle}, at, Real(t) / 500);
        if (std::abs(q.y) <= 0.1 && q.x >= 0 && q.x <= 1) return true;
        if (q.x >= 0.8 && q.x <= 1 && q.y >= 0.1 && q.y <= 0.5) return true;
      }
      return false;
    }();
    passed += is_passed, enclosed += is_in_one(at, made.pieces);
    EXPECT_TRUE(!is_passed || is_in_one(at, made.pieces));
  }
  EXPECT_LT(double(enclosed), 1.05 * double(passed));
}

Defect defect_of(const TriangleMesh& mesh, const std::vector<RigidMotion>& motions, const SweepOptions& options = {}) {
  return error_of([&] { sweep(mesh, motions, options); }).defect();
}

TEST(Sweep, RefusesWhatIsNoMotion) {
  const TriangleMesh box = meshes::box({0, 0, 0}, {1, 1, 1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(defect_of({}, {{.angle = 1}}), Defect::EmptyMesh);
  EXPECT_EQ(defect_of(box, {}), Defect::InvalidOption);
  EXPECT_EQ(defect_of(box, {{.axis = {}, .angle = 1}}), Defect::InvalidOption);
  EXPECT_EQ(defect_of(box, {{.angle = nan}}), Defect::NonFiniteCoordinate);
  EXPECT_EQ(defect_of(box, {{.angle = 1e9}}), Defect::NonFiniteCoordinate);
  EXPECT_EQ(defect_of(box, {{.shift = {nan, 0, 0}}}), Defect::NonFiniteCoordinate);
  EXPECT_EQ(defect_of(box, {{.through = {1e101, 0, 0}, .angle = 1}}), Defect::NonFiniteCoordinate);
  EXPECT_EQ(defect_of(box, {{.angle = 1}}, {.max_distance = nan}), Defect::InvalidOption);
  EXPECT_EQ(defect_of(box, {{.angle = 1}}, {.max_distance = 1e-9}), Defect::InvalidOption);
  EXPECT_EQ(defect_of(box, {{.shift = {1e39, 0, 0}}}, {.float32_coordinates = true}), Defect::NonFiniteCoordinate);
  EXPECT_EQ(defect_of(box, std::vector<RigidMotion>(1'000'000)), Defect::InvalidOption);
}

TEST(Sweep, OfHugeAndOfFlatMeshesEncloses) {
  const RigidMotion motion{.axis = {1, 2, 3}, .angle = 1};
  const TriangleMesh huge = meshes::tetrahedron({1e90, 0, 0}, {0, 1e90, 0}, {0, 0, 1e90}, {0, 0, 0});
  EXPECT_EQ(outside(sweep(huge, {{motion}}), huge, motion, 50), 0U);
  const TriangleMesh flat = meshes::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  for (const Vec3& axis : {Vec3{1, 2, 3}, Vec3{0, 0, 1}}) {  // in the second case all stays in the plane
    const RigidMotion turn{.axis = axis, .angle = 1};
    for (const bool float32 : {false, true})
      EXPECT_EQ(outside(sweep(flat, {{turn}}, {.float32_coordinates = float32}), flat, turn, 50), 0U);
  }
}

TEST(Sweep, IsTheSameForAnyNumberOfThreads) {
  const RigidMotion motion{.angle = 1, .shift = {1, 2, 3}};
  const TriangleMesh mesh = meshes::torus(12, 6);
  EXPECT_EQ(sweep(mesh, {{motion}}, {.max_pieces = 3, .threads = 1}).pieces,
            sweep(mesh, {{motion}}, {.max_pieces = 3}).pieces);
}

TEST(Sweep, TellsOfTrianglesThatAreNotFinite) {
  TriangleMesh mesh = meshes::box({0, 0, 0}, {1, 1, 1});
  mesh.positions.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  mesh.triangles.push_back({VertexId{0}, VertexId{1}, VertexId{8}});
  const Sweep made = sweep(mesh, {{{.shift = {0, 0, 1}}}});
  ASSERT_FALSE(made.notes.empty());
  EXPECT_EQ(made.notes.back(), "triangles with corners that are not finite were left out: 1");
}

}  // namespace
}  // namespace prohull
