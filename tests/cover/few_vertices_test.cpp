#include "cover/few_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <random>
#include <vector>

#include "cover/primitives.h"
#include "effort.h"
#include "geometry/float32.h"
#include "geometry/predicates.h"
#include "meshes.h"
#include "prohull/convex_hull.h"
#include "prohull/distance.h"
#include "prohull/enclosure.h"
#include "prohull/sample.h"
#include "random.h"
#include "random_points.h"

namespace prohull::cover {
namespace {

using namespace meshes;

/// What with_few_vertices guarantees; returns the volume relative to the polytope.
double check(const TriangleMesh& polytope, std::size_t max_vertices, bool float32 = false) {
  SCOPED_TRACE(testing::Message() << polytope.vertex_count() << " to " << max_vertices << " vertices"
                                  << (float32 ? ", float32" : ""));
  const TriangleMesh few = with_few_vertices(polytope, max_vertices, float32);
  EXPECT_LE(few.vertex_count(), max_vertices);
  EXPECT_GE(few.face_count(), 4u);
  EXPECT_EQ(few.face_count(), 2 * few.vertex_count() - 4) << "one closed surface without handles";
  for (const FaceId f : few.triangles.ids()) {
    const auto [a, b, c] = few.triangle(f);
    for (const Vec3& p : polytope.positions) EXPECT_NE(side(a, b, c, p), Side::Outside);
    for (const Vec3& p : few.positions) EXPECT_NE(side(a, b, c, p), Side::Outside) << "not convex";
  }
  EXPECT_TRUE(!float32 || std::ranges::all_of(few.positions, [](const Vec3& p) { return is_float32(p); }));
  return signed_volume(few) / signed_volume(polytope);
}

TriangleMesh random_polytope(std::mt19937& random, int points, const Vec3& sizes) {
  return convex_hull(random_points(random, points, sizes));
}

TriangleMesh turned_hull(const TriangleMesh& mesh) { return convex_hull(turned(mesh)); }

TEST(FewVertices, OfABallIsNearlyAsTightAsTheoryAllows) {
  // Large circumscribed polytopes of n vertices exceed a ball by at least 1.8 / n of its volume.
  const TriangleMesh ball = convex_hull(sphere(effort(3, 2)));
  EXPECT_LT(check(ball, 64), 1.06);
  EXPECT_LT(check(ball, 32), 1.10);
  EXPECT_LT(check(ball, 16), 1.20);
  EXPECT_LT(check(ball, 4), 3.5) << "a regular tetrahedron has 3.31";
}

TEST(FewVertices, OfSamplesAddLittle) {
  for (const char* name : {"asteroid", "pony", "knot", "bracket"}) {
    SCOPED_TRACE(name);
    const TriangleMesh hull = convex_hull(make_sample(name, 2000));
    EXPECT_LT(check(hull, 64), 1.03);
    EXPECT_LT(check(hull, 16), 1.15);
    EXPECT_LT(check(hull, 32, true), 1.06);
  }
}

TEST(FewVertices, KeepsWhatHasFewEnough) {
  const TriangleMesh cube = convex_hull(box({0, 0, 0}, {1, 2, 3}));
  EXPECT_EQ(with_few_vertices(cube, 8), cube);
  EXPECT_EQ(with_few_vertices(cube, 64, true), cube);
  const TriangleMesh not_float32 = convex_hull(box({0, 0, 0}, {0.1, 0.2, 0.3}));
  EXPECT_EQ(with_few_vertices(not_float32, 8), not_float32);
}

TEST(FewVertices, RoundsOutwardsToFloat32) {
  EXPECT_LT(check(convex_hull(box({-0.1, -0.7, 0.1}, {0.3, 0.2, 0.3})), 8, true), 1 + 1e-5);
  EXPECT_LT(check(turned_hull(box({-0.1, -0.7, 0.1}, {0.3, 0.2, 0.3})), 8, true), 1 + 1e-5);
  EXPECT_LT(check(tetrahedron({0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}), 4, true), 1 + 1e-5);
}

TEST(FewVertices, FindsTheCubeWhoseCornersAreCut) {
  TriangleMesh cut;
  constexpr double kCut = 0.001;
  for (int i = 0; i < 24; ++i) {
    Vec3 p{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0};
    p[i / 8] *= 1 - kCut;
    cut.positions.push_back(p);
  }
  for (std::uint32_t i = 2; i < 24; ++i) cut.triangles.push_back({VertexId{0}, VertexId{1}, VertexId{i}});
  EXPECT_LT(check(convex_hull(cut), 8), 1 + 1e-6);
}

TEST(FewVertices, KeepsTipsOfManyFaces) {
  // The rim becomes a polygon around the circle, whose area is tan(pi / n) / (pi / n) times as large.
  const TriangleMesh rim = convex_hull(bipyramid(effort(400u, 150u)));
  EXPECT_LT(check(rim, 64), 1.002) << "62 corners: 1.0009";
  EXPECT_LT(check(rim, 16), 1.03) << "14 corners: 1.017";
}

TEST(FewVertices, OfEightIsNoWorseThanTheBox) {
  std::mt19937 random(test_seed());
  for (int round = 0; round < rounds(10); ++round) {
    const TriangleMesh polytope = random_polytope(random, 40, {1, 0.5, 2});
    EXPECT_LT(check(polytope, 8), volume(box_around(polytope)) / signed_volume(polytope) * (1 + 1e-6));
  }
}

TEST(FewVertices, OfRandomPolytopesEnclose) {
  std::mt19937 random(test_seed());
  std::uniform_int_distribution<int> points(5, 200), vertices(4, 70);
  for (int round = 0; round < rounds(40); ++round) {
    const TriangleMesh polytope = random_polytope(random, points(random), {1, 1, 1});
    const double ratio = check(polytope, static_cast<std::size_t>(vertices(random)), round % 2 == 1);
    EXPECT_GE(ratio, 1 - 1e-12);
    EXPECT_LT(ratio, 5);
  }
}

// Ratios of volumes do not change with scale, and little with thickness.
TEST(FewVertices, OfNeedlesAndPlatesAreAsTight) {
  std::mt19937 random(test_seed());
  for (const Vec3& sizes : {Vec3{1, 1, 1e-9}, {1, 1e-9, 1e-9}, {1e-9, 1, 1e-5}}) {
    SCOPED_TRACE(testing::Message() << sizes.x << " " << sizes.y << " " << sizes.z);
    const TriangleMesh thin = random_polytope(random, 300, sizes);
    EXPECT_LT(check(thin, 24), 1.2);
    check(turned_hull(thin), 24);  // volumes of these are lost to rounding
    check(thin, 24, true);
    check(turned_hull(thin), 6, true);
    check(thin, 4);
  }
  EXPECT_LT(check(turned_hull(random_polytope(random, 300, {1, 1e-3, 1e-3})), 24), 1.2);
}

TEST(FewVertices, OfHugeAndTinyCoordinatesAreAsTight) {
  std::mt19937 random(test_seed());
  const TriangleMesh polytope = random_polytope(random, 300, {1, 1, 1});
  for (const double scale : {1e90, 1e-60}) {
    const TriangleMesh few = with_few_vertices(scaled(polytope, scale), 24);
    EXPECT_LE(few.vertex_count(), 24u);
    EXPECT_TRUE(verify_enclosure(scaled(polytope, scale), few).encloses);
    EXPECT_LT(signed_volume(few) / signed_volume(scaled(polytope, scale)), 1.2);
  }
  EXPECT_LT(check(moved(polytope, {1e6, 0, -1e6}), 24), 1.2);
  EXPECT_LT(check(moved(polytope, {1e4, 0, -1e4}), 24, true), 1.25) << "where float32 numbers are 0.001 apart";
  // Thinner than the numbers are apart.
  check(moved(polytope, {1e9, 0, -1e9}), 24, true);
  check(moved(polytope, {1e9, 0, -1e9}), 5, true);
}

TEST(FewVertices, OfAThinPlateFarAwayAreCloseWithFloat32) {
  std::mt19937 random(test_seed());
  const TriangleMesh plate = turned_hull(box({0, 0, 0}, {0.2, 0.1, 1e-5}));
  for (const Vec3& away : random_points(random, 8, {100, 100, 100}).positions)
    for (const std::size_t vertices : {8, 64})
      EXPECT_LT(check(moved(plate, away), vertices, true), 6) << "float32 numbers are 8e-6 apart";
}

TEST(FewVertices, AreTheSameOnEveryThread) {
  const TriangleMesh hull = convex_hull(make_sample("asteroid", 1000));
  for (const std::size_t vertices : {6u, 20u}) {
    std::vector<std::future<TriangleMesh>> results;
    for (int i = 0; i < 4; ++i)
      results.push_back(std::async(std::launch::async, [&] { return with_few_vertices(hull, vertices); }));
    const TriangleMesh expected = with_few_vertices(hull, vertices);
    for (auto& result : results) EXPECT_EQ(result.get(), expected);
  }
}

}  // namespace
}  // namespace prohull::cover
