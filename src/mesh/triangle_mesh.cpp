#include "prohull/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <utility>

#include "prohull/detail/finite.h"

namespace prohull {

void append(TriangleMesh& mesh, const TriangleMesh& part) {
  const std::uint32_t first = index(mesh.positions.next_id());
  for (const Vec3& p : part.positions) mesh.positions.push_back(p);
  for (const auto& [a, b, c] : part.triangles)
    mesh.triangles.push_back({VertexId{first + index(a)}, VertexId{first + index(b)}, VertexId{first + index(c)}});
}

TriangleMesh together(const std::vector<TriangleMesh>& parts) {
  TriangleMesh mesh;
  for (const TriangleMesh& part : parts) append(mesh, part);
  return mesh;
}

Box bounding_box(const TriangleMesh& mesh) {
  Box box;
  for (const auto& t : mesh.triangles)
    for (const VertexId v : t) box.extend(mesh.positions[v]);
  return box;
}

Box finite_bounding_box(const TriangleMesh& mesh) {
  Box box;
  for (const FaceId f : mesh.triangles.ids())
    if (const Triangle t = mesh.triangle(f); is_finite(t.a) && is_finite(t.b) && is_finite(t.c))
      for (const Vec3& p : {t.a, t.b, t.c}) box.extend(p);
  return box;
}

TriangleMesh with_finite_faces(TriangleMesh mesh) {
  PerFace<std::array<VertexId, 3>> kept;
  kept.reserve(mesh.face_count());
  for (const auto& corners : mesh.triangles)
    if (std::ranges::all_of(corners, [&](VertexId v) { return is_finite(mesh.positions[v]); })) kept.push_back(corners);
  mesh.triangles = std::move(kept);
  return mesh;
}

TriangleMesh without_unused_vertices(TriangleMesh mesh) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  PerVertex<std::uint32_t> number(mesh.vertex_count(), kUnused);
  for (const auto& corners : mesh.triangles)
    for (const VertexId v : corners) number[v] = 0;
  PerVertex<Vec3> used;
  for (const VertexId v : mesh.positions.ids())
    if (number[v] != kUnused) number[v] = index(used.push_back(mesh.positions[v]));
  if (used.size() == mesh.positions.size()) return mesh;
  for (auto& corners : mesh.triangles)
    for (VertexId& v : corners) v = VertexId(number[v]);
  mesh.positions = std::move(used);
  return mesh;
}

TriangleMesh finite_part(const TriangleMesh& mesh) { return without_unused_vertices(with_finite_faces(mesh)); }

double signed_volume(const TriangleMesh& mesh) {
  const Box box = bounding_box(mesh);
  if (box.is_empty()) return 0;
  const Vec3 center = box.center();
  // In units of the box, so that no product overflows before the last one.
  const double unit = std::max({box.max.x - center.x, box.max.y - center.y, box.max.z - center.z});
  if (unit == 0) return 0;
  double sixfold = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = (mesh.positions[t[0]] - center) / unit, b = (mesh.positions[t[1]] - center) / unit,
               c = (mesh.positions[t[2]] - center) / unit;
    sixfold += dot(a, cross(b, c));
  }
  const double volume = sixfold / 6;
  return volume == 0 ? 0 : volume * unit * unit * unit;
}

bool has_triangles_of(const TriangleMesh& a, const TriangleMesh& b) {
  if (a.face_count() != b.face_count()) return false;
  for (const FaceId f : a.triangles.ids())
    if (a.triangle(f) != b.triangle(f)) return false;
  return true;
}

}  // namespace prohull
