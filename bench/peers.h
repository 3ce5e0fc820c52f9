#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "prohull/triangle_mesh.h"

namespace prohull::bench {

struct PeerRun {
  double seconds;     ///< of the simplification alone
  std::size_t faces;  ///< that are left
};

/// CGAL's edge collapse with Garland and Heckbert's plane quadrics, to that many faces of a closed mesh; encloses
/// nothing. Nothing if it was not built.
std::optional<PeerRun> run_garland_heckbert(const TriangleMesh& mesh, std::size_t faces);

}  // namespace prohull::bench
