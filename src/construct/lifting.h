#pragma once

#include <span>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// A point outside of a hull that should cover it, and its distance from the hull, in the input's unit.
struct Protrusion {
  Vec3 point;
  double distance;
};

struct LiftOptions {
  double least = 0;  ///< how far a vertex moves at least, in the input's unit
  int rings = 0;     ///< move the neighbours of the nearest faces as well, so many edges far: they may have more room
  bool float32_coordinates = false;
};

/// The hull with the faces nearest to the points moved outwards by these distances and a little more, as far as their
/// vertices have room. Guaranteed: it encloses the hull, as each vertex moves to a point outside of, or on, the planes
/// of all its faces. It may intersect itself.
TriangleMesh lifted_over(const TriangleMesh& hull, std::span<const Protrusion> protrusions, const LiftOptions& options);

}  // namespace prohull
