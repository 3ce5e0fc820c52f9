#pragma once

#include <cstddef>
#include <limits>

#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// Two proven bounds of the one-sided Hausdorff distance: of the distance from the point of one mesh that is farthest
/// from the other mesh. In the input's unit.
struct DistanceBounds {
  double lower = 0;    ///< some point is at least so far away
  double upper = 0;    ///< no point is farther away than this
  Vec3 farthest = {};  ///< the farthest point that was found, rounded; the origin if `lower` is 0
};

struct DistanceOptions {
  double relative_gap = 0.01;  ///< the search ends when upper <= (1 + relative_gap) lower, but for rounding; at least 0
  std::size_t max_cells = 1'000'000;  ///< the search also ends after this many parts of faces; `upper` still holds then
  /// The search goes on until it is known whether `upper` is at most this, if it can be; below, `upper` may then be
  /// farther off.
  double decides = 0;
  Progress progress = {};  ///< stage "measure"
};

/// Bounds how far the surface of `from` reaches from the surface of `to`. All points of the faces count, not only the
/// vertices. Throws InputError if a mesh is empty or not finite; Cancelled.
///
///     const double reach = distance_bounds(hull, original).upper;
///
/// How it works: the face whose bound is greatest is cut in two, again and again. A part of a face is no farther from a
/// triangle than the farthest of its corners, because the distance to a convex set is a convex function.
DistanceBounds distance_bounds(const TriangleMesh& from, const TriangleMesh& to, const DistanceOptions& options = {});

/// How far a hull may be from the mesh that it encloses, or that encloses it.
struct HullBounds {
  double max_distance = std::numeric_limits<double>::infinity();      ///< of any point of the hull; in the input's unit
  double max_void_ratio = std::numeric_limits<double>::infinity();    ///< of |volume(hull) / volume - 1|; 0.05 is 5 %
  double max_added_volume = std::numeric_limits<double>::infinity();  ///< of |volume(hull) - volume|; cubic units

  bool any() const { return *this != HullBounds{}; }
  bool any_of_volume() const { return HullBounds{.max_distance = max_distance} != *this; }
  bool operator==(const HullBounds&) const = default;

  /// Throws InputError if a bound is no number of at least 0.
  void require_usable() const;

  /// The greatest of the three quotients of what a hull of `hull_volume` has and its bound: at most 1 if it keeps all
  /// bounds. The distance from `original` is proven (distance_bounds). Throws as distance_bounds and require_usable do.
  double excess(const TriangleMesh& hull, double hull_volume, const TriangleMesh& original, double volume,
                const Progress& progress = {}) const;
  /// Of the solid_volume of the hull (enclosure.h); of its signed volume where that would take too long.
  bool hold(const TriangleMesh& hull, const TriangleMesh& original, double volume, const Progress& progress = {}) const;
};

}  // namespace prohull
