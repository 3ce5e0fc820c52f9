#include "prohull/detail/mesh_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "meshes.h"

namespace prohull {
namespace {

using namespace meshes;

constexpr double kPi = std::numbers::pi;

TEST(MeshQuality, OfRegularSolids) {
  const MeshQuality octa = mesh_quality(octahedron());
  EXPECT_NEAR(octa.compactness.worst, 1, 1e-15) << "equilateral";
  EXPECT_NEAR(octa.compactness.median, 1, 1e-15);
  EXPECT_EQ(octa.edges, 12u);
  EXPECT_EQ(octa.sharp_edges, 12u);
  EXPECT_NEAR(octa.dihedral_angle.worst, std::acos(-1.0 / 3), 1e-15);
  EXPECT_NEAR(octa.dihedral_angle.median, std::acos(-1.0 / 3), 1e-15);

  const MeshQuality cube = mesh_quality(box({0, 0, 0}, {1, 1, 1}));
  EXPECT_NEAR(cube.compactness.worst, std::sqrt(3.0) / 2, 1e-15) << "half a square";
  EXPECT_EQ(cube.edges, 18u);
  EXPECT_EQ(cube.sharp_edges, 12u) << "not the diagonals of the squares";
  EXPECT_DOUBLE_EQ(cube.dihedral_angle.worst, kPi / 2);
  EXPECT_DOUBLE_EQ(cube.dihedral_angle.median, kPi / 2) << "twelve of eighteen";
}

TEST(MeshQuality, HasTheSmallestAngleAndTheWorstAspectRatio) {
  const MeshQuality octa = mesh_quality(octahedron()), cube = mesh_quality(box({0, 0, 0}, {1, 1, 1}));
  EXPECT_NEAR(octa.smallest_angle, kPi / 3, 1e-15);
  EXPECT_NEAR(octa.worst_aspect_ratio, 2 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(cube.smallest_angle, kPi / 4, 1e-15);
  EXPECT_NEAR(cube.worst_aspect_ratio, 2, 1e-15) << "half a square";
  const MeshQuality needle = mesh_quality(make({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}));
  EXPECT_EQ(needle.smallest_angle, 0);
  EXPECT_EQ(needle.worst_aspect_ratio, std::numeric_limits<double>::infinity());
}

TEST(MeshQuality, DoesNotTellConvexEdgesFromConcaveOnes) {
  const TriangleMesh solid = subdivided(box({0, 0, 0}, {1, 1, 1}));
  const MeshQuality outside = mesh_quality(solid), inside = mesh_quality(inside_out(solid));
  EXPECT_EQ(outside.sharp_edges, 24u);
  EXPECT_EQ(inside.sharp_edges, outside.sharp_edges);
  EXPECT_DOUBLE_EQ(inside.dihedral_angle.worst, outside.dihedral_angle.worst);
}

// Two right triangles that share a side, opened by an angle.
TriangleMesh hinge(double angle) {
  return make({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {std::cos(angle), std::sin(angle), 0}}, {{0, 1, 2}, {1, 0, 3}});
}

TEST(MeshQuality, MeasuresTheAngleBetweenTheFaces) {
  for (const double degrees : {0.0, 10.0, 90.0, 134.0, 136.0, 180.0, 270.0}) {
    const double angle = degrees * kPi / 180;
    const MeshQuality quality = mesh_quality(hinge(angle));
    EXPECT_EQ(quality.edges, 1u) << "open edges have none";
    EXPECT_NEAR(quality.dihedral_angle.worst, std::min(angle, 2 * kPi - angle), 1e-15) << degrees;
    EXPECT_EQ(quality.sharp_edges, degrees == 136 || degrees == 180 ? 0u : 1u) << degrees;
  }
}

TEST(MeshQuality, PercentilesAreOfTheWorstFaces) {
  // 1,000 triangles of which the i-th has the height i + 1 over a side of 2,000: the higher the more compact.
  TriangleMesh mesh;
  for (int i = 0; i < 1000; ++i) {
    const auto v = mesh.positions.push_back({-1000, 0, 0}), w = mesh.positions.push_back({1000, 0, 0});
    mesh.triangles.push_back({v, w, mesh.positions.push_back({0, i + 1.0, 0})});
  }
  const auto expected = [](double height) {
    return 4 * std::sqrt(3.0) * (1000 * height) / (2000.0 * 2000 + 2 * (1000.0 * 1000 + height * height));
  };
  const MeshQuality quality = mesh_quality(mesh);
  EXPECT_NEAR(quality.compactness.worst, expected(1), 1e-15);
  EXPECT_NEAR(quality.compactness.p1, expected(10), 1e-15);
  EXPECT_NEAR(quality.compactness.p10, expected(100), 1e-15);
  EXPECT_NEAR(quality.compactness.median, expected(500), 1e-15);
  EXPECT_EQ(quality.edges, 0u);
}

TEST(MeshQuality, DoesNotDependOnTheUnit) {
  const TriangleMesh mesh = torus(12, 8);
  const MeshQuality quality = mesh_quality(mesh);
  for (const double scale : {0x1p-1000, 0x1p-500, 0x1p500, 0x1p1020}) {
    const MeshQuality other = mesh_quality(scaled(mesh, scale));
    EXPECT_EQ(other.compactness.worst, quality.compactness.worst) << scale;
    EXPECT_EQ(other.dihedral_angle.p1, quality.dihedral_angle.p1) << scale;
    EXPECT_EQ(other.sharp_edges, quality.sharp_edges) << scale;
  }
}

TEST(MeshQuality, OfWhatCannotBeMeasuredIsWorst) {
  TriangleMesh mesh = octahedron();
  mesh.triangles.push_back({VertexId{0}, VertexId{0}, VertexId{1}});
  EXPECT_EQ(mesh_quality(mesh).compactness.worst, 0);
  EXPECT_EQ(mesh_quality(mesh).edges, 12u);
  mesh.positions[VertexId{0}].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(mesh_quality(mesh).compactness.worst, 0);
  EXPECT_EQ(mesh_quality(mesh).edges, 4u) << "those of the four faces that are left";
  EXPECT_EQ(mesh_quality({}).edges, 0u);
}

}  // namespace
}  // namespace prohull
