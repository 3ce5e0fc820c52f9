#pragma once

#include <utility>
#include <vector>

#include "prohull/detail/progress_meter.h"
#include "verify/surface.h"

namespace prohull::verify {

using FacePairs = std::vector<std::pair<FaceIndex, FaceIndex>>;

/// All pairs f < g of faces that meet beyond shared corners and edges (see triangles_intersect), sorted. Exact.
FacePairs self_intersections(const Surface& surface, ProgressMeter& meter);

/// The same of a mesh, which need not be closed.
FacePairs self_intersections(const TriangleMesh& mesh, ProgressMeter& meter);

/// How many there are.
std::size_t count_self_intersections(const TriangleMesh& mesh, ProgressMeter& meter);

}  // namespace prohull::verify
