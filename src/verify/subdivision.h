#pragma once

#include <span>
#include <vector>

#include "parallel/progress_meter.h"
#include "prohull/geometry.h"
#include "verify/exact.h"

namespace prohull::verify {

/// In the projection along an axis: the coordinates (axis + 1) % 3 and (axis + 2) % 3.
struct PlanePoint {
  Number u, v;
};

/// A convex piece of a triangle, its corners in the projection along the triangle's axis, in order.
using Cell = std::vector<PlanePoint>;

/// The corners of t alone.
Cell whole_cell(const Triangle& t, int axis);

/// The point of the plane of t that projects to p.
std::array<Number, 3> lifted(const Triangle& t, int axis, const PlanePoint& p);

/// Cuts t, which has an area along `axis`, into convex cells of which no interior meets any of the `cutters` in a
/// segment, or the edge of a coplanar one. Cutters must meet the interior of t (see interior_contact).
/// A binary space partition by the cutters' own segments: only cells that a segment passes are cut by its line. Exact;
/// every corner is the meeting point of two lines of the input, so that numbers do not grow with the depth. Asks
/// `meter` whether to go on after each cut.
std::vector<Cell> subdivide(const Triangle& t, int axis, std::span<const Triangle> cutters, ProgressMeter& meter);

}  // namespace prohull::verify
