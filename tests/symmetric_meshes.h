#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "mesh/half_edge_mesh.h"
#include "meshes.h"

namespace prohull::meshes {

/// 8 * 4^levels faces, symmetric along all axes, with bumps of a pitch of about 1 / frequency. The planes hold edges.
inline TriangleMesh bumpy_sphere(int levels, double frequency = 5) {
  TriangleMesh mesh = sphere(levels);
  for (Vec3& p : mesh.positions)
    p = p * (1 + 0.15 * std::cos(frequency * std::abs(p.x)) + 0.1 * std::cos(1.7 * frequency * p.y * p.y) +
             0.05 * std::sin(frequency * p.z * p.z));
  return mesh;
}

/// The same surface, but for some edges in the plane of coordinate 0, in whose place an edge crosses the plane.
inline TriangleMesh with_edges_across(const TriangleMesh& mesh, int axis, std::uint32_t every = 2) {
  HalfEdgeMesh flipped(mesh);
  std::uint32_t n = 0;
  for (std::uint32_t i = 0; i < 3 * mesh.face_count(); ++i) {
    const HalfEdgeId h{i};
    const bool is_in_plane =
        flipped.position(flipped.tail(h))[axis] == 0 && flipped.position(flipped.tip(h))[axis] == 0;
    if (is_in_plane && h < flipped.twin(h) && n++ % every == 0 && flipped.can_flip(h)) flipped.flip(h);
  }
  return flipped.triangle_mesh();
}

/// The part of a mesh beyond the plane of coordinate `at`, and its mirror image there. The border goes into the plane;
/// where the border is ragged, faces are left out. The result is closed, but may be more than one component.
inline TriangleMesh mirrored_half(const TriangleMesh& mesh, int axis, double at) {
  std::vector<std::array<VertexId, 3>> kept;
  for (const auto& t : mesh.triangles)
    if (std::ranges::all_of(t, [&](VertexId v) { return mesh.positions[v][axis] > at; })) kept.push_back(t);
  std::vector<char> on_border;
  while (true) {
    // A vertex is inside if as many half-edges start at it as end there, all of them paired.
    std::map<std::pair<VertexId, VertexId>, int> edges;
    for (const auto& t : kept)
      for (int c = 0; c < 3; ++c) ++edges[{t[c], t[(c + 1) % 3]}];
    on_border.assign(mesh.vertex_count(), 0);
    std::vector<int> borders(mesh.vertex_count(), 0);
    for (const auto& [edge, count] : edges)
      if (!edges.contains({edge.second, edge.first})) {
        on_border[index(edge.first)] = on_border[index(edge.second)] = 1;
        ++borders[index(edge.first)];
      }
    const std::size_t before = kept.size();
    std::erase_if(kept, [&](const auto& t) {
      const auto is_at_border = [&](VertexId v) { return on_border[index(v)] != 0; };
      const auto is_pinched = [&](VertexId v) { return borders[index(v)] > 1; };
      // An edge between two border vertices that is no border edge would have four faces in the end.
      bool has_chord = false;
      for (int c = 0; c < 3; ++c)
        has_chord |= is_at_border(t[c]) && is_at_border(t[(c + 1) % 3]) && edges.contains({t[(c + 1) % 3], t[c]});
      return has_chord || std::ranges::all_of(t, is_at_border) || std::ranges::any_of(t, is_pinched);
    });
    if (kept.size() == before) break;
  }
  TriangleMesh half;
  std::vector<VertexId> renumbered(mesh.vertex_count(), kNoVertex), images;
  for (auto& t : kept)
    for (VertexId& v : t) {
      VertexId& is = renumbered[index(v)];
      if (is == kNoVertex) {
        Vec3 p = mesh.positions[v];
        p[axis] = on_border[index(v)] ? 0 : p[axis] - at;
        is = half.positions.push_back(p);
      }
      v = is;
    }
  const auto own = static_cast<std::uint32_t>(half.vertex_count());
  for (std::uint32_t i = 0; i < own; ++i) {
    Vec3 p = half.positions[VertexId{i}];
    if (p[axis] != 0) p[axis] = -p[axis];
    images.push_back(p[axis] == 0 ? VertexId{i} : half.positions.push_back(p));
  }
  for (const auto& [a, b, c] : kept) {
    half.triangles.push_back({a, b, c});
    half.triangles.push_back({images[index(a)], images[index(c)], images[index(b)]});
  }
  return half;
}

}  // namespace prohull::meshes
