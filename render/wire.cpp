#include "render/wire.h"

#include <algorithm>
#include <cmath>

namespace prohull::render {
namespace {

double distance_to_segment(const Point2& p, const Point2& a, const Point2& b) {
  const double x = b.x - a.x, y = b.y - a.y, squared_length = x * x + y * y;
  const double along = squared_length > 0 ? ((p.x - a.x) * x + (p.y - a.y) * y) / squared_length : 0;
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(p.x - a.x - t * x, p.y - a.y - t * y);
}

}  // namespace

double line_coverage(const std::array<Point2, 3>& corners, const Point2& point, double width) {
  const double nearest =
      std::min({distance_to_segment(point, corners[0], corners[1]), distance_to_segment(point, corners[1], corners[2]),
                distance_to_segment(point, corners[2], corners[0])});
  return std::clamp(0.5 * width + 0.5 - nearest, 0.0, 1.0);
}

double line_visibility(double side, double width) {
  constexpr double kInvisible = 4, kClear = 12;
  return smooth_step(kInvisible * width, kClear * width, side);
}

double side_of(const std::array<Point2, 3>& c) {
  return std::sqrt(std::abs((c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x)));
}

}  // namespace prohull::render
