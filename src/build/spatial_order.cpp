#include "build/spatial_order.h"

#include <algorithm>
#include <limits>

#include "geometry/morton_code.h"

namespace prohull {
namespace {

PerVertex<VertexId> vertices_along_the_curve(const PerVertex<Vec3>& positions) {
  Box box;
  for (const Vec3& p : positions) box.extend(p);
  const Vec3 center = box.center(), half = box.max * 0.5 - box.min * 0.5;
  const double inverse_unit = 1 / std::max({half.x, half.y, half.z, std::numeric_limits<double>::min()});
  std::vector<std::uint64_t> by_code;
  by_code.reserve(positions.size());
  for (const VertexId v : positions.ids()) {
    const auto at = [&](int i) { return static_cast<float>((positions[v][i] - center[i]) * inverse_unit); };
    by_code.push_back(std::uint64_t{morton_code(at(0), at(1), at(2))} << 32 | index(v));
  }
  std::sort(by_code.begin(), by_code.end());
  PerVertex<VertexId> order;
  order.reserve(by_code.size());
  for (const std::uint64_t code : by_code) order.push_back(VertexId{static_cast<std::uint32_t>(code)});
  return order;
}

template <class Id>
IndexedBy<Id, Id> inverse(const IndexedBy<Id, Id>& order) {
  IndexedBy<Id, Id> place(order.size());
  for (const Id i : order.ids()) place[order[i]] = i;
  return place;
}

VertexId first_corner(const PerVertex<VertexId>& place, const std::array<VertexId, 3>& corners) {
  return std::min({place[corners[0]], place[corners[1]], place[corners[2]]});
}

}  // namespace

// Faces follow their first vertex: sorted by counting.
SpatialOrder::SpatialOrder(const TriangleMesh& mesh)
    : vertex_(vertices_along_the_curve(mesh.positions)), face_(mesh.face_count()) {
  const PerVertex<VertexId> place = inverse(vertex_);
  std::vector<std::uint32_t> next(mesh.vertex_count() + 1, 0);
  for (const auto& corners : mesh.triangles) ++next[index(first_corner(place, corners)) + 1];
  for (std::size_t v = 1; v < next.size(); ++v) next[v] += next[v - 1];
  for (const FaceId f : mesh.triangles.ids()) face_[FaceId{next[index(first_corner(place, mesh.triangles[f]))]++}] = f;
}

TriangleMesh SpatialOrder::reordered(const TriangleMesh& mesh) const {
  TriangleMesh result;
  result.positions.reserve(mesh.vertex_count());
  for (const VertexId v : vertex_) result.positions.push_back(mesh.positions[v]);
  const PerVertex<VertexId> place = inverse(vertex_);
  result.triangles.reserve(mesh.face_count());
  for (const FaceId f : face_) {
    const auto& [a, b, c] = mesh.triangles[f];
    result.triangles.push_back({place[a], place[b], place[c]});
  }
  return result;
}

}  // namespace prohull
