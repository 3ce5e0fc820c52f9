#pragma once

#include <vector>

#include "cover/depth.h"
#include "cover/patches.h"
#include "prohull/detail/progress_meter.h"

namespace prohull::cover {

/// Adds corners of cubes, so that patches of them cover the inside of the solid too: the corners in the solid of each
/// cube that its surface passes, and all corners of the others, of which those far inside are joined. Required:
/// `points` has the surface of the solid, cut along the walls of the grid.
void add_inside(std::vector<PointInCube>& points, const CubeGrid& grid, const Box& box, const Depth& depth,
                ProgressMeter& meter);

}  // namespace prohull::cover
