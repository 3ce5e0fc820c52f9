#pragma once

#include <CGAL/Gmpq.h>

#include <array>

#include "prohull/geometry.h"

namespace prohull {

using Number = CGAL::Gmpq;
using Point = std::array<Number, 3>;

inline Point exact(const Vec3& v) { return {v.x, v.y, v.z}; }
inline Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Number dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace prohull
