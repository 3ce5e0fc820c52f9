#include "geometry/largest_coordinate.h"

#include <fmt/format.h>

#include "prohull/error.h"

namespace prohull {

void require_usable_reach(const Box& box, std::string_view what) {
  const double reach = largest_coordinate(box);
  if (reach > kLargestCoordinate)
    throw InputError(
        Defect::NonFiniteCoordinate,
        fmt::format("{} reach {:g}; beyond {:g} volumes overflow: scale the mesh", what, reach, kLargestCoordinate));
}

}  // namespace prohull
