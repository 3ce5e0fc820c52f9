#pragma once

#include <cmath>
#include <optional>

#include "prohull/geometry.h"

namespace prohull {

/// The sign of a * d - b * c, of rounded differences, as their exact values have it; nothing where rounding may hide
/// it. Each difference, product and sum is rounded by at most 2^-53 of itself, so that 4 times as much of the sizes of
/// both products is enough (Shewchuk 1997). The rest is more than what underflows; what overflows is not certain.
inline std::optional<int> certain_minor_sign(double a, double b, double c, double d) {
  const double left = a * d, right = b * c, determinant = left - right;
  const double error = 0x1p-51 * (std::abs(left) + std::abs(right)) + 0x1p-1000;
  if (determinant > error) return 1;
  if (-determinant > error) return -1;
  return std::nullopt;
}

/// The `turn` of predicates.h where it is certain.
inline std::optional<int> certain_turn(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int u = axis == 2 ? 0 : axis + 1, v = axis == 0 ? 2 : axis - 1;
  return certain_minor_sign(b[u] - a[u], b[v] - a[v], c[u] - a[u], c[v] - a[v]);
}

/// Along which a vector is longest, the last one of several.
inline int dominant_axis(const Vec3& n) {
  const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  return z >= x && z >= y ? 2 : y >= x ? 1 : 0;
}

}  // namespace prohull
