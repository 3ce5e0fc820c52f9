#include "prohull/progressive_hull.h"

#include <fmt/format.h>

#include "mesh/half_edge_mesh.h"
#include "prohull/error.h"
#include "prohull/mesh_report.h"

namespace prohull {

ProgressiveHull::ProgressiveHull(HullSide side, std::size_t original_vertices, PerVertex<Vec3> positions,
                                 std::vector<VertexId> base_corners, std::vector<VertexSplit> splits)
    : side_(side),
      original_vertices_(original_vertices),
      positions_(std::move(positions)),
      base_corners_(std::move(base_corners)),
      splits_(std::move(splits)) {
}

TriangleMesh ProgressiveHull::level(std::size_t faces) const {
  HalfEdgeMesh mesh(positions_, base_corners_);
  for (std::size_t i = splits_.size(); i-- > 0 && mesh.face_count() + 2 <= faces;) mesh.split(made_vertex(i), splits_[i]);
  return mesh.triangle_mesh();
}

}  // namespace prohull
