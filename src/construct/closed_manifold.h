#pragma once

#include "prohull/error.h"
#include "prohull/mesh_report.h"

namespace prohull {

/// Throws InputError, with the first offending edge or vertex, unless the mesh is a closed 2-manifold.
inline void require_closed_manifold(const TriangleMesh& mesh) {
  const MeshReport report = inspect(mesh);
  if (!report.is_closed_manifold()) throw InputError(report.worst_defect, report.first_defect);
}

}  // namespace prohull
