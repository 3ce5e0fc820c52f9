#include "prohull/collide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "collide/collision_mesh.h"
#include "effort.h"
#include "geometry/triangle_intersection.h"
#include "input_error.h"
#include "meshes.h"
#include "prohull/error.h"
#include "random.h"

namespace prohull {
namespace {

using meshes::inside_out;
using meshes::make;
using meshes::moved;
using meshes::octahedron;
using meshes::scaled;
using meshes::sphere;
using meshes::together;

Pose at(const Vec3& translation) { return {.translation = translation}; }

bool collide(const TriangleMesh& a, const TriangleMesh& b, const Pose& pose_b = {}) {
  const CollisionIndex index_a(a), index_b(b);
  const bool answer = prohull::collide(index_a, {}, index_b, pose_b);
  EXPECT_EQ(prohull::collide(index_b, pose_b, index_a, {}), answer);
  EXPECT_EQ(separation(index_a, {}, index_b, pose_b).collide(), answer);
  return answer;
}

std::vector<FacePair> pairs(const TriangleMesh& a, const TriangleMesh& b, const Pose& pose_b = {}) {
  return intersecting_faces(CollisionIndex(a), {}, CollisionIndex(b), pose_b);
}

template <class Call>
Defect defect_of(Call call) {
  return error_of(call).defect();
}

class RandomPoses {
 public:
  explicit RandomPoses(unsigned seed) : random_(seed) {}

  /// Within `reach` of the origin in each coordinate.
  Pose next(double reach) {
    const auto number = [&] { return std::uniform_real_distribution(-1.0, 1.0)(random_); };
    const double w = number(), x = number(), y = number(), z = number();
    return pose_of_quaternion(w, x, y, z, Vec3{number(), number(), number()} * reach);
  }

 private:
  std::mt19937 random_;
};

std::vector<FacePair> all_touching(const TriangleMesh& a, const TriangleMesh& b) {
  std::vector<FacePair> pairs;
  for (const FaceId f : a.triangles.ids())
    for (const FaceId g : b.triangles.ids())
      if (triangles_touch(a.triangle(f), b.triangle(g))) pairs.push_back({f, g});
  return pairs;
}

TEST(Collide, ApartAndOverlapping) {
  EXPECT_FALSE(collide(octahedron(), octahedron(), at({3, 0, 0})));
  EXPECT_FALSE(collide(octahedron(), octahedron(), at({1.01, 1, 0})));
  EXPECT_TRUE(collide(octahedron(), octahedron(), at({1.5, 0, 0})));
  EXPECT_TRUE(collide(octahedron(), octahedron()));
}

TEST(Collide, TouchingCounts) {
  const double next = std::nextafter(2.0, 3.0);
  EXPECT_TRUE(collide(octahedron(), octahedron(), at({2, 0, 0}))) << "at a vertex";
  EXPECT_FALSE(collide(octahedron(), octahedron(), at({next, 0, 0})));
  EXPECT_TRUE(collide(octahedron(), octahedron(), at({1, 1, 0}))) << "along an edge";
  EXPECT_FALSE(collide(octahedron(), octahedron(), at({1, std::nextafter(1.0, 2.0), 0})));
  const TriangleMesh box = meshes::box({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(collide(box, box, at({1, 0.25, 0.25}))) << "in coplanar faces";
  EXPECT_FALSE(collide(box, box, at({std::nextafter(1.0, 2.0), 0.25, 0.25})));
}

TEST(Collide, OneSolidInsideOfAnotherCounts) {
  const TriangleMesh large = scaled(octahedron(), 10), small = octahedron();
  EXPECT_TRUE(collide(large, small));
  EXPECT_TRUE(pairs(large, small).empty());
  EXPECT_TRUE(collide(together(moved(small, {100, 0, 0}), small), large)) << "the second component only";
}

TEST(Collide, ACavityIsFree) {
  const TriangleMesh hollow = together(scaled(octahedron(), 10), inside_out(scaled(octahedron(), 5)));
  EXPECT_FALSE(collide(hollow, octahedron()));
  EXPECT_TRUE(collide(hollow, octahedron(), at({6, 0, 0}))) << "through the wall of the cavity";
  EXPECT_TRUE(collide(hollow, scaled(octahedron(), 0.1), at({7, 0, 0}))) << "in the wall";
}

TEST(CollisionMesh, WindsAroundNoCornerOfItsBox) {
  const CollisionMesh ball(scaled(sphere(3), 0.99));
  const ObbNode& box = ball.tree.boxes()[0];
  for (const int x : {-1, 1})
    for (const int y : {-1, 1})
      for (const int z : {-1, 1}) {
        const Vec3 sides{x * box.half[0], y * box.half[1], z * box.half[2]};
        Vec3 corner;
        for (int k = 0; k < 3; ++k)
          corner[k] = box.center[k] + dot(Vec3{box.axes[3 * k], box.axes[3 * k + 1], box.axes[3 * k + 2]}, sides);
        const Vec3 up = -corner / norm(corner), across = cross(up, {1, 0, 0}) / norm(cross(up, {1, 0, 0}));
        const Pose through_the_middle{{across, cross(up, across), up}, {}};
        const Vec3 point = ball.tree.center() + corner * (0.98 / ball.tree.unit());
        EXPECT_EQ(ball.winding_number(through_the_middle, at_pose(through_the_middle, point)), 0);
      }
}

TEST(Collide, AnOpenMeshStandsForItsFaces) {
  TriangleMesh open = scaled(octahedron(), 10);
  open.triangles.pop_back();
  EXPECT_FALSE(CollisionIndex(open).is_solid());
  const TriangleMesh cube = meshes::box({0, 0, 0}, {1, 1, 1}), other = meshes::box({5, 0, 0}, {9, 4, 4});
  EXPECT_TRUE(CollisionIndex(meshes::together(cube, meshes::inside_out(other))).is_solid());
  EXPECT_FALSE(CollisionIndex(meshes::inside_out(cube)).is_solid()) << "nothing is inside";
  EXPECT_FALSE(CollisionIndex(meshes::inside_out(meshes::together(cube, other))).is_solid());
  EXPECT_FALSE(collide(open, octahedron()));
  EXPECT_TRUE(collide(open, octahedron(), at({10, 0, 0})));
  TriangleMesh sheet = make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  EXPECT_TRUE(collide(sheet, scaled(octahedron(), 10))) << "a sheet inside of a solid";
  EXPECT_TRUE(collide(sheet, sheet, at({0.5, 0, 0}))) << "coplanar sheets";
  EXPECT_FALSE(collide(sheet, sheet, at({0, 0, 0.5})));
}

TEST(Collide, InsideOutNothingIsInside) { EXPECT_FALSE(collide(inside_out(scaled(octahedron(), 10)), octahedron())); }

TEST(Collide, FacesWithoutAreaCountAsSegmentsAndPoints) {
  const TriangleMesh needle = make({{0, 0, -5}, {0, 0, 5}}, {{0, 1, 1}}), point = make({{0, 0, 1}}, {{0, 0, 0}});
  EXPECT_TRUE(collide(needle, point));
  EXPECT_FALSE(collide(needle, point, at({0, 0x1p-1000, 0})));
  EXPECT_TRUE(collide(point, octahedron()));
}

TEST(Collide, AgreesWithBruteForceInRandomPoses) {
  RandomPoses poses(test_seed());
  const TriangleMesh a = meshes::torus(12, 8), b = meshes::soup(sphere(2));
  const CollisionIndex index_a(a), index_b(b);
  int hits = 0;
  for (int i = 0; i < rounds(200); ++i) {
    const PosePair at{poses.next(1), poses.next(1)};
    const auto expected = all_touching(placed(at.a, a), placed(at.b, b));
    EXPECT_EQ(intersecting_faces(index_a, at.a, index_b, at.b), expected);
    EXPECT_TRUE(expected.empty() || prohull::collide(index_a, at.a, index_b, at.b));
    hits += !expected.empty();
  }
  EXPECT_GT(hits, 0);
}

/// Where the same corner is told apart or not by its last bit.
TEST(Collide, AgreesWithBruteForceNearContactAndFarAway) {
  RandomPoses poses(test_seed() + 1);
  const TriangleMesh mesh = sphere(1);
  const CollisionIndex index(mesh);
  for (const double far : {0.0, 1e3, 1e9, 1e15})
    for (int i = 0; i < rounds(50); ++i) {
      PosePair at{poses.next(far), {}};
      at.b = at.a;
      const Vec3 direction = at.a.rotation[static_cast<unsigned>(i % 3)];
      at.b.translation += direction * 2;
      const auto expected = all_touching(placed(at.a, mesh), placed(at.b, mesh));
      EXPECT_EQ(intersecting_faces(index, at.a, index, at.b), expected);
      // Rounding may tilt a solid by a few bits, but it cannot swallow another one of its size.
      EXPECT_TRUE(far >= 1e15 || prohull::collide(index, at.a, index, at.b) == !expected.empty());
    }
}

TEST(Collide, MeshesOfVeryDifferentSizes) {
  const TriangleMesh large = sphere(2);
  for (const double size : {1e-3, 1e-30, 1e-80, 1e60}) {
    const TriangleMesh small = scaled(octahedron(), size);
    EXPECT_TRUE(collide(large, small));
    EXPECT_FALSE(collide(large, small, at({2 * size + 2, 0, 0})));
    EXPECT_FALSE(pairs(large, scaled(octahedron(), 1e-20), at(large.triangle(FaceId(7)).a)).empty());
  }
  EXPECT_TRUE(collide(scaled(octahedron(), 1e-200), scaled(octahedron(), 1e-200), at({2e-200, 0, 0})));
}

TEST(Pose, OfAQuaternionOfAnyLength) {
  for (const double length : {1e-300, 1e-160, 1.0, 1e160, 1e300})
    EXPECT_LT(norm(pose_of_quaternion(length, length, 0, 0, {}).rotation[1] - Vec3{0, 0, -1}), 1e-15) << length;
}

TEST(MayCollide, IsSaidWhereverTheEnclosedMeshesCollide) {
  RandomPoses poses(test_seed() + 3);
  const TriangleMesh mesh = sphere(2);
  const CollisionIndex plain(mesh), outer(scaled(octahedron(), 1.8));
  int surely_free = 0, hits = 0;
  for (int i = 0; i < rounds(300); ++i) {
    const PosePair at{poses.next(1.5), poses.next(1.5)};
    const bool expected = prohull::collide(plain, at.a, plain, at.b);
    const bool may = may_collide(outer, at.a, outer, at.b);
    EXPECT_TRUE(may || !expected);
    surely_free += !may, hits += expected;
  }
  EXPECT_GT(surely_free, 0);
  EXPECT_GT(hits, 0);
}

TEST(MayCollide, LeavesRoomForRounding) {
  const CollisionIndex box(meshes::box({0, 0, 0}, {1, 1, 1}));
  EXPECT_FALSE(may_collide(box, {}, box, at({1 + 0x1p-40, 0, 0})));
  EXPECT_TRUE(may_collide(box, {}, box, at({1 + 0x1p-52, 0, 0}))) << "nearer than rounding may move vertices";
  EXPECT_TRUE(may_collide(box, {}, CollisionIndex(meshes::box({-5, -5, -5}, {5, 5, 5})), {})) << "inside";
  const CollisionIndex sheet(make({{0, 0, 9}, {1, 0, 9}, {0, 1, 9}}, {{0, 1, 2}}));
  EXPECT_EQ(defect_of([&] { may_collide(box, {}, sheet, {}); }), Defect::OpenEdge);
}

Vec3 point_of(const Triangle& t, double u, double v) {
  return u + v <= 1 ? t.a + (t.b - t.a) * u + (t.c - t.a) * v : point_of(t, 1 - u, 1 - v);
}

TEST(Separation, BoundsHoldAndAreClose) {
  RandomPoses poses(test_seed() + 2);
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> fraction(0, 1);
  const TriangleMesh a = meshes::torus(10, 6), b = sphere(1);
  const CollisionIndex index_a(a), index_b(b);
  for (int i = 0; i < rounds(100); ++i) {
    const PosePair at{poses.next(3), poses.next(3)};
    const TriangleMesh placed_a = placed(at.a, a), placed_b = placed(at.b, b);
    const Separation found = separation(index_a, at.a, index_b, at.b);
    EXPECT_EQ(found.collide(), prohull::collide(index_a, at.a, index_b, at.b));
    if (found.collide()) continue;
    EXPECT_LE(found.lower, found.upper);
    EXPECT_LT(found.upper - found.lower, 1e-11);
    EXPECT_NEAR(norm(found.point_b - found.point_a), found.upper, 1e-12);
    double nearest = std::numeric_limits<double>::infinity();
    for (const FaceId f : placed_a.triangles.ids())
      for (const FaceId g : placed_b.triangles.ids())
        nearest = std::min(nearest, norm(point_of(placed_a.triangle(f), fraction(random), fraction(random)) -
                                         point_of(placed_b.triangle(g), fraction(random), fraction(random))));
    EXPECT_LE(found.lower, nearest);
  }
}

TEST(Separation, IsLookedForUpToALimit) {
  const CollisionIndex box(meshes::box({0, 0, 0}, {1, 1, 1}));
  const Pose away = at({3, 0, 0});
  const Separation exact = separation(box, {}, box, away);
  const Separation near = separation(box, {}, box, away, exact.upper * 1.5);
  EXPECT_EQ(near.lower, exact.lower);
  EXPECT_EQ(near.upper, exact.upper);
  const Separation far = separation(box, {}, box, away, exact.lower / 2);
  EXPECT_EQ(far.lower, exact.lower / 2);
  EXPECT_EQ(far.upper, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(separation(box, {}, box, {}, 1e-9).collide());
}

TEST(Separation, OfKnownDistance) {
  const CollisionIndex box(meshes::box({0, 0, 0}, {1, 1, 1}));
  const auto expect = [&](const Vec3& offset, double distance) {
    const Separation found = separation(box, {}, box, at(offset));
    EXPECT_LE(found.lower, distance);
    EXPECT_GE(found.upper, distance);
    EXPECT_NEAR(found.lower, found.upper, 1e-12 * distance);
  };
  expect({3, 0.5, 0.5}, 2);                  // faces
  expect({4, 5, 0.5}, 5);                    // edges
  expect({3, 4, 5}, std::sqrt(4 + 9 + 16));  // corners
  expect({1e30, 0, 0}, 1e30);
}

TEST(Collide, BatchesAreTheSameForAnyNumberOfThreads) {
  RandomPoses random(test_seed());
  std::vector<PosePair> poses;
  for (int i = 0; i < rounds(300); ++i) poses.push_back({random.next(1), random.next(1)});
  const CollisionIndex a(meshes::torus(12, 8)), b(sphere(2));
  const std::vector<bool> one = prohull::collide(a, b, poses, {.threads = 1}),
                          two = prohull::collide(a, b, poses, {.threads = 2});
  EXPECT_EQ(one, two);
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_EQ(one[i], prohull::collide(a, poses[i].a, b, poses[i].b));
  EXPECT_THROW(prohull::collide(a, b, poses, {.threads = 1, .progress = [](auto, double) { return false; }}),
               Cancelled);
}

TEST(Collide, RefusesBadInput) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(defect_of([] { CollisionIndex({}); }), Defect::EmptyMesh);
  EXPECT_EQ(defect_of([&] { CollisionIndex(moved(octahedron(), {nan, 0, 0})); }), Defect::NonFiniteCoordinate);
  EXPECT_EQ(defect_of([&] { CollisionIndex(scaled(octahedron(), 1e101)); }), Defect::NonFiniteCoordinate);
  const CollisionIndex index(octahedron());
  const auto defect = [&](const Pose& pose) { return defect_of([&] { prohull::collide(index, {}, index, pose); }); };
  EXPECT_EQ(defect({{Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, {}}), Defect::InvalidOption) << "a mirror";
  EXPECT_EQ(defect({{Vec3{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, {}}), Defect::InvalidOption) << "a scale";
  EXPECT_EQ(defect({{Vec3{nan, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}}), Defect::InvalidOption);
  EXPECT_EQ(defect(at({0, nan, 0})), Defect::NonFiniteCoordinate);
  EXPECT_EQ(defect_of([] { pose_of_quaternion(0, 0, 0, 0); }), Defect::InvalidOption);
  const std::vector<PosePair> poses{{}, {{}, at({nan, 0, 0})}};
  const std::string refusal = error_of([&] { prohull::collide(index, index, poses); }).what();
  EXPECT_NE(refusal.find("pose 1"), std::string::npos) << refusal;
}

TEST(Collide, RefusesMeshesThatRoundingCrushes) {
  const CollisionIndex index(sphere(6));
  EXPECT_EQ(defect_of([&] {
              prohull::collide(index, at({1e20, 0, 0}), index, at({1e20, 1, 0}));
            }),
            Defect::NonFiniteCoordinate);
  EXPECT_FALSE(prohull::collide(index, at({1e12, 0, 0}), index, at({1e12, 3, 0})));
}

TEST(Pose, OfAQuaternion) {
  const Pose quarter = pose_of_quaternion(1, 0, 0, 1, {10, 0, 0});
  const Vec3 p = placed(quarter, {1, 2, 3});
  EXPECT_NEAR(norm(p - Vec3{8, 1, 3}), 0, 1e-14);
  EXPECT_EQ(placed({}, Vec3{0.1, 1e-300, 1e90}), (Vec3{0.1, 1e-300, 1e90}));
}

}  // namespace
}  // namespace prohull
