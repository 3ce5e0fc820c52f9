#include "query/line.h"

#include "query/exact_line.h"

namespace prohull {
namespace {

/// The sign of dot(direction, p cross q) for the edge from p to q, of which `value` is the rounded determinant.
int edge_sign(const DirectedLine& line, const Vec3& p, const Vec3& q, double value, double error) {
  if (value > error) return 1;
  if (value < -error) return -1;
  return exact_edge_sign(line, p, q);
}

int point_sign(const Vec3& point, const FaceFromPoint& seen, const Triangle& face) {
  const double value = seen.side(), error = seen.side_error();
  if (value > error) return 1;
  if (value < -error) return -1;
  return exact_point_sign(point, face);
}

}  // namespace

Crossing crossing(const DirectedLine& line, const Triangle& face) {
  const FaceFromLine seen(line, face);
  if (seen.certainly_passed()) return Crossing::None;
  const int sign = edge_sign(line, face.a, face.b, seen.ab, seen.error);
  // Never all three of a line parallel to the plane: their sum is dot(direction, normal), moved or not.
  if (sign == 0 || edge_sign(line, face.b, face.c, seen.bc, seen.error) != sign ||
      edge_sign(line, face.c, face.a, seen.ca, seen.error) != sign)
    return Crossing::None;
  if (point_sign(line.origin, seen, face) != sign) return Crossing::None;
  if (!line.is_ray() && point_sign(line.end, FaceFromPoint(line.end, face), face) == sign) return Crossing::None;
  return sign > 0 ? Crossing::Leaving : Crossing::Entering;
}

// By the normal n = u cross v of the edges u, v from corner a: t = dot(n, a - origin) / dot(n, direction), which is as
// accurate for a small face far from the origin as for a near one. Rounding u, v, the products and the differences
// moves a coordinate of n by at most 4.1 eps of its terms, 2 Lu Lv with L the largest entries; a product with a rounded
// w adds 2.1 eps, the two sums 2 eps: each dot(n, w) is within 3 * 8.2 eps * 2 Lu Lv Lw.
Parameter parameter(const DirectedLine& line, const Triangle& face) {
  using namespace line_filter;
  const Vec3 u = face.b - face.a, v = face.c - face.a, to_face = face.a - line.origin, n = cross(u, v);
  const double above = dot(n, to_face), speed = dot(n, line.direction);
  const double per_length = 50 * kEpsilon * largest_entry(u) * largest_entry(v);
  const double above_error = per_length * largest_entry(to_face) + kUnderflow;
  const double speed_error = per_length * largest_entry(line.direction) + kUnderflow;
  const double t = above / speed, slowest = std::abs(speed) - speed_error;
  // |above' / speed' - above / speed| <= (|error of above| + |t| |error of speed|) / |speed'|, and the rounding of t.
  const double error =
      slowest > 0 ? ((above_error + std::abs(t) * speed_error) / slowest + kEpsilon * std::abs(t)) * (1 + 16 * kEpsilon)
                  : std::numeric_limits<double>::infinity();
  // Beyond this the rounded t is not worth showing: all but parallel to the plane, or huge coordinates.
  constexpr double kGoodEnough = 0x1p-30;
  if (!(error < kGoodEnough * std::max(1.0, std::abs(t)))) {
    const double exact = exact_parameter(line, face);
    return {std::clamp(exact, 0.0, line.t_end), 2 * kEpsilon * std::abs(exact)};
  }
  return {std::clamp(t, 0.0, line.t_end), error};
}

bool crosses_before(const DirectedLine& line, const Triangle& first, const Parameter& at_first, const Triangle& second,
                    const Parameter& at_second) {
  const double difference = at_second.t - at_first.t, error = at_first.error + at_second.error;
  if (std::abs(difference) * (1 - 4 * line_filter::kEpsilon) > error) return difference > 0;
  return exact_order(line, first, second) < 0;
}

}  // namespace prohull
