#pragma once

#include <string_view>

#include "prohull/geometry.h"

namespace prohull {

/// The largest coordinate of which products of three, as in volumes and determinants, stay in the range of double.
inline constexpr double kLargestCoordinate = 1e100;

/// Throws InputError if a coordinate of the box is larger than kLargestCoordinate; the message begins with `what`, such
/// as "coordinates".
void require_usable_reach(const Box& box, std::string_view what);

}  // namespace prohull
