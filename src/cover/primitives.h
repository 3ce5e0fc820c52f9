#pragma once

#include "prohull/detail/shapes.h"
#include "prohull/triangle_mesh.h"

namespace prohull::cover {

// Primitives of small volume around the vertices that triangles of a mesh use. Guaranteed: all of them are inside, with
// 1e-9 of the diagonal of their bounding box to spare, so that they stay inside where a format rounds in its own way
// (angles of a rotation, decimals). Required: at least one triangle, and finite coordinates. Deterministic. Takes some
// milliseconds for a convex hull of 500 vertices.

/// The least box that a search finds among those flush with a large face of the convex hull, and near to these.
OrientedBox box_around(const TriangleMesh& mesh);

/// The least capsule that a search finds around the axes of the box.
Capsule capsule_around(const TriangleMesh& mesh);

/// The least ball, but for rounding.
Ball ball_around(const TriangleMesh& mesh);

double volume(const OrientedBox& box);
double volume(const Capsule& capsule);
double volume(const Ball& ball);

/// A convex polytope of 8 vertices (fewer if rounding joins some) around the box, as near to it as rounding allows: to
/// float32 if asked, else to double. Guaranteed: it encloses the box.
TriangleMesh mesh_of(const OrientedBox& box, bool float32_coordinates = false);

}  // namespace prohull::cover
