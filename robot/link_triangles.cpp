#include "robot/link_triangles.h"

#include <algorithm>
#include <utility>

#include "prohull/convex_hull.h"
#include "prohull/detail/finite.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "robot/form_measures.h"

namespace prohull::robot {
namespace {

bool mirrors(const Vec3& scale) { return scale.x * scale.y * scale.z < 0; }

TriangleMesh shape_triangles(const Shape& shape, const Frame& frame) {
  if (std::holds_alternative<OtherForm>(shape.form)) return {};
  const MeshFile* const file = shape.mesh();
  return in_frame(file ? mesh_triangles(*file) : form_mesh(shape.form, Curved::Around), shape.origin, frame);
}

}  // namespace

Frame common_frame(std::span<const Shape> shapes) {
  Frame frame;
  if (shapes.empty()) return frame;
  const Pose& first = shapes[0].origin;
  if (std::ranges::any_of(shapes, [&](const Shape& shape) { return shape.origin != first; })) return frame;
  frame.in_link = first;
  if (first != Pose{}) frame.same_origin_as = 0;
  return frame;
}

Pose pose_in(const Frame& frame, const Shape& shape) { return shape.origin == frame.in_link ? Pose{} : shape.origin; }

TriangleMesh mesh_triangles(const MeshFile& mesh) {
  if (mesh.path.empty()) throw InputError(Defect::CannotRead, mesh.why_not);
  TriangleMesh triangles = read_mesh(mesh.path, {.non_finite = NonFinite::Keep, .alone = mesh.alone});
  if (mesh.scale != Vec3{1, 1, 1})
    for (Vec3& p : triangles.positions) p = {p.x * mesh.scale.x, p.y * mesh.scale.y, p.z * mesh.scale.z};
  if (mirrors(mesh.scale))
    for (auto& corners : triangles.triangles) std::swap(corners[1], corners[2]);
  return mesh.is_filled ? convex_hull(with_finite_faces(std::move(triangles))) : triangles;
}

TriangleMesh finite_triangles(TriangleMesh mesh) {
  mesh = with_finite_faces(std::move(mesh));
  for (Vec3& p : mesh.positions)
    if (!is_finite(p)) p = {};
  return mesh;
}

bool keeps_float32(const TriangleMesh& mesh) {
  const auto is_kept = [](double x) { return double(float(x)) == x; };
  return std::ranges::all_of(mesh.positions,
                             [&](const Vec3& p) { return is_kept(p.x) && is_kept(p.y) && is_kept(p.z); });
}

TriangleMesh in_frame(TriangleMesh mesh, const Pose& origin, const Frame& frame) {
  if (frame.in_link == origin) return mesh;
  return placed(origin, std::move(mesh));
}

TriangleMesh link_triangles(std::span<const Shape> shapes, const Frame& frame) {
  TriangleMesh triangles;
  for (const Shape& shape : shapes) append(triangles, shape_triangles(shape, frame));
  return triangles;
}

LinkGeometry link_geometry(std::span<const Shape> shapes, const Frame& frame) {
  LinkGeometry geometry;
  auto& [parts, around] = geometry.curved;
  for (const Shape& shape : shapes) {
    const TriangleMesh mesh = shape_triangles(shape, frame);
    append(geometry.triangles, mesh);
    if (const auto form = curved_form(shape.form, pose_in(frame, shape))) {
      parts.curved.push_back(*form);
      around = std::max(around, reach_at_most(mesh, *form));
    } else {
      append(parts.triangles, mesh);
    }
  }
  if (parts.curved.empty()) parts = {};
  return geometry;
}

}  // namespace prohull::robot
