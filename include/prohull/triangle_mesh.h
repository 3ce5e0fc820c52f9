#pragma once

#include <array>
#include <vector>

#include "prohull/detail/ids.h"
#include "prohull/geometry.h"

namespace prohull {

/// Positions and triangles: a plain value that promises nothing. It may be open, a soup, or worse; mesh_report.h tells.
/// The corners of a triangle are in counter-clockwise order, seen from outside.
struct TriangleMesh {
  PerVertex<Vec3> positions;
  PerFace<std::array<VertexId, 3>> triangles;

  std::size_t vertex_count() const { return positions.size(); }
  std::size_t face_count() const { return triangles.size(); }
  Triangle triangle(FaceId f) const {
    const auto& t = triangles[f];
    return {positions[t[0]], positions[t[1]], positions[t[2]]};
  }

  bool operator==(const TriangleMesh&) const = default;
};

/// Adds the vertices and triangles of `part` after those of `mesh`.
void append(TriangleMesh& mesh, const TriangleMesh& part);

/// All parts, one after the other, as one mesh.
TriangleMesh together(const std::vector<TriangleMesh>& parts);

/// The bounding box of the vertices that triangles use.
Box bounding_box(const TriangleMesh& mesh);

/// The same of the triangles whose corners are all finite; empty if there is none.
Box finite_bounding_box(const TriangleMesh& mesh);

/// Whether a mesh is closed: along every edge, as many faces run one way as the other way. Edges are matched by
/// position, so that it may be a soup. Throws InputError if the mesh is empty or not finite.
bool is_closed(const TriangleMesh& mesh);

/// The sum of the signed volumes of the tetrahedra between each triangle and a common point: for a closed mesh its
/// volume, which is positive if the mesh is oriented outwards. Computed in double precision about the centre of the
/// bounding box. For huge coordinates it may overflow to infinity, but never to NaN.
double signed_volume(const TriangleMesh& mesh);

/// Whether both have the very same triangles in the same order: a file that was read again, or a repaired mesh, may
/// have its vertices numbered anew.
bool has_triangles_of(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace prohull
