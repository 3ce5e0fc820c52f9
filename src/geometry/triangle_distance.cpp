#include "geometry/triangle_distance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/closest_point.h"

namespace prohull {
namespace {

struct Points {
  Vec3 s, t;
  double squared_distance = std::numeric_limits<double>::infinity();

  void consider(const Vec3& p, const Vec3& q) {
    const double d = squared_norm(q - p);
    if (d < squared_distance) s = p, t = q, squared_distance = d;
  }
};

double fraction(double part, double whole) { return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0; }

/// Ericson, Real-Time Collision Detection, 5.1.9.
void consider_edges(Points& best, const Vec3& p, const Vec3& p_end, const Vec3& q, const Vec3& q_end) {
  const Vec3 u = p_end - p, v = q_end - q, r = p - q;
  const double a = dot(u, u), b = dot(u, v), c = dot(u, r), e = dot(v, v), f = dot(v, r);
  double s = fraction(b * f - c * e, a * e - b * b);
  const double t = e > 0 ? (b * s + f) / e : 0;
  if (!(t >= 0)) s = fraction(-c, a);
  if (t > 1) s = fraction(b - c, a);
  best.consider(p + u * s, q + v * std::clamp(t >= 0 ? t : 0.0, 0.0, 1.0));
}

}  // namespace

TriangleDistance triangle_distance(const Triangle& s, const Triangle& t) {
  // As seen from a corner: these differences have relative errors only. A power of two keeps products in range; it is
  // small enough for both bounds, which are 0 or above 2^-48 of it, to be normal numbers.
  std::array<Vec3, 3> from{Vec3{}, s.b - s.a, s.c - s.a}, to{t.a - s.a, t.b - s.a, t.c - s.a};
  double size = 0;
  for (const auto& corners : {from, to})
    for (const Vec3& p : corners) size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const double unit = std::ldexp(1.0, -std::ilogb(std::max(size, 0x1p-900)));
  for (auto* corners : {&from, &to})
    for (Vec3& p : *corners) p = p * unit;
  Points best;
  for (std::size_t i = 0; i < 3; ++i) {
    best.consider(from[i], closest_point(from[i], Triangle{to[0], to[1], to[2]}));
    best.consider(closest_point(to[i], Triangle{from[0], from[1], from[2]}), to[i]);
    for (std::size_t j = 0; j < 3; ++j) consider_edges(best, from[i], from[(i + 1) % 3], to[j], to[(j + 1) % 3]);
  }
  // Coordinates are less than 2. The points are combinations of corners with fractions in [0, 1]: each coordinate is
  // within 24 eps of a point of its triangle, with eps = 2^-53, and their distance within 128 eps.
  constexpr double kEpsilon = 0x1p-53;
  const Vec3 axis = best.t - best.s;
  const double length = norm(axis);
  TriangleDistance result{0, (length * (1 + 8 * kEpsilon) + 128 * kEpsilon) / unit, s.a + best.s / unit,
                          s.a + best.t / unit};
  // Whatever the axis, no two points of the triangles are nearer than what separates them along it. The products have
  // errors of 12 eps of the product of the largest entries, as in geometry/triangle_contact.cpp.
  const auto range = [&](const std::array<Vec3, 3>& corners) {
    return std::minmax({dot(axis, corners[0]), dot(axis, corners[1]), dot(axis, corners[2])});
  };
  const double gap = range(to).first - range(from).second - 64 * kEpsilon * length;
  if (length > 0x1p-100 && gap > 0) result.lower = gap / length * (1 - 8 * kEpsilon) / unit;
  return result;
}

}  // namespace prohull
