#pragma once

#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// A closed line of edges that have one face: the rim of a hole, or of a mesh that is open by nature.
struct Opening {
  /// At least three vertices, none of them twice, in the order in which a cap has them that faces the same side as the
  /// faces beside it. (Where these disagree about the side, the order suits most of them.) Of vertices at equal
  /// positions, the first one stands for all.
  std::vector<VertexId> loop;
  /// The largest distance between two vertices of the loop, in the mesh's unit. Of loops with more than 1,000 vertices,
  /// only every second, third ... vertex is compared, so that it may be a little too small.
  double diameter = 0;
};

/// Finds the loops that edges with one face form, the largest diameter first. Vertices at equal positions count as one.
/// Left out are faces with a corner that is not finite, faces with the same vertex twice, and second copies of a face.
///
/// Guaranteed: every edge with one face is in exactly one loop. A loop follows one sheet of the surface: where two
/// sheets meet in a vertex, their loops stay apart. A line that comes back to one of its vertices is cut there, so that
/// every loop is simple. Where a sheet ends at edges of three faces or another odd number, its loop runs along these.
std::vector<Opening> find_openings(const TriangleMesh& mesh);

/// Closes openings, all or some of those that find_openings finds in this mesh, with new faces. No face and no vertex
/// of the mesh is changed; a mesh whose vertices are not welded has to be welded to be closed. The mesh may gain
/// vertices, see below.
///
/// Guaranteed: every edge of a loop gets one new face. Not guaranteed: that caps do not cross the mesh or each other.
/// A loop without area, such as a crack between faces, gets a cap without area.
///
///   const TriangleMesh closed = with_caps(mesh, find_openings(mesh));
///
/// How it works: loops of up to 100 vertices get the triangulation of least area (Barequet and Sharir 1995), one that
/// has no edge of the mesh as a diagonal, if there is one. Longer loops are triangulated in their plane; if they are
/// far from planar, they become a fan around a new vertex at their centre.
TriangleMesh with_caps(TriangleMesh mesh, const std::vector<Opening>& openings);

}  // namespace prohull
