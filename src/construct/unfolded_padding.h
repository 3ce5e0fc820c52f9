#pragma once

#include "prohull/triangle_mesh.h"

namespace prohull {

/// As padded_hull (padded_hull.h), but where a face would turn over, as in hollows narrower than the padding, an edge
/// of it is collapsed before, outside of its faces.
TriangleMesh padded_without_folds(const TriangleMesh& hull, double distance);

}  // namespace prohull
