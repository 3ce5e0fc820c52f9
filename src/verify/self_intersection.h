#pragma once

#include <utility>
#include <vector>

#include "parallel/progress_meter.h"
#include "verify/surface.h"

namespace prohull::verify {

/// All pairs f < g of faces that meet beyond shared corners and edges (see triangles_intersect), sorted. Exact.
std::vector<std::pair<FaceIndex, FaceIndex>> self_intersections(const Surface& surface, ProgressMeter& meter);

/// How many there are, also of a mesh that is not closed.
std::size_t count_self_intersections(const TriangleMesh& mesh, ProgressMeter& meter);

}  // namespace prohull::verify
