#include "certificate/flat_triangles.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "geometry/bvh.h"
#include "geometry/triangle_predicates.h"
#include "mesh/closed.h"

namespace prohull::certificate {
namespace {

using Ends = std::pair<std::uint32_t, std::uint32_t>;  ///< numbers of positions, the lesser one first

/// The segment, or point, that a triangle without area is.
Ends ends_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& number, FaceId f) {
  const auto along = [&](VertexId v) {
    const Vec3& p = mesh.positions[v];
    return std::array{p.x, p.y, p.z};
  };
  const auto& corners = mesh.triangles[f];
  const VertexId first = *std::ranges::min_element(corners, {}, along);
  const VertexId last = *std::ranges::max_element(corners, {}, along);
  return std::minmax({number[index(first)], number[index(last)]});
}

/// Triangles without area, on no edge and at no corner of one that has an area.
std::vector<Triangle> loose_flat_triangles(const TriangleMesh& mesh) {
  std::vector<FaceId> flat;
  for (const FaceId f : mesh.triangles.ids())
    if (!projection_axis(mesh.triangle(f))) flat.push_back(f);
  if (flat.empty()) return {};
  const std::vector<std::uint32_t> number = numbered_by_position(mesh.positions);
  std::map<Ends, bool> on_edge;
  for (const FaceId f : flat) on_edge[ends_of(mesh, number, f)] = false;
  for (const FaceId f : mesh.triangles.ids())
    for (const VertexId v : mesh.triangles[f])
      for (const VertexId w : mesh.triangles[f]) {
        const auto at = on_edge.find({number[index(v)], number[index(w)]});
        if (at != on_edge.end() && !at->second) at->second = projection_axis(mesh.triangle(f)).has_value();
      }
  std::vector<Triangle> loose;
  for (const FaceId f : flat)
    if (!on_edge[ends_of(mesh, number, f)]) loose.push_back(mesh.triangle(f));
  return loose;
}

}  // namespace

std::size_t flat_triangles_in_doubt(const TriangleMesh& original, std::span<const TriangleMesh> hull) {
  const std::vector<Triangle> loose = loose_flat_triangles(original);
  if (loose.empty()) return 0;
  std::vector<Triangle> around;
  for (const TriangleMesh& part : hull)
    for (const FaceId f : part.triangles.ids())
      if (projection_axis(part.triangle(f))) around.push_back(part.triangle(f));
  const Bvh bvh(around);
  return static_cast<std::size_t>(std::ranges::count_if(loose, [&](const Triangle& t) {
    bool in_plane = false;
    bvh.visit([box = box_of(t)](const Box& other) { return other.overlaps(box); },
              [&](std::uint32_t i) { in_plane = in_plane || coplanar(around[i], t); });
    return in_plane;
  }));
}

}  // namespace prohull::certificate
