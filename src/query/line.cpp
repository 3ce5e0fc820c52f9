#include "query/line.h"

#include "geometry/double_double.h"
#include "geometry/rounded_turn.h"
#include "geometry/triangle_predicates.h"
#include "query/exact_line.h"

namespace prohull {
namespace {

/// The sign of component `axis` of (b - a) cross (d - c).
int minor_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int axis) {
  const int i = axis == 2 ? 0 : axis + 1, j = axis == 0 ? 2 : axis - 1;
  const double ui = b[i] - a[i], uj = b[j] - a[j], vi = d[i] - c[i], vj = d[j] - c[j];
  if ((ui == 0 || vj == 0) && (uj == 0 || vi == 0)) return 0;
  if (const auto sign = certain_minor_sign(ui, uj, vi, vj)) return *sign;
  return exact_minor_sign(a, b, c, d, axis);
}

/// The sign of the change that the move (e, e^2, e^3) makes to something with the gradient (b - a) cross (d - c).
int sign_of_move(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  for (int axis = 0; axis < 3; ++axis)
    if (const int sign = minor_sign(a, b, c, d, axis); sign != 0) return sign;
  return 0;
}

/// Whether it is plain that the line, not moved and without ends, passes through p.
bool certainly_passes(const DirectedLine& line, const Vec3& p) {
  if (p == line.origin || p == line.end) return true;
  const Vec3& d = line.direction;
  return (d.x != 0) + (d.y != 0) + (d.z != 0) == 1 && (d.x != 0 || p.x == line.origin.x) &&
         (d.y != 0 || p.y == line.origin.y) && (d.z != 0 || p.z == line.origin.z);
}

DoubleDoubleVector exact_direction(const DirectedLine& line) {
  return line.is_ray() ? DoubleDoubleVector(Vec3{}, line.direction) : DoubleDoubleVector(line.origin, line.end);
}

/// The sign of dot(direction, (p - o) cross (q - o)), the line not moved: 0 if it meets the line of the edge. Exact.
int unmoved_edge_sign(const DirectedLine& line, const Vec3& p, const Vec3& q) {
  const DoubleDoubleVector along = exact_direction(line), to_p(line.origin, p), to_q(line.origin, q);
  if (const int sign = double_double_sign(along, to_p, to_q); sign != 0) return sign;
  const DoubleDoubleVector edge(p, q);
  const bool is_met = certainly_parallel(along, to_p) || certainly_parallel(along, to_q) ||
                      certainly_parallel(edge, to_p) || (!line.is_ray() && certainly_parallel(edge, {p, line.end}));
  return is_met ? 0 : exact_edge_sign(line, p, q);
}

int unmoved_point_sign(const Vec3& point, const Triangle& face) {
  const int sign = double_double_sign({point, face.a}, {point, face.b}, {point, face.c});
  return sign != 0 ? sign : exact_point_sign(point, face);
}

/// The sign of dot(direction, (p - o) cross (q - o)), o the moved origin, of which `value` is rounded and not moved: on
/// which side the line passes the edge from p to q. 0 only if the line is parallel to the edge. Exact.
int edge_sign(const DirectedLine& line, const Vec3& p, const Vec3& q, double value, double error) {
  if (value > error) return 1;
  if (value < -error) return -1;
  if (!certainly_passes(line, p) && !certainly_passes(line, q))
    if (const int sign = unmoved_edge_sign(line, p, q); sign != 0) return sign;
  return line.is_ray() ? sign_of_move(Vec3{}, line.direction, p, q) : sign_of_move(line.origin, line.end, p, q);
}

/// The side of the moved point: 1 inside of the plane of the face, -1 outside; 0 only if the face has no area. Exact.
int point_sign(const Vec3& point, const FaceFromPoint& seen, const Triangle& face) {
  const double value = seen.side(), error = seen.side_error();
  if (value > error) return 1;
  if (value < -error) return -1;
  if (!is_corner(face, point))
    if (const int sign = unmoved_point_sign(point, face); sign != 0) return sign;
  return -sign_of_move(face.a, face.b, face.a, face.c);
}

}  // namespace

int exact_edge_side(const DirectedLine& line, const Vec3& p, const Vec3& q) { return edge_sign(line, p, q, 0, 0); }

namespace {

/// The plane of a face, above which the line's origin is, and along which it goes: t = above / speed.
struct PlaneFromLine {
  PlaneFromLine(const DirectedLine& line, const DoubleDoubleVector& along, const Triangle& face) {
    const DoubleDoubleVector u(face.a, face.b), v(face.a, face.c), to_face(line.origin, face.a);
    const double area = u.largest_entry() * v.largest_entry();
    largest = std::max({along.largest_entry(), to_face.largest_entry(), u.largest_entry(), v.largest_entry()});
    most_speed = along.largest_entry() * area, most_above = to_face.largest_entry() * area;
    speed = double_double::determinant(along, u, v), above = double_double::determinant(to_face, u, v);
  }
  DoubleDouble speed, above;
  double largest;                 ///< entry of all vectors
  double most_speed, most_above;  ///< but for a factor of 6
};

// Speeds and distances are in doubt by 512 eps^2 of these bounds, and at most 7 times as large. So their products are
// in doubt by 2 x 7 x 512 eps^2; the product of two low parts, which is left out, and the roundings come to less than
// 2^13 eps^2 more. While entries are below 2^100, a speed or distance is off by less than 2^-900 where products
// underflow, and their products by less than 2^-390.
int double_double_order(const DirectedLine& line, const Triangle& first, const Triangle& second) {
  using double_double::sign_beyond, double_double::kEpsilon, double_double::kUnderflow;
  constexpr double kLargest = 0x1p100, kLeast = 0x1p-390, kProducts = 0x1p16;
  const DoubleDoubleVector along = exact_direction(line);
  const PlaneFromLine one(line, along, first), other(line, along, second);
  if (!(one.largest < kLargest && other.largest < kLargest)) return 0;
  const auto speed_of = [](const PlaneFromLine& plane) {
    return sign_beyond(513 * kEpsilon * kEpsilon * plane.most_speed + kUnderflow * kLargest, plane.speed);
  };
  const double error =
      kProducts * kEpsilon * kEpsilon * (one.most_above * other.most_speed + other.most_above * one.most_speed) +
      kLeast;
  return speed_of(one) * speed_of(other) * sign_beyond(error, one.above * other.speed - other.above * one.speed);
}

}  // namespace

int order(const DirectedLine& line, const Triangle& first, const Triangle& second) {
  const int order = double_double_order(line, first, second);
  return order != 0 ? order : exact_order(line, first, second);
}

int pierced(const DirectedLine& line, const Triangle& face) {
  const FaceFromLine seen(line, face);
  if (seen.certainly_passed()) return 0;
  const int sign = edge_sign(line, face.a, face.b, seen.ab, seen.error);
  // Never all three of a line parallel to the plane: their sum is dot(direction, normal), moved or not.
  if (sign == 0 || edge_sign(line, face.b, face.c, seen.bc, seen.error) != sign ||
      edge_sign(line, face.c, face.a, seen.ca, seen.error) != sign)
    return 0;
  return sign;
}

namespace {

/// Whether the line passes the plane of the face between its ends.
bool is_within(const DirectedLine& line, const Triangle& face, int sign) {
  return point_sign(line.origin, FaceFromPoint(line.origin, face), face) == sign &&
         (line.is_ray() || point_sign(line.end, FaceFromPoint(line.end, face), face) != sign);
}

}  // namespace

Crossing crossing(const DirectedLine& line, const Triangle& face) {
  const int sign = pierced(line, face);
  if (sign == 0 || !is_within(line, face, sign)) return Crossing::None;
  return sign > 0 ? Crossing::Leaving : Crossing::Entering;
}

namespace {

// By the normal n = u cross v of the edges u, v from corner a: t = dot(n, a - origin) / dot(n, direction), which is as
// accurate for a small face far from the origin as for a near one. Rounding u, v, the products and the differences
// moves a coordinate of n by at most 4.1 eps of its terms, 2 Lu Lv with L the largest entries; a product with a rounded
// w adds 2.1 eps, the two sums 2 eps: each dot(n, w) is within 3 * 8.2 eps * 2 Lu Lv Lw.
Parameter rounded_parameter(const DirectedLine& line, const Triangle& face) {
  using namespace line_filter;
  const Vec3 u = face.b - face.a, v = face.c - face.a, to_face = face.a - line.origin, n = cross(u, v);
  const double above = dot(n, to_face), speed = dot(n, line.direction);
  const double per_length = 50 * kEpsilon * largest_entry(u) * largest_entry(v);
  const auto error_with = [&](double w) { return per_length * w + kUnderflow * std::max(1.0, w); };
  const double above_error = error_with(largest_entry(to_face)),
               speed_error = error_with(largest_entry(line.direction));
  const double t = above / speed, slowest = std::abs(speed) - speed_error;
  // |above' / speed' - above / speed| <= (|error of above| + |t| |error of speed|) / |speed'|, and the rounding of t.
  const double error =
      slowest > 0 && slowest < std::numeric_limits<double>::infinity()
          ? ((above_error + std::abs(t) * speed_error) / slowest + kEpsilon * std::abs(t)) * (1 + 16 * kEpsilon)
          : std::numeric_limits<double>::infinity();
  return {t, error};
}

/// Never -0.
double within(double t, const DirectedLine& line) { return std::clamp(t, 0.0, line.t_end) + 0.0; }

/// What is shown of the rounded parameter.
Parameter shown(const Parameter& rounded, const DirectedLine& line, const Triangle& face) {
  // Beyond this the rounded t is not worth showing: all but parallel to the plane, or huge coordinates.
  constexpr double kGoodEnough = 0x1p-30;
  if (rounded.error < kGoodEnough * std::max(1.0, std::abs(rounded.t))) return {within(rounded.t, line), rounded.error};
  const double exact = exact_parameter(line, face);
  return {within(exact, line), 2 * line_filter::kEpsilon * std::abs(exact)};
}

}  // namespace

Parameter parameter(const DirectedLine& line, const Triangle& face) {
  return shown(rounded_parameter(line, face), line, face);
}

std::optional<Parameter> parameter_if_within(const DirectedLine& line, const Triangle& face, int sign) {
  const Parameter at = rounded_parameter(line, face);
  const bool certainly_within = at.t > at.error && (line.is_ray() || 1 - at.t > at.error);
  const bool certainly_not = at.t < -at.error || (!line.is_ray() && at.t - 1 > at.error);
  if (certainly_not || (!certainly_within && !is_within(line, face, sign))) return std::nullopt;
  return shown(at, line, face);
}

}  // namespace prohull
