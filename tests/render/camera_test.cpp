#include "render/camera.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "meshes.h"
#include "random.h"

namespace prohull::render {
namespace {

constexpr int kWidth = 400, kHeight = 300;

std::vector<Vec3> corners_of_box() {
  const TriangleMesh box = meshes::box({-1, -2, -3}, {1, 2, 3});
  return {box.positions.begin(), box.positions.end()};
}

View random_view(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  View view;
  view.up = static_cast<int>(random() % 3);
  view.azimuth = 3 * unit(random);
  view.elevation = 1.5 * unit(random);
  view.field_of_view = 0.6 + 0.5 * unit(random);
  return view;
}

TEST(Camera, SeesAllPointsAndFillsThePictureInOneDirection) {
  std::mt19937_64 random(test_seed());
  const auto points = corners_of_box();
  for (int round = 0; round < 100; ++round) {
    const Camera camera(random_view(random), points, kWidth, kHeight);
    double left = kWidth, right = 0, top = kHeight, bottom = 0;
    for (const Vec3& p : points) {
      const Point2 seen = camera.project(p);
      left = std::min(left, seen.x), right = std::max(right, seen.x);
      top = std::min(top, seen.y), bottom = std::max(bottom, seen.y);
    }
    EXPECT_GE(left, 0) << "round " << round;
    EXPECT_GE(top, 0);
    EXPECT_LE(right, kWidth);
    EXPECT_LE(bottom, kHeight);
    EXPECT_GT(std::max((right - left) / kWidth, (bottom - top) / kHeight), 0.9);
  }
}

TEST(Camera, RaysPassThroughTheirPixels) {
  std::mt19937_64 random(test_seed());
  for (int round = 0; round < 100; ++round) {
    View view = random_view(random);
    view.zoom = 3;
    view.center = Vec3{0.5, 1, -1};
    const Camera camera(view, corners_of_box(), kWidth, kHeight);
    for (const Point2 pixel : {Point2{0, 0}, Point2{123.4, 56.7}, Point2{kWidth, kHeight}}) {
      const Ray ray = camera.ray(pixel);
      const Point2 again = camera.project(ray.origin + 2.5 * ray.direction);
      EXPECT_NEAR(again.x, pixel.x, 1e-9) << "round " << round;
      EXPECT_NEAR(again.y, pixel.y, 1e-9);
    }
    EXPECT_NEAR(camera.project(*view.center).x, kWidth / 2, 1e-9);
    EXPECT_NEAR(camera.project(*view.center).y, kHeight / 2, 1e-9);
  }
}

TEST(Camera, ZoomEnlarges) {
  const auto points = corners_of_box();
  View view;
  const Camera far(view, points, kWidth, kHeight);
  view.zoom = 4;
  const Camera near(view, points, kWidth, kHeight);
  EXPECT_DOUBLE_EQ(near.pixel_size(1), far.pixel_size(1) / 4);
}

TEST(Camera, FrontIsSeenAsPeopleExpect) {
  View view;
  view.azimuth = view.elevation = 0;
  view.up = 2;  // as in engineering: x to the right, y away
  EXPECT_EQ(ViewAxes(view).right, (Vec3{1, 0, 0}));
  EXPECT_EQ(ViewAxes(view).back, (Vec3{0, -1, 0}));
  view.up = 1;  // as in animation: x to the right, z towards the viewer
  EXPECT_EQ(ViewAxes(view).right, (Vec3{1, 0, 0}));
  EXPECT_EQ(ViewAxes(view).back, (Vec3{0, 0, 1}));
}

TEST(Camera, AzimuthGoesToTheRightSide) {
  View view;
  view.azimuth = std::numbers::pi / 2;
  view.elevation = 0;
  EXPECT_NEAR(norm(ViewAxes(view).back - Vec3{1, 0, 0}), 0, 1e-15);
}

TEST(Camera, StandsApartFromPointsInALineWithIt) {
  View view;
  view.azimuth = view.elevation = 0;
  const std::vector<Vec3> line{{0, 0, 0}, {0, 1, 0}};
  const Camera camera(view, line, kWidth, kHeight);
  EXPECT_NEAR(camera.project(line[0]).x, kWidth / 2, 1e-9);
  EXPECT_LT(camera.ray({0, 0}).origin.y, 0);
}

}  // namespace
}  // namespace prohull::render
