#pragma once

#include <memory>

#include "prohull/progressive_hull.h"
#include "query/engine.h"

namespace prohull {

/// Which vertices of the hull a query splits; see Engine.
enum class Refine {
  WhereFacesMeet,   ///< Engine::PaperRefinement
  WhereBoundsMeet,  ///< Engine::Refinement
};

/// P&T 3.2: a progressive hull refined where the query meets it. Options as QueryIndex takes them.
std::unique_ptr<QueryEngine> make_refinement_engine(const ProgressiveHull& hull, Refine refine,
                                                    const RefinementOptions& options);

}  // namespace prohull
