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

  /// Whether such a star has both faces.
  bool operator()(std::uint32_t f, std::uint32_t g) const {
    const auto& others = mesh_.triangles[FaceId{g}];
    return std::ranges::any_of(mesh_.triangles[FaceId{f}],
                               [&](VertexId v) { return is_disk_[v] && std::ranges::find(others, v) != others.end(); });
  }

 private:
  const TriangleMesh& mesh_;
  PerVertex<char> is_disk_;
};

}  // namespace prohull::verify
