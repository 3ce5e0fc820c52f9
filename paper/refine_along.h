#pragma once

#include <vector>

#include "prohull/geometry.h"
#include "prohull/progressive_hull.h"

namespace prohull {

/// A hull that is fine where a segment meets it, and coarse elsewhere (P&T 3.2.1, Figure 4).
struct RefinedAlong {
  TriangleMesh hull;          ///< encloses the original mesh, as the levels of the hull do
  std::vector<double> found;  ///< where the segment crosses faces of `hull` that are faces of the original mesh too
  /// Where the segment crosses the original mesh below a face of `hull`: such crossings the paper's refinement does not
  /// find (P&T Figure 5). Both are fractions of the way from a to b, in the order in which the segment passes them.
  std::vector<double> missed;
};

/// Refines the base mesh of a hull along a segment, as published: while the segment meets a face with a corner that an
/// edge collapse made, that corner is split. For pictures and for study: MeshQuery is made for asking many segments.
///
///     const RefinedAlong refined = refine_along(hull, {{0, 0, -2}, {0, 0, 2}});
///     write_mesh("refined.ply", refined.hull);
RefinedAlong refine_along(const ProgressiveHull& hull, const Segment& segment);

}  // namespace prohull
