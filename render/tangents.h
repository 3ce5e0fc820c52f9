#pragma once

#include <array>
#include <cmath>

#include "prohull/geometry.h"

namespace prohull::render {

/// Two directions that are orthogonal to n, of length 1, and to each other.
inline std::array<Vec3, 2> tangents(const Vec3& n) {
  const Vec3 other = std::abs(n.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = cross(n, other), first = across / norm(across);
  return {first, cross(n, first)};
}

}  // namespace prohull::render
