#pragma once

#include <vector>

#include "wrap/grid.h"

namespace prohull {

/// What lies outside of triangles: all that can be reached from far away without passing through them.
struct Inside {
  /// For each node its distance from the triangles, in spacings, negative inside; exact, but for rounding, up to 1.
  std::vector<float> signed_distances;
  TriangleMesh doors;       ///< what was closed: faces between nodes inside and outside that no triangle parts
  double volume = 0;        ///< as Wrap::inside_volume, in cubic spacings
  double largest_door = 0;  ///< the greatest width of the door of a room that was sealed, in spacings
};

/// How far the grid reaches beyond the triangles, in spacings, at least. Where balls larger than
/// `kLeastSeal` go around them, it reaches so much farther.
constexpr float kInsideMargin = 3.75F;

/// Openings narrower than 2 `seal` (in spacings, at least kLeastSeal) are closed. With `seal_rooms`, so is the door of
/// each room: of each hollow in which a ball fits that is half as large again as the largest one that passes its door.
/// With `closing` greater than 0, hollows and gaps that a ball of this radius, in spacings, cannot enter are filled.
struct InsideOptions {
  double seal = 0;
  bool seal_rooms = false;
  double closing = 0;
};
Inside find_inside(const Grid& grid, const TriangleMesh& triangles, const InsideOptions& options, ProgressMeter& meter);

/// The nodes inside of a closed mesh around which it does not wind, as in cavities and between its parts; 1 for each.
std::vector<char> find_cavities(const Grid& grid, const TriangleMesh& closed, const Inside& inside);

/// No two nodes of a tetrahedron that are farther from a face than this can have it between them.
constexpr float kLeastSeal = 0.9F;

}  // namespace prohull
