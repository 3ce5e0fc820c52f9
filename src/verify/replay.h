#pragma once

#include "prohull/detail/replay.h"

namespace prohull::verify {

/// verify_replay of an original that turned_outwards leaves as it is.
ReplayReport replay(const ProgressiveHull& hull, const TriangleMesh& outwards, const Progress& progress);

}  // namespace prohull::verify
