#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "prohull/geometry.h"

namespace prohull {

/// Directions of length 1, evenly spread over the sphere: along a spiral whose turns are the golden angle apart.
inline std::vector<Vec3> spread_directions(std::size_t count) {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = static_cast<double>(i);
    const double z = 1 - (2 * at + 1) / static_cast<double>(count), r = std::sqrt(1 - z * z);
    directions.push_back({r * std::cos(at * golden_angle), r * std::sin(at * golden_angle), z});
  }
  return directions;
}

/// A direction of length 1 at right angles to `u`, which has that length, too.
inline Vec3 any_normal(const Vec3& u) {
  const Vec3 axis = std::abs(u.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 n = cross(u, axis);
  return n / norm(n);
}

}  // namespace prohull
