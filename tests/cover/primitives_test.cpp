#include "cover/primitives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "effort.h"
#include "geometry/float32.h"
#include "geometry/predicates.h"
#include "meshes.h"
#include "prohull/convex_hull.h"
#include "prohull/sample.h"
#include "random.h"
#include "random_points.h"

namespace prohull::cover {
namespace {

using namespace meshes;

// Long double has 11 bits more than double: what it rounds is far less than the spare.
using Exact = std::array<long double, 3>;

Exact exact(const Vec3& p) { return {p.x, p.y, p.z}; }
Exact operator-(const Exact& a, const Exact& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
long double dot(const Exact& a, const Exact& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// How far inside p is; negative outside.
long double depth(const OrientedBox& box, const Vec3& p) {
  const Exact d = exact(p) - exact(box.center);
  long double least = std::numeric_limits<long double>::infinity();
  for (int i = 0; i < 3; ++i)
    least = std::min(least, box.half_sizes[i] - std::abs(dot(d, exact(box.axes[static_cast<std::size_t>(i)]))));
  return least;
}

long double depth(const Capsule& capsule, const Vec3& p) {
  const Exact ab = exact(capsule.b) - exact(capsule.a);
  Exact d = exact(p) - exact(capsule.a);
  const long double squared = dot(ab, ab), t = squared > 0 ? std::clamp(dot(d, ab) / squared, 0.0L, 1.0L) : 0;
  for (std::size_t i = 0; i < 3; ++i) d[i] -= t * ab[i];
  return capsule.radius - std::sqrt(dot(d, d));
}

long double depth(const Ball& ball, const Vec3& p) {
  const Exact d = exact(p) - exact(ball.center);
  return ball.radius - std::sqrt(dot(d, d));
}

/// What the header guarantees; returns the volume.
template <class Shape>
double check(const Shape& shape, const TriangleMesh& mesh) {
  long double least = std::numeric_limits<long double>::infinity();
  for (const auto& corners : mesh.triangles)
    for (const VertexId v : corners) least = std::min(least, depth(shape, mesh.positions[v]));
  const double diagonal = bounding_box(mesh).diagonal();
  EXPECT_GE(least, 1e-9L * diagonal);
  EXPECT_LE(least, 1e-7L * diagonal) << "nothing touches it";
  return volume(shape);
}

void check_axes(const OrientedBox& box) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(norm(box.axes[i]), 1, 1e-14);
    EXPECT_NEAR(prohull::dot(box.axes[i], box.axes[(i + 1) % 3]), 0, 1e-14);
  }
  EXPECT_GT(prohull::dot(cross(box.axes[0], box.axes[1]), box.axes[2]), 0) << "right-handed";
}

void check_all(const TriangleMesh& mesh) {
  const OrientedBox oriented = box_around(mesh);
  check_axes(oriented);
  check(oriented, mesh);
  check(capsule_around(mesh), mesh);
  check(ball_around(mesh), mesh);
}

TEST(BoxAround, FindsATurnedBox) {
  const TriangleMesh mesh = turned(box({1, 2, 3}, {2, 4, 7}));
  EXPECT_NEAR(check(box_around(mesh), mesh), 8, 1e-6);
}

// The least box of a regular tetrahedron is the cube of which it has 4 corners. No face of the box is flush with one of
// the tetrahedron (O'Rourke 1985).
TEST(BoxAround, OfARegularTetrahedronIsTheCube) {
  const TriangleMesh mesh = turned(tetrahedron({0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}));
  EXPECT_NEAR(check(box_around(mesh), mesh), 1, 1e-3);
}

TEST(BoxAround, IsAsSmallAsTheBestOfManyDirections) {
  std::mt19937 random(test_seed());
  std::normal_distribution<double> normal;
  for (int round = 0; round < rounds(10); ++round) {
    const TriangleMesh mesh = random_points(random, 60, {1, 2, 3});
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < effort(5000, 500); ++i) {
      Vec3 u{normal(random), normal(random), normal(random)}, v{normal(random), normal(random), normal(random)};
      u = u / norm(u);
      v = cross(u, v);
      v = v / norm(v);
      Box range;
      for (const Vec3& p : mesh.positions)
        range.extend(Vec3{prohull::dot(p, u), prohull::dot(p, v), prohull::dot(p, cross(u, v))});
      const Vec3 s = range.max - range.min;
      least = std::min(least, s.x * s.y * s.z);
    }
    EXPECT_LT(check(box_around(mesh), mesh), least * 1.001);
  }
}

TEST(CapsuleAround, FindsATurnedCapsule) {
  TriangleMesh mesh = scaled(sphere(3), 0.5);
  for (Vec3& p : mesh.positions)
    if (p.z > 0) p.z += 2;
  const TriangleMesh at = moved(turned(mesh), {1, -2, 3});
  const double exact_volume = volume(Capsule{{0, 0, 0}, {0, 0, 2}, 0.5});
  EXPECT_NEAR(check(capsule_around(at), at), exact_volume, 0.01 * exact_volume);
}

TEST(CapsuleAround, IsNoLargerThanTheBall) {
  for (const TriangleMesh& mesh : {sphere(2), tetrahedron(), octahedron(), box({0, 0, 0}, {1, 1, 1})})
    EXPECT_LE(check(capsule_around(mesh), mesh), check(ball_around(mesh), mesh) * (1 + 1e-6));
}

TEST(BallAround, IsTheLeast) {
  EXPECT_NEAR(ball_around(moved(sphere(3), {5, 6, 7})).radius, 1, 1e-6);
  EXPECT_NEAR(ball_around(box({0, 0, 0}, {1, 2, 2})).radius, 1.5, 1e-6);
  const Ball of_needle = ball_around(tetrahedron({-1, 0, 0}, {1, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}));
  EXPECT_NEAR(of_needle.radius, 1, 1e-6) << "two points are enough";
  EXPECT_NEAR(of_needle.center.y, 0, 1e-6);
}

TEST(Primitives, EncloseSamples) {
  for (const char* name : {"asteroid", "pony", "bracket", "knot", "sphere"}) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = make_sample(name, 1000);
    check_all(mesh);
    check_all(moved(turned(mesh), {100, 0, -30}));
  }
}

TEST(Primitives, EncloseRandomPoints) {
  std::mt19937 random(test_seed());
  std::uniform_int_distribution<int> points(4, 100);
  for (int round = 0; round < rounds(20); ++round) check_all(random_points(random, points(random), {1, 1, 1}));
}

TEST(Primitives, EncloseNeedlesAndPlates) {
  std::mt19937 random(test_seed());
  for (const Vec3& sizes : {Vec3{1, 1, 1e-9}, {1, 1e-9, 1e-9}, {1, 1, 0}, {1, 0, 0}}) {
    SCOPED_TRACE(testing::Message() << sizes.x << " " << sizes.y << " " << sizes.z);
    const TriangleMesh thin = random_points(random, 50, sizes);
    check_all(thin);
    check_all(turned(thin));
  }
  EXPECT_LT(volume(box_around(turned(random_points(random, 50, {1, 1, 0})))), 1e-6);
}

TEST(Primitives, EncloseHugeAndTinyMeshes) {
  std::mt19937 random(test_seed());
  const TriangleMesh mesh = random_points(random, 50, {1, 2, 3});
  for (const double scale : {1e90, 1e-90}) {
    SCOPED_TRACE(scale);
    check_all(scaled(mesh, scale));
  }
  check_all(moved(mesh, {1e6, 1e6, 1e6}));
}

TEST(Primitives, EncloseASinglePoint) {
  const TriangleMesh point = make({{1, 2, 3}}, {{0, 0, 0}});
  EXPECT_GE(depth(box_around(point), {1, 2, 3}), 0);
  EXPECT_GE(depth(capsule_around(point), {1, 2, 3}), 0);
  EXPECT_GE(depth(ball_around(point), {1, 2, 3}), 0);
}

TEST(Primitives, LeaveOutVerticesThatNoTriangleUses) {
  TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
  mesh.positions.push_back({9, std::numeric_limits<double>::quiet_NaN(), 9});
  check_all(mesh);
}

TEST(Primitives, HaveVolumes) {
  EXPECT_DOUBLE_EQ(volume(OrientedBox{.center = {}, .half_sizes = {1, 2, 3}}), 48);
  EXPECT_DOUBLE_EQ(volume(Ball{{}, 2}), 32 * std::numbers::pi / 3);
  EXPECT_DOUBLE_EQ(volume(Capsule{{0, 0, 0}, {0, 3, 0}, 1}), std::numbers::pi * (3 + 4.0 / 3));
}

/// The mesh is a convex polytope that has all corners of the box inside.
void check_mesh(const OrientedBox& box, bool float32) {
  const TriangleMesh mesh = mesh_of(box, float32);
  EXPECT_LE(mesh.vertex_count(), 8u);
  EXPECT_EQ(mesh.face_count(), 2 * mesh.vertex_count() - 4);
  for (const FaceId f : mesh.triangles.ids()) {
    const auto [a, b, c] = mesh.triangle(f);
    for (const Vec3& p : mesh.positions) EXPECT_NE(side(a, b, c, p), Side::Outside);
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner = box.center + box.axes[0] * (i & 1 ? box.half_sizes.x : -box.half_sizes.x) +
                          box.axes[1] * (i & 2 ? box.half_sizes.y : -box.half_sizes.y) +
                          box.axes[2] * (i & 4 ? box.half_sizes.z : -box.half_sizes.z);
      EXPECT_NE(side(a, b, c, corner), Side::Outside);
    }
  }
  EXPECT_TRUE(!float32 || std::ranges::all_of(mesh.positions, [](const Vec3& p) { return is_float32(p); }));
}

TEST(MeshOfBox, EnclosesTheBoxAndIsConvex) {
  std::mt19937 random(test_seed());
  for (int round = 0; round < rounds(20); ++round) {
    const OrientedBox tight = box_around(random_points(random, 20, {1, 0.01, 1e-7}));
    for (const bool float32 : {false, true}) check_mesh(tight, float32);
    EXPECT_NEAR(signed_volume(mesh_of(tight)) / volume(tight), 1, 1e-6);
  }
  const OrientedBox unit{.center = {0.1, 0.2, 0.3}, .half_sizes = {1, 1, 1}};
  EXPECT_EQ(mesh_of(unit, true).vertex_count(), 8u);
  EXPECT_NEAR(signed_volume(mesh_of(unit, true)), 8, 1e-4);
}

}  // namespace
}  // namespace prohull::cover
