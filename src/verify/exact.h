#pragma once

#include <array>

#include "geometry/lazy_number.h"
#include "prohull/geometry.h"

namespace prohull::verify {

using Number = LazyNumber;

inline Vec3 rounded(const std::array<Number, 3>& p) { return {p[0].rounded(), p[1].rounded(), p[2].rounded()}; }

}  // namespace prohull::verify
