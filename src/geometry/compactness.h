#pragma once

#include <cmath>

#include "prohull/geometry.h"

namespace prohull {

/// 4 sqrt(3) area / (sum of the squared edges), 1 for an equilateral triangle (Gueziec 1999); the area is given
/// doubled.
inline double compactness(double double_area, double squared_edges) {
  return squared_edges > 0 ? 2 * std::sqrt(3.0) * double_area / squared_edges : 0;
}

inline double squared_edges(const Vec3& a, const Vec3& b, const Vec3& c) {
  return squared_norm(b - a) + squared_norm(c - b) + squared_norm(a - c);
}

}  // namespace prohull
