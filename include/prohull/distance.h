#pragma once

#include <cstddef>
#include <limits>

#include "prohull/progress.h"
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
  Progress progress = {};             ///< stage "measure"
};

/// From the surface of `from` to that of `to`, both surfaces with the insides of their faces. Faces are cut where the
/// bound is greatest. A part of a face is no farther from a triangle than the farthest of its corners, for the distance
/// to a convex set is convex.
/// Throws InputError if a mesh is empty or not finite; Cancelled.
///
///     const double reach = distance_bounds(hull, original).upper;
DistanceBounds distance_bounds(const TriangleMesh& from, const TriangleMesh& to, const DistanceOptions& options = {});

/// How far a hull may be from what it encloses, or is enclosed by.
struct HullBounds {
  double max_distance = std::numeric_limits<double>::infinity();      ///< of any point of the hull; in the input's unit
  double max_void_ratio = std::numeric_limits<double>::infinity();    ///< of |volume(hull) / volume - 1|; 0.05 is 5 %
  double max_added_volume = std::numeric_limits<double>::infinity();  ///< of |volume(hull) - volume|; cubic units

  bool any() const { return *this != HullBounds{}; }
  bool operator==(const HullBounds&) const = default;

  /// Whether they hold: the distance provenly (distance_bounds, to `original`), volumes in double precision, against
  /// `volume`. Throws as distance_bounds does.
  bool hold(const TriangleMesh& hull, const TriangleMesh& original, double volume, const Progress& progress = {}) const;
};

}  // namespace prohull
