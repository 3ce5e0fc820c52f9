#pragma once

#include <vector>

#include "mesh/half_edge_mesh.h"

namespace prohull {

/// For each vertex of a hull, points of the original that kept it from moving farther: the latest of them.
class Contacts {
 public:
  explicit Contacts(std::size_t vertices) : points_(vertices) {}

  /// Those of the vertex and of its neighbours.
  void gather(VertexId v, const std::vector<VertexId>& link, std::vector<Vec3>& points) const {
    points = points_[v];
    for (const VertexId u : link) points.insert(points.end(), points_[u].begin(), points_[u].end());
  }
  void keep(VertexId v, const std::vector<Vec3>& found) {
    constexpr std::size_t kMost = 24;  // with 12, a fifth more searches of the original; with 48, hardly fewer
    std::vector<Vec3>& kept = points_[v];
    kept.insert(kept.end(), found.begin(), found.end());
    if (kept.size() > kMost) kept.erase(kept.begin(), kept.end() - kMost);
  }
  /// For a new vertex, that takes the place of o and d.
  void join(VertexId o, VertexId d) {
    const std::vector<Vec3> of_o = points_[o];
    const VertexId s = points_.push_back(of_o);
    keep(s, points_[d]);
  }
  /// For the vertices that HalfEdgeMesh::triangle_mesh leaves.
  Contacts renumbered(const HalfEdgeMesh& mesh) const {
    Contacts left(0);
    for (const VertexId v : points_.ids())
      if (mesh.has(v)) left.points_.push_back(points_[v]);
    return left;
  }

 private:
  PerVertex<std::vector<Vec3>> points_;
};

}  // namespace prohull
