#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "prohull/geometry.h"

namespace prohull {

/// Of its corners, by absolute value. The box is not empty.
inline double largest_coordinate(const Box& box) {
  return std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.min.z), std::abs(box.max.x),
                   std::abs(box.max.y), std::abs(box.max.z)});
}

/// The largest coordinate of which products of three, as in volumes and determinants, stay in the range of double.
inline constexpr double kLargestCoordinate = 1e100;

/// Throws InputError if a coordinate of the box is larger than kLargestCoordinate; the message begins with `what`, such
/// as "coordinates".
void require_usable_reach(const Box& box, std::string_view what);

}  // namespace prohull
