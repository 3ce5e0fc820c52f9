#pragma once

#include <optional>
#include <string>

#include "prohull/triangle_mesh.h"

namespace prohull::certificate {

/// What follows the distance in its section: for each triangle of the hull a tree of halves, of which each lies within
/// the distance of one of the triangles. Nothing if some point is farther away, or if too many parts would be needed.
std::optional<std::string> distance_trees(const TriangleMesh& hull, const TriangleMesh& triangles, double distance);

}  // namespace prohull::certificate
