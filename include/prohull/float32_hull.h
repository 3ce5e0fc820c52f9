#pragma once

#include <cstddef>

#include "prohull/progressive_hull.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

struct Float32Hull {
  TriangleMesh mesh;
  std::size_t rounded_vertices = 0;  ///< how many vertices have other coordinates than before
};

/// What becomes of a vertex that has no room outside of its faces.
enum class NoRoom {
  Refuse,  ///< with_float32_coordinates throws InputError(NoVolume)
  Round,   ///< the vertex is rounded to the nearest float32 coordinates: the caller has to verify the result
};

/// Moves the vertices of a hull to coordinates that a float32 file (STL, GLB) keeps. OBJ, OFF and PLY files keep
/// doubles and do not need this.
/// Guaranteed with NoRoom::Refuse: the result still encloses. Each vertex moves to a point that lies outside of, or on,
/// the planes of all its faces (HullSide::Inner: inside of or on them).
/// A vertex that already has float32 coordinates stays, unless a neighbour needs room. A vertex without room is removed
/// by an edge collapse, so the result may have a few faces less. If that is impossible too, `no_room` decides.
Float32Hull with_float32_coordinates(const TriangleMesh& level, HullSide side, NoRoom no_room = NoRoom::Refuse);

}  // namespace prohull
