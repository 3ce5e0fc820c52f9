#pragma once

#include <memory>

#include "prohull/progressive_hull.h"
#include "query/engine.h"

namespace prohull {

/// Follows lines through the tetrahedra of void; see engines.h. `mesh` is the original mesh of `outer`, and of
/// `inner` if that is not null. Throws as VoidComplex does.
std::unique_ptr<QueryEngine> make_walk_engine(const TriangleMesh& mesh, const ProgressiveHull& outer,
                                              const ProgressiveHull* inner);

}  // namespace prohull
