#pragma once

#include <algorithm>
#include <array>

#include "render/camera.h"

namespace prohull::render {

/// From 0 at `from` to 1 at `to`, level at both.
inline double smooth_step(double from, double to, double value) {
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// How much of a pixel at `point` the lines along the edges of a face cover, in [0, 1]: those `width` pixels wide, half
/// of it on this face.
double line_coverage(const std::array<Point2, 3>& corners, const Point2& point, double width);

/// In [0, 1]: where the sides of faces are only a few line widths long, there would be lines only, and they fade away.
double line_visibility(double side, double width);

/// The legs of an isosceles right-angled triangle of the same area.
double side_of(const std::array<Point2, 3>& corners);

}  // namespace prohull::render
