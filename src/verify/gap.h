#pragma once

#include "prohull/enclosure.h"
#include "prohull/verification.h"

namespace prohull::verify {

struct GapReport {
  std::size_t faces_too_near = 0;   ///< exact
  std::size_t faces_undecided = 0;  ///< EnclosureOptions::max_steps ended the search before
  std::vector<NearFace> nearest;    ///< of those too near, the nearest first, as far as they were measured
  double least_distance = 0;        ///< of all faces, rounded up; NaN if some were not measured
  double proven_distance = 0;       ///< no face is nearer than this: least_distance, but for rounding

  bool keeps_gap() const { return faces_too_near == 0 && faces_undecided == 0; }
};

/// Which faces of `hull` are nearer to `original` than `gap`, which is greater than 0. Both meshes may be any triangles
/// that are finite.
GapReport verify_gap(const TriangleMesh& hull, const TriangleMesh& original, double gap,
                     const EnclosureOptions& options);

}  // namespace prohull::verify
