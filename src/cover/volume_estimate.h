#pragma once

#include <span>

#include "prohull/triangle_mesh.h"

namespace prohull::cover {

struct VolumeEstimate {
  double volume = 0;
  double standard_error = 0;
};

/// The volume of the union of convex polytopes that look outwards; overlaps count once. The same for any number of
/// threads. The exact clipping of union_volume takes minutes where thousands overlap.
///
/// How it works: A box around all is halved again and again. Cells off all polytopes count as empty, and cells in one
/// of them as full. Of the cells between, which are halved until there are too many, random points decide: two in each,
/// whose difference tells the error.
VolumeEstimate estimated_volume(std::span<const TriangleMesh> polytopes);

}  // namespace prohull::cover
