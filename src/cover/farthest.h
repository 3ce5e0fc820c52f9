#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "prohull/geometry.h"

namespace prohull::cover {

/// The distance of the farthest point; 0 if there is none.
inline double farthest(const Vec3& from, std::span<const Vec3> points) {
  double most = 0;
  for (const Vec3& p : points) most = std::max(most, squared_norm(p - from));
  return std::sqrt(most);
}

}  // namespace prohull::cover
