#pragma once

#include <cstddef>
#include <string>

#include "prohull/progress.h"
#include "prohull/progressive_hull.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

struct ReplayReport {
  bool holds = false;
  std::string why_not;     ///< the first step of the proof that fails; empty if it holds
  std::size_t splits = 0;  ///< replayed
  std::size_t signs = 0;   ///< of orient3d, decided exactly
};

/// A progressive hull is a proof of its own enclosure; this checks it. Every vertex split is replayed from the base
/// mesh: the vertex s must lie on the outside of or on the supporting plane of every face that replaces its star
/// (HullSide:: Inner: on the inside). Then the winding number of every level is at least that of the next finer one,
/// everywhere (docs/theory.md). The finest level must have the triangles of `original`, bit for bit, and be oriented
/// outwards; where the original is inside out, or has components that are, they are turned. Shares nothing with the
/// construction of hulls but the exact predicate: it keeps its own record of the faces. `progress`: stage
/// "verify". Throws Cancelled.
ReplayReport verify_replay(const ProgressiveHull& hull, const TriangleMesh& original, const Progress& progress = {});

}  // namespace prohull
