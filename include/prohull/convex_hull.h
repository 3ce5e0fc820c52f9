#pragma once

#include "prohull/triangle_mesh.h"

namespace prohull {

/// The convex hull of the vertices that triangles use, exactly: a closed 2-manifold of which no vertex is outside of a
/// face's plane. Vertices within its faces and edges are left out. No faces if all lie in a plane.
///
/// How it works: Quickhull (Barber, Dobkin, Huhdanpaa 1996) with exact predicates.
TriangleMesh convex_hull(const TriangleMesh& mesh);

/// The convex hull of cubes around the vertices that triangles use, which reach out by `distance`, greater than 0,
/// along each axis: a slab around what is flat. All of the mesh is inside, unless its coordinates round the distance
/// away.
TriangleMesh slab_around(const TriangleMesh& mesh, double distance);

/// The convex hull of all points within `distance` of the mesh, which is greater than 0, and of a few more: its faces
/// are up to 6 % farther from the mesh. All of these points are inside, but for rounding. Never without faces, unless
/// the mesh has none.
TriangleMesh padded_convex_hull(const TriangleMesh& mesh, double distance);

}  // namespace prohull
