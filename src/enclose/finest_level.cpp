#include "prohull/enclosing_hull.h"

namespace prohull {

FinestLevel finest_level(const EnclosingHulls& made, const EnclosingHull& hull) {
  switch (hull.source) {
    case Source::ConvexHull:
      return FinestLevel::ConvexHull;
    case Source::Wrap:
      return FinestLevel::Wrap;
    default:
      return made.input.repairs.any() || made.solids[hull.solid].folds.faces > 0 ? FinestLevel::Repaired
                                                                                 : FinestLevel::Input;
  }
}

}  // namespace prohull
