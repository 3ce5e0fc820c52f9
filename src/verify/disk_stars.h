#pragma once

#include <algorithm>
#include <cstdint>

#include "prohull/triangle_mesh.h"

namespace prohull::verify {

/// The vertices whose star, seen along an axis, is a disk: its faces lie around the vertex side by side, once around.
/// Two faces of such a star have nothing in common but the corner or the edge that they share. Of closed meshes that
/// are fine enough these are most vertices, and most pairs of faces with overlapping boxes share one.
class DiskStars {
 public:
  /// Of vertices by their numbers: equal positions count as different ones.
  explicit DiskStars(const TriangleMesh& mesh);

  bool have_both(FaceId f, FaceId g) const {
    return std::ranges::any_of(mesh_.triangles[f], [&](VertexId v) {
      return is_disk_[v] && std::ranges::find(mesh_.triangles[g], v) != mesh_.triangles[g].end();
    });
  }

 private:
  const TriangleMesh& mesh_;
  PerVertex<char> is_disk_;
};

}  // namespace prohull::verify
