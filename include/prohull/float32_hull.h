#pragma once

#include <cstddef>

#include "prohull/progressive_hull.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

struct Float32Hull {
  TriangleMesh mesh;
  std::size_t rounded_vertices = 0;
};

/// The level of a hull, its vertices moved to coordinates that a float32 file (STL, GLB) keeps, each to the outside of
/// or onto the planes of all its faces (HullSide::Inner: to the inside), so that the result still encloses. Vertices
/// that already are such coordinates stay, unless a neighbour needs room. A vertex that has no room even so goes by an
/// edge collapse, so that the result may have a few faces less. Throws InputError(NoVolume) if that is impossible too;
/// OBJ, OFF and PLY files keep doubles.
Float32Hull with_float32_coordinates(const TriangleMesh& level, HullSide side);

}  // namespace prohull
