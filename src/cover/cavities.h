#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "prohull/closed_solid.h"
#include "prohull/detail/rounded.h"
#include "prohull/repair.h"

namespace prohull::cover {

// Covers fill the cavities of a mesh, as outer hulls do. The void of covers is compared with the mesh as it is, that of
// hulls with the filled one.

/// The volume of the closed mesh, which has no cavities. `inside` is the volume of the mesh as it is.
inline double fillable_volume(const RepairedMesh& input, const InsideVolume& inside, const Progress& progress) {
  return input.repairs.dropped_components > 0 ? volume_inside(input.closed->mesh, progress).volume : inside.volume;
}

/// Whether there are cavities.
inline bool add_note_of_cavities(double volume, double fillable, std::vector<std::string>& notes) {
  constexpr double kSame = 1 + 1e-6;
  if (!(volume > 0 && fillable > kSame * volume)) return false;
  notes.push_back(fmt::format("cavities of the mesh count as filled: with them it has {} more volume",
                              percent_text(fillable / volume - 1, 2)));
  return true;
}

}  // namespace prohull::cover
