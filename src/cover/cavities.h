#pragma once

#include "prohull/closed_solid.h"
#include "prohull/repair.h"

namespace prohull::cover {

// Covers fill the cavities of a mesh, as outer hulls do, and their void is compared with that of the filled one.

/// The volume of the mesh with its cavities filled. `inside` is that of the mesh as it is.
inline InsideVolume filled_volume(const RepairedMesh& input, const InsideVolume& inside, const Progress& progress) {
  return input.closed && input.repairs.dropped_components > 0 ? volume_inside(input.closed->mesh, progress) : inside;
}

}  // namespace prohull::cover
