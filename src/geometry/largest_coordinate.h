#pragma once

#include <algorithm>
#include <cmath>

#include "prohull/geometry.h"

namespace prohull {

/// Of its corners, by absolute value. The box is not empty.
inline double largest_coordinate(const Box& box) {
  return std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.min.z), std::abs(box.max.x),
                   std::abs(box.max.y), std::abs(box.max.z)});
}

}  // namespace prohull
