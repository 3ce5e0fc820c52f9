#pragma once

#include <cstddef>

#include "prohull/progressive_hull.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

struct Float32Hull {
  TriangleMesh mesh;
  std::size_t rounded_vertices = 0;  ///< how many vertices have other coordinates than before
};

/// The spacing of float32 coordinates may be at most this share of a mesh's diagonal: see check_float32_spacing. Here
/// hulls of 200 faces have up to a fifth more volume than hulls in doubles; at twice the share, some are not certified.
constexpr double kMaxFloat32Spacing = 1.0 / 4000;

/// Throws InputError(NonFiniteCoordinate) if hulls of `mesh` cannot have float32 coordinates, or only loose ones: if
/// coordinates are beyond the range of a float32, or if the mesh is so far from the origin that the spacing of float32
/// numbers there is greater than kMaxFloat32Spacing times the diagonal of its bounding box. Triangles that are not
/// finite do not count.
///
///     check_float32_spacing(read_mesh("city.ply"));  // before a hull of it is built for an STL file
void check_float32_spacing(const TriangleMesh& mesh);

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
/// Throws InputError as check_float32_spacing does, unless the coordinates are float32 numbers already.
Float32Hull with_float32_coordinates(const TriangleMesh& level, HullSide side, NoRoom no_room = NoRoom::Refuse);

/// A level of a hull, moved to such coordinates. Where a vertex has no room, it is rounded to the nearest ones, if the
/// result is proven to enclose the finest level even so. Throws InputError as NoRoom::Refuse does otherwise.
TriangleMesh float32_level(const ProgressiveHull& hull, const TriangleMesh& level);

}  // namespace prohull
