#pragma once

#include <cstddef>
#include <functional>

#include "prohull/progressive_hull.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// The farthest that a point of one mesh is from another: the one-sided Hausdorff distance, between two bounds, in the
/// input's unit.
struct DistanceBounds {
  double lower = 0;  ///< the distance of `farthest`, rounded
  double upper = 0;  ///< proven: no point is farther
  Vec3 farthest;
};

struct DistanceOptions {
  double relative_gap = 0.01;         ///< stops when upper <= (1 + relative_gap) lower; at least 0
  std::size_t max_cells = 1'000'000;  ///< or after looking at so many parts of faces: upper then is looser, and holds
  std::function<bool(double fraction)> progress = {};  ///< called now and then with [0, 1]; false cancels
};

/// From the surface of `from` to that of `to`, both surfaces with the insides of their faces. Faces are cut where the
/// bound is greatest. A part of a face is no farther from a triangle than the farthest of its corners, for the distance
/// to a convex set is convex.
/// Throws InputError if a mesh is empty or not finite; Cancelled if `progress` says so.
///
///     const double reach = distance_bounds(hull, original).upper;
DistanceBounds distance_bounds(const TriangleMesh& from, const TriangleMesh& to, const DistanceOptions& options = {});

/// The faces of the coarsest level of a hull that is within `distance` of the original mesh, provenly: found by
/// bisection, as if finer levels were never farther. The original itself if no other is. Throws as distance_bounds
/// does.
std::size_t faces_within(const ProgressiveHull& hull, double distance, const DistanceOptions& options = {});

}  // namespace prohull
