#pragma once

#include <cstddef>

#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// What verify_tolerances has found.
struct ToleranceReport {
  bool holds = false;             ///< neither of the following is the case
  std::size_t missing_faces = 0;  ///< faces of tolerance 0 that the hull does not have, bit for bit
  std::size_t far_faces = 0;      ///< faces of which no proof was found that they are as near as they have to be
};

/// Whether a hull keeps HullOptions::tolerances, which are given for the faces of `mesh`. No point of a face may be
/// farther from the hull than the tolerance of the face; a face of tolerance 0 must be a face of the hull with the same
/// coordinates, in the same orientation. Guaranteed: if `holds`, that is proven. Shares nothing with the construction.
///
/// Throws InputError if a mesh has no faces or is not finite, or if there is not one tolerance for each face of `mesh`,
/// of at least 0; Cancelled. The stage of progress is "verify".
ToleranceReport verify_tolerances(const TriangleMesh& hull, const TriangleMesh& mesh, const PerFace<double>& tolerances,
                                  const Progress& progress = {});

}  // namespace prohull
