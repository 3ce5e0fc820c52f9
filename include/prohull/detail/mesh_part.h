#pragma once

#include <cstddef>
#include <vector>

#include "prohull/hull_builder.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// A part of a closed mesh that is to be simplified by itself, as on another machine: the faces that reach into a box.
struct MeshPart {
  TriangleMesh mesh;          ///< all faces of the closed mesh of which the bounding boxes meet `box`
  std::size_t own_faces = 0;  ///< the first faces of `mesh`, up to here, belong to the part; the others to other parts
  Box box;                    ///< its sides may be infinitely far away
};

/// What has become of the own faces of a part.
struct SimplifiedPart {
  TriangleMesh mesh;
  std::vector<VertexId> kept;  ///< vertex v of `mesh` is vertex kept[v] of the part; the vertices after these are new
};

/// Collapses edges as build_hull does, but only those whose stars lie strictly inside of the box, before and after. All
/// other faces stay as they are, with their vertices.
///
/// Guaranteed: parts may be simplified independently of each other. If boxes share no point of their insides, and each
/// face of a closed mesh belongs to one part, the simplified parts make up a closed 2-manifold that is a hull of that
/// mesh: one that build_hull could have reached by the same collapses. It does not intersect itself if the mesh does
/// not, unless options.self_intersections allows that.
///
/// options.target_faces counts the own faces that lie strictly inside of the box; the others stay in any case.
/// Strategy::Lazy only, without tolerances.
///
/// Throws InputError if faces around a vertex strictly inside of the box are missing, or are not one disk; for a face
/// number or options outside of their range; Cancelled. That faces are missing that only cross the box is not noticed.
///
///   const Box left{{-infinity, -infinity, -infinity}, {0, infinity, infinity}};
///   const SimplifiedPart made = simplify_part({faces_that_meet_left, own_faces, left}, {.target_faces = 10000});
SimplifiedPart simplify_part(const MeshPart& part, const HullOptions& options = {});

}  // namespace prohull
