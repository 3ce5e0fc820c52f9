#pragma once

#include "prohull/triangle_mesh.h"

namespace prohull {

/// The mesh without the faces that have a corner which is not finite. All vertices stay.
TriangleMesh with_finite_faces(TriangleMesh mesh);

/// Both of the next: the faces whose corners are all finite, and the vertices that they use.
TriangleMesh finite_part(const TriangleMesh& mesh);

/// The mesh without the vertices that no face uses; the others stay in their order.
TriangleMesh without_unused_vertices(TriangleMesh mesh);

}  // namespace prohull
