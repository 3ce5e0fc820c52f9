#include "render/marks.h"

#include <gtest/gtest.h>

#include <vector>

#include "prohull/mesh_report.h"

namespace prohull::render {
namespace {

TEST(Marks, AreClosedAndAsLargeAsAsked) {
  const TriangleMesh mesh = rod({{1, 2, 3}, {1, 2, 7}}, 0.5);
  EXPECT_TRUE(inspect(mesh).is_closed_manifold());
  EXPECT_NEAR(signed_volume(mesh), 4 * 3.14159 * 0.25, 0.05);
  EXPECT_TRUE(inspect(ball({1, 2, 3}, 0.5)).is_closed_manifold());
  EXPECT_NEAR(signed_volume(ball({1, 2, 3}, 0.5)), 4. / 3 * 3.14159 * 0.125, 0.01);
}

TEST(Marks, DashesCoverHalfOfTheWay) {
  const Segment way{{-1, 0, 0}, {5, 3, -2}};
  const TriangleMesh mesh = dashes(way, 0.01, 1);
  EXPECT_EQ(inspect(mesh).components, 7u);
  EXPECT_NEAR(signed_volume(mesh), signed_volume(rod(way, 0.01)) / 2, 1e-6);
}

TEST(Marks, OfNoLengthAreNothing) {
  EXPECT_TRUE(rod({{1, 2, 3}, {1, 2, 3}}, 0.5).triangles.empty());
  EXPECT_TRUE(dashes({{1, 2, 3}, {1, 2, 3}}, 0.5, 1).triangles.empty());
}

TEST(Spheres, AreClosedAndHaveFewerFacesTheMoreThereAre) {
  const Ball ball{{1, 2, 3}, 0.5};
  const TriangleMesh three = spheres(std::vector<Ball>(3, ball)), many = spheres(std::vector<Ball>(5000, ball));
  EXPECT_TRUE(inspect(three).is_closed_manifold());
  EXPECT_NEAR(signed_volume(three), 3 * 4. / 3 * 3.14159 * 0.125, 0.01);
  EXPECT_LT(many.face_count(), 1'500'000u);
  EXPECT_NEAR(norm(many.positions[VertexId(7)] - ball.center), ball.radius, 1e-12);
  EXPECT_TRUE(spheres({}).triangles.empty());
}

}  // namespace
}  // namespace prohull::render
