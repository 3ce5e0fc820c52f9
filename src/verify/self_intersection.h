#pragma once

#include <utility>
#include <vector>

#include "verify/surface.h"

namespace prohull::verify {

/// All pairs f < g of faces that meet beyond shared corners and edges (see triangles_intersect), sorted. Exact.
std::vector<std::pair<FaceIndex, FaceIndex>> self_intersections(const Surface& surface);

}  // namespace prohull::verify
