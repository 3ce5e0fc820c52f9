#pragma once

#include <vector>

#include "wrap/cells.h"

namespace prohull {

/// The surface where `values`, one for each node of the grid, linear on each tetrahedron of its cells, are `level`: by
/// marching tetrahedra on the six tetrahedra of each cell around its diagonal (Freudenthal). It faces towards greater
/// values. Closed, a 2-manifold and free of self-intersection, if the outermost nodes have greater values and all
/// crossings are kept apart: values nearer to the level than a hundredth are moved away from it.
TriangleMesh level_surface(const Grid& grid, const Cells& cells, const std::vector<float>& values, float level);

}  // namespace prohull
