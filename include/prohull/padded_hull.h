#pragma once

#include <cstddef>

#include "prohull/triangle_mesh.h"

namespace prohull {

struct PaddedHull {
  TriangleMesh mesh;
  /// Vertices that do not lie beyond all planes of their faces: too many planes meet there, and no collapse helped.
  std::size_t cramped_vertices = 0;
};

/// Moves the faces of a hull outwards by `distance`, in the input's unit. Each vertex moves to the nearest point beyond
/// the planes of all its faces, moved outwards by `distance`, if it is within 16 distances.
/// Guaranteed: without cramped vertices, each face lies beyond the plane of its old face moved by `distance`, but for
/// rounding; a hair is added for that. Connectivity is kept, except that a vertex without such a point is removed by
/// an edge collapse where one can be made outside of its faces.
/// Not guaranteed: that the surface is so far from the old one everywhere. Across a gap narrower than twice the
/// distance, faces pass through each other. CollisionIndex and separation() (collide.h) measure what came out.
///
/// Required: a closed 2-manifold, oriented outwards; throws InputError otherwise, and if `distance` is not finite and
/// greater than 0. With `float32_coordinates` all coordinates are numbers that a float32 keeps.
///
///     const PaddedHull padded = padded_hull(hull, 0.005);  // 5 mm, if the unit is a metre
PaddedHull padded_hull(const TriangleMesh& hull, double distance, bool float32_coordinates = false);

}  // namespace prohull
