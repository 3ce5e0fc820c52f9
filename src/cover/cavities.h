#pragma once

#include "prohull/closed_solid.h"
#include "prohull/repair.h"

namespace prohull::cover {

// Covers fill the cavities of a mesh, as outer hulls do. The void of covers is compared with the mesh as it is, that of
// hulls with the filled one.

/// The volume of the closed mesh, which has no cavities. `inside` is the volume of the mesh as it is.
inline double fillable_volume(const RepairedMesh& input, const InsideVolume& inside, const Progress& progress) {
  return input.repairs.dropped_components > 0 ? volume_inside(input.closed->mesh, progress).volume : inside.volume;
}

}  // namespace prohull::cover
