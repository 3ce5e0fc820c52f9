#include "render/normals.h"

#include <gtest/gtest.h>

#include <numbers>

#include "meshes.h"

namespace prohull::render {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(Normals, FacesBeyondTheCreaseAngleStayFlat) {
  const TriangleMesh box = meshes::box({0, 0, 0}, {1, 2, 3});
  const CornerNormals normals = corner_normals(box, 89 * kDegree);
  for (const FaceId f : box.triangles.ids())
    for (const Vec3& normal : normals[f]) EXPECT_NEAR(norm(normal - face_normal(box.triangle(f))), 0, 1e-14);
}

TEST(Normals, OfABoxSmoothedPointAlongItsDiagonals) {
  const TriangleMesh box = meshes::box({-1, -1, -1}, {1, 1, 1});
  const CornerNormals normals = corner_normals(box, 91 * kDegree);
  // By angle, and not by how many triangles a side has at the corner.
  for (const FaceId f : box.triangles.ids())
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vec3& corner = box.positions[box.triangles[f][k]];
      EXPECT_NEAR(norm(normals[f][k] - corner / norm(corner)), 0, 1e-14);
    }
}

TEST(Normals, AreInterpolatedBetweenCorners) {
  const Triangle t{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  const std::array corners{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  EXPECT_NEAR(norm(interpolated_normal(t, corners, t.a) - corners[0]), 0, 1e-15);
  EXPECT_NEAR(norm(interpolated_normal(t, corners, t.b) - corners[1]), 0, 1e-15);
  EXPECT_NEAR(norm(interpolated_normal(t, corners, t.c) - corners[2]), 0, 1e-15);
  const Vec3 middle = Vec3{1, 1, 0} / std::sqrt(2);
  EXPECT_NEAR(norm(interpolated_normal(t, corners, {1, 0, 0}) - middle), 0, 1e-15);
}

TEST(Normals, OfAFaceWithoutAreaAreZero) {
  EXPECT_EQ(face_normal({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}), Vec3{});
  TriangleMesh mesh = meshes::octahedron();
  mesh.triangles.push_back({VertexId{0}, VertexId{0}, VertexId{1}});
  for (const auto& corners : corner_normals(mesh, 40 * kDegree))
    for (const Vec3& normal : corners) EXPECT_TRUE(is_finite(normal));
}

}  // namespace
}  // namespace prohull::render
