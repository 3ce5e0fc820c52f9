#pragma once

#include <vector>

#include "prohull/progressive_hull.h"

namespace prohull::render {

/// A hull refined where a segment meets it, as queries do it (P&T 3.2.1, Figure 4).
struct RefinedAlong {
  TriangleMesh hull;
  /// Where the segment crosses the original mesh, as fractions of its way: what the refinement finds, and what it does
  /// not, for the segment passes below the hull there (P&T Figure 5).
  std::vector<double> found, missed;
};

RefinedAlong refine_along(const ProgressiveHull& hull, const Segment& segment);

}  // namespace prohull::render
