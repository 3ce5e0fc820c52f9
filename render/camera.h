#pragma once

#include <numbers>
#include <optional>
#include <span>

#include "prohull/geometry.h"

namespace prohull::render {

/// From where to look at a scene.
struct View {
  int up = 2;                                      ///< axis: 0, 1 or 2
  double azimuth = 35 * std::numbers::pi / 180;    ///< radians around it, counter-clockwise seen from its tip; 0: front
  double elevation = 20 * std::numbers::pi / 180;  ///< radians above the horizon, in [-pi/2, pi/2]
  double field_of_view = 25 * std::numbers::pi / 180;  ///< radians across the shorter side of the picture, in (0, pi)
  double zoom = 1;                                     ///< 1: all is seen
  std::optional<Vec3> center;  ///< what comes to the middle of the picture; none: as much is seen as can be
};

/// In pixels from the upper left corner of the picture.
struct Point2 {
  double x = 0, y = 0;
};

/// The axes of a view, of length 1: `right`, `up` and `back`, towards the viewer, span the picture; `vertical` is the
/// up axis, and `front` lies on the horizon below the viewer.
struct ViewAxes {
  explicit ViewAxes(const View& view);
  Vec3 vertical, front, right, up, back;
};

/// A pinhole.
class Camera {
 public:
  /// A camera as near to all points as a picture of width x height pixels allows. It sees all of them if the view does
  /// not zoom.
  Camera(const View& view, std::span<const Vec3> points, int width, int height);

  /// The direction advances by 1 in depth.
  Ray ray(const Point2& pixel) const;
  /// For points in front of the camera.
  Point2 project(const Vec3& point) const;
  double pixel_size(double depth) const { return depth / focal_; }
  const ViewAxes& axes() const { return axes_; }

 private:
  ViewAxes axes_;
  Vec3 eye_;
  double focal_;   // pixels
  Point2 center_;  // of the perspective, in the picture
};

}  // namespace prohull::render
