#pragma once

#include "prohull/hull_builder.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// A *body of the gap*: a fine closed mesh around all that is nearer to triangles than a padding, hardly larger than
/// that. A hull of it keeps the padding. The body of an inner hull lies inside, and hulls of it too.
/// Not guaranteed: that it keeps the padding everywhere, and has no self-intersections. So hulls have to be verified.

/// Of a mesh and the padding of its faces. Where the mesh is nearer to itself than twice the padding, the body has
/// self-intersections.
TriangleMesh gap_body(const TriangleMesh& mesh, const TriangleMesh& triangles, double padding,
                      const HullOptions& options);
/// Of a wrap of triangles that keeps the padding (wrap.h): its vertices move to where the padding ends.
TriangleMesh gap_body_of_wrap(const TriangleMesh& wrap, const TriangleMesh& triangles, double padding,
                              const HullOptions& options);

}  // namespace prohull
