#pragma once

#include "prohull/geometry.h"

namespace prohull {

/// Positively oriented: a, b, c counter-clockwise seen from outside, d inside of their plane.
struct Tetrahedron {
  Vec3 a, b, c, d;
};

/// Whether the closed triangle, which may have no area, has a point in the inside of the tetrahedron; touching its
/// surface does not count. Exact for all finite coordinates.
bool meets_interior(const Triangle& triangle, const Tetrahedron& tetrahedron);

/// Whether the closed triangle, which may have no area, may have a point in the tetrahedron or on its surface: false
/// only if a plane lies strictly between them. Exact where both have an inside, but for parallel edges.
bool may_touch(const Triangle& triangle, const Tetrahedron& tetrahedron);

}  // namespace prohull
