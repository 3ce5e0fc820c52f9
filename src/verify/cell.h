#pragma once

#include <array>
#include <vector>

#include "geometry/lazy_number.h"
#include "prohull/geometry.h"

namespace prohull::verify {

using Number = LazyNumber;

inline Vec3 rounded(const std::array<Number, 3>& p) { return {p[0].rounded(), p[1].rounded(), p[2].rounded()}; }

/// In the projection along an axis: the coordinates (axis + 1) % 3 and (axis + 2) % 3.
struct PlanePoint {
  Number u, v;
};

PlanePoint projected(int axis, const Vec3& p);

/// A convex piece of a triangle, its corners in the projection along the triangle's axis, in order.
using Cell = std::vector<PlanePoint>;

/// The corners of t alone.
Cell whole_cell(const Triangle& t, int axis);

/// The point of the plane of t that projects to p.
std::array<Number, 3> lifted(const Triangle& t, int axis, const PlanePoint& p);

}  // namespace prohull::verify
