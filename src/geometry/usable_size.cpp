#include "geometry/usable_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "prohull/error.h"

namespace prohull {

void require_usable_reach(const Box& box, std::string_view what) {
  const double reach = std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.min.z), std::abs(box.max.x),
                                 std::abs(box.max.y), std::abs(box.max.z)});
  if (reach > kLargestCoordinate)
    throw InputError(
        Defect::NonFiniteCoordinate,
        fmt::format("{} reach {:g}; beyond {:g} volumes overflow: scale the mesh", what, reach, kLargestCoordinate));
}

}  // namespace prohull
