#pragma once

#include <cstddef>
#include <functional>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// A hull that was tried: from a level of so many faces.
struct LevelTrial {
  std::size_t faces;
  TriangleMesh mesh;
  double excess;  ///< HullBounds::excess: above 1, it breaks a bound

  bool keeps_bounds() const { return excess <= 1; }
};

/// Of trials with `fewest` to `most` faces, one with few faces that keeps the bounds; if none of them does, the
/// nearest. Their faces together are limited, and by that the time.
LevelTrial search_levels(std::size_t fewest, std::size_t most, const std::function<LevelTrial(std::size_t)>& trial);

/// Of the faces that a search may try, what a single trial may take that tells whether a search is worth it.
std::size_t faces_of_first_trial(std::size_t fewest);

}  // namespace prohull
