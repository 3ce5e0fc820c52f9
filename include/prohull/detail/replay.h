#pragma once

#include <cstddef>
#include <string>

#include "prohull/progress.h"
#include "prohull/progressive_hull.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

struct ReplayReport {
  bool holds = false;
  std::string why_not;     ///< the first step of the proof that fails; empty if the proof holds
  std::size_t splits = 0;  ///< how many vertex splits were replayed
  std::size_t signs = 0;   ///< how many signs of orient3d were decided, exactly
};

/// A progressive hull is a proof that its levels enclose each other. This function checks the proof: it replays every
/// vertex split, from the base mesh on. The vertex s that is split must lie outside of, or on, the supporting plane of
/// every face that replaces its star (HullSide::Inner: inside of it or on it). Then the winding number of every level
/// is at least that of the next finer level, everywhere (docs/theory.md). The finest level must have the triangles of
/// `original`, bit for bit, and be oriented outwards. Where `original` is inside out, as a whole or in a component, it
/// counts as turned. Guaranteed: the check is exact, and shares nothing with the construction of hulls but the exact
/// predicate. The stage of `progress` is "verify". Throws Cancelled.
ReplayReport verify_replay(const ProgressiveHull& hull, const TriangleMesh& original, const Progress& progress = {});

}  // namespace prohull
