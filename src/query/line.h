#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "prohull/geometry.h"

namespace prohull {

/// A segment or ray, ready to be tested against many faces: points origin + t direction, t in [0, t_end].
struct DirectedLine {
  explicit DirectedLine(const Segment& s) : origin(s.a), direction(s.b - s.a), end(s.b), t_end(1) {}
  explicit DirectedLine(const Ray& r)
      : origin(r.origin), direction(r.direction), end(r.origin), t_end(std::numeric_limits<double>::infinity()) {}

  bool is_ray() const { return t_end != 1; }
  bool is_a_point() const { return end == origin && direction == Vec3{}; }
  Vec3 at(double t) const { return is_ray() ? origin + t * direction : (1 - t) * origin + t * end; }

  Vec3 origin;
  Vec3 direction;  ///< of a segment: b - a, rounded
  Vec3 end;        ///< of a segment: b
  double t_end;    ///< 1 for a segment, infinity for a ray
};

enum class Crossing { None, Entering, Leaving };

/// How the line, moved by (e, e^2, e^3) for an infinitesimal e, crosses the face (see MeshQuery). Exact.
Crossing crossing(const DirectedLine& line, const Triangle& face);

/// On which side the line, moved likewise, passes the edge from p to q: the sign of dot(direction, (p - o) cross (q -
/// o)) for its origin o. 0 only if the line is parallel to the edge. Exact, and slow: for what filters leave open.
int exact_edge_side(const DirectedLine& line, const Vec3& p, const Vec3& q);

/// The order in which the line, moved likewise, crosses the planes of two faces, to neither of which it is parallel: -1
/// if the first comes first, 0 if they are one plane. Exact, and slow: where rounded_order leaves it open.
int order(const DirectedLine& line, const Triangle& first, const Triangle& second);

/// How the whole line, moved likewise and extended beyond both ends, passes through the face: 1 if it leaves, -1 if it
/// enters, 0 if it does not. Exact.
int pierced(const DirectedLine& line, const Triangle& face);

/// Where the line meets the plane of a face that it crosses: the true t, unmoved, is within `error` of `t`.
struct Parameter {
  double t, error;
};
Parameter parameter(const DirectedLine& line, const Triangle& face);

/// The parameter of a face that the whole line passes through, with `sign`, if the line does so between its ends.
std::optional<Parameter> parameter_if_within(const DirectedLine& line, const Triangle& face, int sign);

/// Which of two crossings is certainly the first: -1, 1, or 0 if that is not certain.
inline int rounded_order(const Parameter& first, const Parameter& second) {
  const double difference = second.t - first.t, error = first.error + second.error;
  if (!(std::abs(difference) * (1 - 0x1p-51) > error)) return 0;
  return difference > 0 ? -1 : 1;
}

namespace line_filter {

// For rows that are rounded differences of coordinates Shewchuk ("Adaptive Precision Floating-Point Arithmetic and
// Fast Robust Geometric Predicates", 1997, 4.3) bounds the error of the determinant (x, y, z), evaluated as here, by
// (7 + 56 eps) eps times its permanent, eps = 2^-53. The permanent is at most 6 times the product of the rows' largest
// entries; 2^-1000, times the first row's if that is above 1, stands for products that underflow, while the entries are
// below 2^300.
constexpr double kEpsilon = 0x1p-53;
constexpr double kPermanentBound = (7.0 + 56.0 * kEpsilon) * kEpsilon;
constexpr double kLargest = 0x1p300, kUnderflow = 0x1p-1000;

inline double largest_entry(const Vec3& v) { return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z)); }

/// dot(x, y cross z), evaluated as Shewchuk does.
inline double determinant(const Vec3& x, const Vec3& y, const Vec3& z) {
  return x.x * (y.y * z.z - y.z * z.y) + x.y * (y.z * z.x - y.x * z.z) + x.z * (y.x * z.y - y.y * z.x);
}

/// Of determinants of rows with these largest entries; infinite where the bound is not proven.
inline double error_bound(double x, double y, double z) {
  if (!(x < kLargest && y < kLargest && z < kLargest)) return std::numeric_limits<double>::infinity();
  return 6.0 * (1 + 4 * kEpsilon) * kPermanentBound * x * y * z + kUnderflow * std::max(1.0, x);
}

}  // namespace line_filter

/// The corners of a face as a point sees them.
struct FaceFromPoint {
  FaceFromPoint(const Vec3& p, const Triangle& face)
      : a(face.a - p),
        b(face.b - p),
        c(face.c - p),
        size(std::max(std::max(line_filter::largest_entry(a), line_filter::largest_entry(b)),
                      line_filter::largest_entry(c))) {}

  double side() const { return line_filter::determinant(a, b, c); }  ///< positive: the point is inside of the plane
  double side_error() const { return line_filter::error_bound(size, size, size); }

  Vec3 a, b, c;
  double size;  ///< largest entry
};

/// On which side a line passes the edges of a face.
struct FaceFromLine : FaceFromPoint {
  FaceFromLine(const DirectedLine& line, const Triangle& face)
      : FaceFromPoint(line.origin, face),
        ab(line_filter::determinant(line.direction, a, b)),
        bc(line_filter::determinant(line.direction, b, c)),
        ca(line_filter::determinant(line.direction, c, a)),
        error(line_filter::error_bound(line_filter::largest_entry(line.direction), size, size)) {}

  /// Whether the line certainly passes the face by, on different sides of two edges.
  bool certainly_passed() const {
    return std::min(std::min(ab, bc), ca) < -error && std::max(std::max(ab, bc), ca) > error;
  }
  /// dot(direction, normal), the normal of the length of twice the area: positive if the line leaves.
  double leaving() const { return ab + bc + ca; }
  double leaving_error() const {
    return 3 * error + 4 * line_filter::kEpsilon * (std::abs(ab) + std::abs(bc) + std::abs(ca));
  }

  double ab, bc, ca;  ///< dot(direction, a cross b) and so on: positive where a line that leaves has the edge
  double error;       ///< of each of them
};

}  // namespace prohull
