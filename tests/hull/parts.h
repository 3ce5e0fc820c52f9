#pragma once

#include <vector>

#include "prohull/progressive_hull.h"

namespace prohull {

/// A progressive hull taken apart, to be changed.
struct HullParts {
  HullSide side;
  std::size_t original_vertices;
  PerVertex<Vec3> positions;
  std::vector<VertexId> corners;
  std::vector<VertexSplit> splits;

  ProgressiveHull joined() const { return {side, original_vertices, positions, corners, splits}; }
};

inline HullParts parts_of(const ProgressiveHull& hull) {
  return {hull.side(), hull.original_vertex_count(), hull.positions(), hull.base_corners(), hull.splits()};
}

/// Of a mesh that is not simplified.
inline HullParts parts_of(const TriangleMesh& mesh) {
  HullParts parts{HullSide::Outer, mesh.vertex_count(), mesh.positions, {}, {}};
  for (const auto& t : mesh.triangles) parts.corners.insert(parts.corners.end(), t.begin(), t.end());
  return parts;
}

}  // namespace prohull
