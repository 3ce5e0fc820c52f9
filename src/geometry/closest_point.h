#pragma once

#include <algorithm>
#include <cmath>

#include "prohull/geometry.h"

namespace prohull {

/// Where on a triangle the point closest to another lies, but for rounding.
struct Foot {
  enum class On { Corner, Edge, Face } on;
  int from = 0, to = 0;  ///< corners: the one, or both ends of the edge
  double v = 0, w = 0;   ///< fraction of the way along the edge; on the face, of those from corner 0 to 1 and to 2
};

/// The same of a triangle so thin, or seen from so far away, that rounding hides on which side of its edges p is.
Foot foot_on_thin_triangle(const Vec3& away_a, const Vec3& away_b, const Vec3& away_c, const Vec3& ab, const Vec3& ac);

/// Of the triangle with corner i at p - away[i], and with the sides ab and ac (Ericson, Real-Time Collision Detection,
/// 5.1.5). All fractions, and v + w, are in [0, 1], whatever rounding did: the foot is a point of the triangle.
inline Foot foot_on_triangle(const Vec3& away_a, const Vec3& away_b, const Vec3& away_c, const Vec3& ab,
                             const Vec3& ac) {
  using enum Foot::On;
  const double d1 = dot(ab, away_a), d2 = dot(ac, away_a), d3 = dot(ab, away_b), d4 = dot(ac, away_b),
               d5 = dot(ab, away_c), d6 = dot(ac, away_c);
  const auto fraction = [](double part, double rest) {
    const double whole = part + rest;
    return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0;
  };
  if (d1 <= 0 && d2 <= 0) return {Corner, 0};
  if (d3 >= 0 && d4 <= d3) return {Corner, 1};
  if (d6 >= 0 && d5 <= d6) return {Corner, 2};
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  // Their sum is the square of twice the area, and each is rounded by some 2^-50 of such products. This is also where
  // they leave the range of double.
  if (!(va + vb + vc > 0x1p-32 * ((std::abs(d1) + std::abs(d3)) * (std::abs(d2) + std::abs(d6)))))
    return foot_on_thin_triangle(away_a, away_b, away_c, ab, ac);
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {Edge, 0, 1, fraction(d1, -d3)};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {Edge, 0, 2, fraction(d2, -d6)};
  if (va <= 0 && d4 >= d3 && d5 >= d6) return {Edge, 1, 2, fraction(d4 - d3, d5 - d6)};
  const double v = fraction(vb, va + vc);
  return {Face, 0, 0, v, std::min(fraction(vc, va + vb), 1 - v)};
}

/// A point of t close to p, the closest but for rounding.
inline Vec3 closest_point(const Vec3& p, const Triangle& t) {
  const Vec3 ab = t.b - t.a, ac = t.c - t.a;
  const Foot foot = foot_on_triangle(p - t.a, p - t.b, p - t.c, ab, ac);
  const Vec3& from = foot.from == 0 ? t.a : foot.from == 1 ? t.b : t.c;
  switch (foot.on) {
    case Foot::On::Corner:
      return from;
    case Foot::On::Edge:
      return from + ((foot.to == 1 ? t.b : t.c) - from) * foot.v;
    case Foot::On::Face:
      break;
  }
  return t.a + ab * foot.v + ac * foot.w;
}

/// Of the box.
inline Vec3 closest_point(const Vec3& p, const Box& box) {
  return {std::clamp(p.x, box.min.x, box.max.x), std::clamp(p.y, box.min.y, box.max.y),
          std::clamp(p.z, box.min.z, box.max.z)};
}

}  // namespace prohull
