#pragma once

#include <array>

#include "prohull/geometry.h"
#include "prohull/ids.h"

namespace prohull {

/// Positions and triangles, a plain value without any promise: it may be a soup, open, or worse (see mesh_report.h).
/// Triangles are counter-clockwise seen from outside.
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

/// Of the positions that triangles use.
Box bounding_box(const TriangleMesh& mesh);

/// The sum of the signed tetrahedra under all triangles: positive if a closed mesh is oriented outwards. Evaluated
/// about the centre of the bounding box in double precision; may overflow to infinity, never to NaN, for huge
/// coordinates.
double signed_volume(const TriangleMesh& mesh);

}  // namespace prohull
