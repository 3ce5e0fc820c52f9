#pragma once

#include <memory>

#include "paper/engines.h"
#include "prohull/progressive_hull.h"
#include "query/engine.h"

namespace prohull {

/// Which vertices of the hull a query splits (engines.h).
enum class Refine {
  WhereFacesMeet,   ///< paper-refinement
  WhereBoundsMeet,  ///< refinement
};

/// P&T 3.2: a progressive hull refined where the query meets it. Options as index_called takes them.
std::unique_ptr<QueryEngine> make_refinement_engine(const ProgressiveHull& hull, Refine refine,
                                                    const RefinementOptions& options);

}  // namespace prohull
