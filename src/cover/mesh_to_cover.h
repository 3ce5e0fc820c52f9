#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "prohull/closed_solid.h"
#include "prohull/enclosing_hull.h"
#include "prohull/repair.h"
#include "prohull/wrap.h"

// What covers by pieces and by spheres both do with the mesh that they are to cover.

namespace prohull::cover {

inline EnclosingOptions enclosing_options(unsigned threads, const Progress& progress) {
  return {.hull = {.threads = threads}, .progress = progress};
}

// Covers fill the cavities of a mesh, as outer hulls do, and their void is compared with that of the filled one.

/// The volume of the mesh with its cavities filled. `inside` is that of the mesh as it is.
inline InsideVolume filled_volume(const RepairedMesh& input, const InsideVolume& inside, const Progress& progress) {
  return input.closed && input.repairs.dropped_components > 0 ? volume_inside(input.closed->mesh, progress) : inside;
}

/// Of triangles that bound no solid, and what closes their openings: what lies inside of it counts as their inside.
inline Wrap wrap_around(const TriangleMesh& with_caps, double spacing, const Progress& progress) {
  constexpr double kClosing = 1.5;  // in spacings, as for hulls
  return wrap(with_caps, {.spacing = spacing, .seal_rooms = true, .closing = kClosing * spacing, .progress = progress});
}

inline void add_notes_of_repairs(const Repairs& repairs, std::vector<std::string>& notes) {
  if (repairs.crossing_components > 0)
    notes.push_back(fmt::format("components that are inside out and cross or repeat others count as solid: {}",
                                repairs.crossing_components));
  if (repairs.dropped_non_finite_faces > 0)
    notes.push_back(
        fmt::format("triangles with corners that are not finite were left out: {}", repairs.dropped_non_finite_faces));
}

}  // namespace prohull::cover
