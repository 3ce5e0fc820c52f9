#pragma once

#include <cmath>

namespace prohull {

/// 4 sqrt(3) area / (sum of the squared edges), 1 for an equilateral triangle (Gueziec 1999); the area is given
/// doubled.
inline double compactness(double double_area, double squared_edges) {
  return squared_edges > 0 ? 2 * std::sqrt(3.0) * double_area / squared_edges : 0;
}

}  // namespace prohull
