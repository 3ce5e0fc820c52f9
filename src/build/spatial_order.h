#pragma once

#include "prohull/triangle_mesh.h"

namespace prohull {

/// New numbers for the vertices and faces of a mesh, along a curve through space: collapses near each other then find
/// what they need near each other in memory. Corners keep their places in their faces.
class SpatialOrder {
 public:
  explicit SpatialOrder(const TriangleMesh& mesh);

  TriangleMesh reordered(const TriangleMesh& mesh) const;

  /// The number in the given mesh; vertices made later keep theirs.
  VertexId given(VertexId v) const { return index(v) < vertex_.size() ? vertex_[v] : v; }
  FaceId given(FaceId f) const { return face_[f]; }
  std::uint32_t given_corner(std::uint32_t corner) const { return 3 * index(given(FaceId{corner / 3})) + corner % 3; }

 private:
  PerVertex<VertexId> vertex_;
  PerFace<FaceId> face_;
};

}  // namespace prohull
