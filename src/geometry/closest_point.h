#pragma once

#include <algorithm>

#include "prohull/geometry.h"

namespace prohull {

/// A point of t close to p, the closest but for rounding (Ericson, Real-Time Collision Detection, 5.1.5).
inline Vec3 closest_point(const Vec3& p, const Triangle& t) {
  const Vec3 ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a, bp = p - t.b, cp = p - t.c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  // Fractions in [0, 1], whatever rounding did: what is returned is a point of the triangle.
  const auto fraction = [](double part, double rest) {
    const double whole = part + rest;
    return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0;
  };
  if (d1 <= 0 && d2 <= 0) return t.a;
  if (d3 >= 0 && d4 <= d3) return t.b;
  if (d6 >= 0 && d5 <= d6) return t.c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return t.a + ab * fraction(d1, -d3);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return t.a + ac * fraction(d2, -d6);
  if (va <= 0 && d4 >= d3 && d5 >= d6) return t.b + (t.c - t.b) * fraction(d4 - d3, d5 - d6);
  const double v = fraction(vb, va + vc), w = std::min(fraction(vc, va + vb), 1 - v);
  return t.a + ab * v + ac * w;
}

/// Of the box.
inline Vec3 closest_point(const Vec3& p, const Box& box) {
  return {std::clamp(p.x, box.min.x, box.max.x), std::clamp(p.y, box.min.y, box.max.y),
          std::clamp(p.z, box.min.z, box.max.z)};
}

}  // namespace prohull
