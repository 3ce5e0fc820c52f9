#pragma once

#include <array>

#include "render/camera.h"

namespace prohull::render {

/// How much of a pixel at `point` the lines along the edges of a face cover, in [0, 1]: those `width` pixels wide, half
/// of it on this face.
double line_coverage(const std::array<Point2, 3>& corners, const Point2& point, double width);

/// In [0, 1]: where the sides of faces are only a few line widths long, there would be lines only, and they fade away.
double line_visibility(double side, double width);

/// The legs of an isosceles right-angled triangle of the same area.
double side_of(const std::array<Point2, 3>& corners);

}  // namespace prohull::render
