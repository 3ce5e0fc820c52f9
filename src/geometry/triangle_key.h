#pragma once

#include <algorithm>
#include <array>

#include "prohull/geometry.h"

namespace prohull {

/// The corners of a triangle, in an order that equal triangles have in common. Keys are in an order of their own; -0
/// equals 0.
using TriangleKey = std::array<std::array<double, 3>, 3>;

inline TriangleKey coordinates_of(const Triangle& t) {
  return {{{t.a.x, t.a.y, t.a.z}, {t.b.x, t.b.y, t.b.z}, {t.c.x, t.c.y, t.c.z}}};
}

/// Equal for triangles with the same corners in the same orientation: from the least corner on.
inline TriangleKey oriented_key(const Triangle& t) {
  TriangleKey key = coordinates_of(t);
  std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
  return key;
}

/// Equal for triangles with the same corners in any orientation.
inline TriangleKey unoriented_key(const Triangle& t) {
  TriangleKey key = coordinates_of(t);
  std::sort(key.begin(), key.end());
  return key;
}

}  // namespace prohull
