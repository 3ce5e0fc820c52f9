#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "meshes.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "random.h"
#include "verify/oracle.h"

namespace prohull {
namespace {

TEST(SelfIntersections, AreCountedAsByCgal) {
  std::mt19937 random(test_seed());
  for (const double noise : {0.0, 0.01, 0.05, 0.1, 0.3}) {
    std::uniform_real_distribution<double> jitter(-noise, noise);
    for (TriangleMesh mesh : {meshes::torus(30, 12), meshes::sphere(3), meshes::subdivided(meshes::octahedron())}) {
      for (Vec3& p : mesh.positions) p += {jitter(random), jitter(random), jitter(random)};
      const std::size_t expected = oracle::self_intersections(mesh);
      EXPECT_EQ(verify_enclosure(mesh, mesh).self_intersections, expected) << "noise " << noise;
      for (const double scale : {1.0, 0x1p-300, 0x1p300, 0x1p1022})
        EXPECT_EQ(count_self_intersections(meshes::scaled(mesh, scale)), expected) << "noise " << noise;
    }
  }
}

TEST(SelfIntersections, AreCountedInOpenMeshesAndSoups) {
  TriangleMesh two =
      meshes::make({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}, {3, 3, 0}}, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(count_self_intersections(two), 1u);
  EXPECT_EQ(count_self_intersections(meshes::soup(meshes::together(two, two))), 6u) << "each of them with each";
  two.triangles.pop_back();
  EXPECT_EQ(count_self_intersections(two), 0u) << "a single face";
  EXPECT_EQ(count_self_intersections(meshes::soup(meshes::sphere(2))), 0u) << "corners are shared by position";
}

TEST(SelfIntersections, AreCountedAroundVerticesOfManyFaces) {
  std::mt19937 random(test_seed());
  for (const double noise : {0.0, 0.001, 0.01, 0.1}) {
    std::uniform_real_distribution<double> jitter(-noise, noise);
    TriangleMesh mesh = meshes::bipyramid(300);
    for (Vec3& p : mesh.positions) p += {jitter(random), jitter(random), jitter(random)};
    const std::size_t expected = oracle::self_intersections(mesh);
    if (noise > 0.05) {
      EXPECT_GT(expected, 0u);
    }
    EXPECT_EQ(count_self_intersections(mesh), expected) << "noise " << noise;
    std::ranges::shuffle(mesh.triangles, random);
    EXPECT_EQ(count_self_intersections(mesh), expected) << "noise " << noise;
  }
}

// Around each tip the faces turn the same way, but twice around.
TEST(SelfIntersections, AreCountedWhereFacesWindTwiceAroundAVertex) {
  TriangleMesh mesh;
  for (const double z : {1.0, -1.0}) mesh.positions.push_back({0.01, 0.02, z});
  for (int i = 0; i < 5; ++i) {
    const double angle = i * 4 * std::numbers::pi / 5;
    mesh.positions.push_back({std::cos(angle), std::sin(angle), 0.01 * i});
  }
  for (std::uint32_t i = 0; i < 5; ++i) {
    const VertexId v{2 + i}, w{2 + (i + 1) % 5};
    mesh.triangles.push_back({VertexId{0}, v, w});
    mesh.triangles.push_back({VertexId{1}, w, v});
  }
  const std::size_t expected = oracle::self_intersections(mesh);
  EXPECT_GT(expected, 0u);
  EXPECT_EQ(count_self_intersections(mesh), expected);
}

TEST(SelfIntersections, OfBillionsOfPairsAroundAVertexFewAreTested) {
  // Each pair tested takes some 20 ns: of the 5 * 10^9 pairs of faces that share a tip that would be minutes.
  EXPECT_EQ(count_self_intersections(meshes::bipyramid(100'000)), 0u);
}

TEST(SelfIntersections, OfNothingAndOfWhatIsNotFiniteAreRefused) {
  EXPECT_THROW(count_self_intersections({}), InputError);
  TriangleMesh mesh = meshes::octahedron();
  mesh.positions[VertexId{0}].x = std::numeric_limits<double>::infinity();
  EXPECT_THROW(count_self_intersections(mesh), InputError);
}

}  // namespace
}  // namespace prohull
