// Whether a hull keeps a distance from its original: the verdict is exact, and says where it is not kept.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "effort.h"
#include "meshes.h"
#include "prohull/collide.h"
#include "prohull/enclosing_hull.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "prohull/sample.h"
#include "prohull/verification.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

const TriangleMesh kCube = box({0, 0, 0}, {1, 1, 1}), kLarge = box({-0.25, -0.25, -0.25}, {1.25, 1.25, 1.25});

double above(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

Verification verified(const TriangleMesh& hull, const TriangleMesh& original, double gap,
                      HullSide side = HullSide::Outer) {
  return verify_hull(hull, original, side, {.gap = gap});
}

TEST(VerifyGap, IsKeptByAHullPreciselySoFarAway) {
  const Verification found = verified(kLarge, kCube, 0.25);
  EXPECT_TRUE(found.encloses && found.keeps_gap && found.certified);
  EXPECT_NEAR(found.least_distance, 0.25, 1e-12);
  const Verification more = verified(kLarge, kCube, above(0.25));
  EXPECT_TRUE(more.encloses);
  EXPECT_FALSE(more.keeps_gap || more.certified);
  EXPECT_EQ(more.faces_too_near, 12u);
  EXPECT_NE(more.why_not.find("12 faces"), std::string::npos) << more.why_not;
}

TEST(VerifyGap, IsKeptByAnInnerHull) {
  EXPECT_TRUE(verified(kCube, kLarge, 0.25, HullSide::Inner).certified);
  EXPECT_FALSE(verified(kCube, kLarge, above(0.25), HullSide::Inner).certified);
  const Verification outside = verified(kLarge, kCube, 0.25, HullSide::Inner);
  EXPECT_TRUE(outside.keeps_gap) << "but on the wrong side";
  EXPECT_FALSE(outside.certified);
}

TEST(VerifyGap, IsUndecidedAfterAsManyStepsAsAreAllowed) {
  const Verification found = verify_hull(kLarge, kCube, HullSide::Outer, {.gap = 0.25, .max_steps = 50});
  EXPECT_TRUE(found.encloses);
  EXPECT_FALSE(found.keeps_gap || found.certified || found.gap);
  EXPECT_EQ(found.faces_too_near, 0U);
  EXPECT_GT(found.faces_undecided, 0U);
  EXPECT_LT(found.faces_undecided, kLarge.face_count());
  EXPECT_TRUE(std::isnan(found.least_distance));
  EXPECT_NE(found.why_not.find("ended before"), std::string::npos) << found.why_not;
  const Verification near = verify_hull(kLarge, kCube, HullSide::Outer, {.gap = 0.3, .max_steps = 50});
  EXPECT_GT(near.faces_too_near, 0U) << "one face is a no";
  EXPECT_GT(near.faces_undecided, 0U);
}

TEST(VerifyGap, SaysWhereItIsNotKept) {
  TriangleMesh hull = subdivided(kLarge);
  const VertexId pushed{3};
  Vec3& p = hull.positions[pushed];
  const Vec3 nearest{std::clamp(p.x, 0.0, 1.0), std::clamp(p.y, 0.0, 1.0), std::clamp(p.z, 0.0, 1.0)};
  p = nearest + (p - nearest) * 0.5;
  const Verification found = verified(hull, kCube, 0.25);
  ASSERT_FALSE(found.keeps_gap);
  ASSERT_FALSE(found.nearest.empty());
  EXPECT_LE(found.nearest.size(), VerificationOptions{}.max_offenders);
  EXPECT_NEAR(found.nearest[0].distance, found.least_distance, 1e-15);
  for (const NearFace& near : found.nearest) {
    EXPECT_LT(near.distance, 0.25);
    const auto& corners = hull.triangles[near.face];
    EXPECT_NE(std::ranges::find(corners, pushed), corners.end());
  }
}

TEST(VerifyGap, FacesThatMeetAreAtNoDistance) {
  const TriangleMesh crossing = box({0.5, -1, -1}, {3, 3, 3});
  const Verification found = verified(crossing, kCube, 0.125);
  EXPECT_FALSE(found.encloses || found.keeps_gap);
  EXPECT_EQ(found.least_distance, 0);
  EXPECT_EQ(verified(kCube, kCube, 1e-300).least_distance, 0);
  EXPECT_FALSE(verified(kCube, kCube, 1e-300).keeps_gap);
}

// One vertex, as little nearer as a double can tell, is found; so is the last step back.
TEST(VerifyGap, FindsAVertexThatIsOneUlpTooNear) {
  std::mt19937 random(test_seed());
  const TriangleMesh hull = subdivided(subdivided(kLarge));
  for (int i = 0; i < effort(20, 5); ++i) {
    TriangleMesh moved = hull;
    const VertexId v{static_cast<std::uint32_t>(random() % hull.vertex_count())};
    for (int axis = 0; axis < 3; ++axis) {
      double& x = moved.positions[v][axis];
      const bool is_beside = x == -0.25 || x == 1.25;
      if (is_beside) x = std::nextafter(x, 0.5);
    }
    // Only where the nearest point of the cube lies in a face is the distance that of one coordinate.
    const Vec3& p = hull.positions[v];
    const int beyond = (p.x < 0 || p.x > 1) + (p.y < 0 || p.y > 1) + (p.z < 0 || p.z > 1);
    if (beyond != 1) continue;
    EXPECT_TRUE(verified(hull, kCube, 0.25).keeps_gap);
    EXPECT_FALSE(verified(moved, kCube, 0.25).keeps_gap) << "vertex " << index(v);
  }
}

TEST(VerifyGap, AgreesWithTheProvenDistanceOfMeshes) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> growth(1.05, 1.6), shift(-0.05, 0.05);
  const TriangleMesh mesh = make_sample("asteroid", effort<std::size_t>(600, 80));
  const Vec3 center = bounding_box(mesh).center();
  for (int i = 0; i < effort(12, 3); ++i) {
    TriangleMesh hull = mesh;
    const double factor = growth(random);
    for (Vec3& p : hull.positions) p = center + (p - center) * factor + Vec3{shift(random), shift(random), 0};
    const Separation s =
        separation(CollisionIndex(hull, StandsFor::Surface), {}, CollisionIndex(mesh, StandsFor::Surface), {});
    EXPECT_FALSE(verified(hull, mesh, above(s.upper)).keeps_gap);
    if (s.lower == 0) continue;
    const Verification found = verified(hull, mesh, s.lower);
    EXPECT_TRUE(found.keeps_gap);
    EXPECT_NEAR(found.least_distance, s.upper, 1e-12);
  }
}

TriangleMesh times_power_of_2(TriangleMesh mesh, int exponent) {
  for (Vec3& p : mesh.positions) p = p * std::ldexp(1.0, exponent);
  return mesh;
}

// From 1e-150 to 1e100. Squares of normals of the small ones are 0 in double precision, those of the large ones
// infinite.
TEST(VerifyGap, IsDecidedInEveryUnit) {
  for (int exponent = -498; exponent <= 331; exponent += 10) {
    const TriangleMesh hull = times_power_of_2(kLarge, exponent), cube = times_power_of_2(kCube, exponent);
    const double gap = std::ldexp(0.25, exponent);
    EXPECT_TRUE(verified(hull, cube, gap).certified) << exponent;
    EXPECT_FALSE(verified(hull, cube, above(gap)).keeps_gap) << exponent;
    EXPECT_LE(verified(hull, cube, above(gap)).least_distance, above(gap)) << exponent;
    EXPECT_FALSE(verified(hull, cube, 1e100).keeps_gap) << exponent;
    EXPECT_EQ(verified(hull, cube, gap).least_distance,
              std::ldexp(verified(kLarge, kCube, 0.25).least_distance, exponent));
  }
}

TEST(VerifyGap, IsOfEveryTriangleOfAnOriginalThatIsNotClosed) {
  const TriangleMesh stray = together(kCube, make({{0.5, 0.5, 1.2}, {0.6, 0.5, 1.2}, {0.5, 0.6, 1.2}}, {{0, 1, 2}}));
  EXPECT_TRUE(verified(kLarge, stray, 0.04).certified);
  EXPECT_FALSE(verified(kLarge, stray, 0.06).certified);
}

TEST(VerifyGap, IsRefusedWhereItMeansNothing) {
  for (const double gap : {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(verified(kLarge, kCube, gap), InputError) << gap;
  const ProgressiveHull levels = build_hull(make_sample("sphere", 200), {.target_faces = 100}).hull;
  EXPECT_THROW(verify_hull(levels, levels.original(), {.gap = 0.1}), InputError);
  EXPECT_TRUE(std::isnan(verified(kLarge, kCube, 0).least_distance));
}

}  // namespace
}  // namespace prohull
