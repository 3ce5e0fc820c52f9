#include "robot/link_triangles.h"

#include <algorithm>
#include <utility>

#include "prohull/error.h"
#include "prohull/mesh_io.h"

namespace prohull::robot {
namespace {

bool mirrors(const Vec3& scale) { return scale.x * scale.y * scale.z < 0; }

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

TriangleMesh mesh_triangles(const MeshFile& mesh) {
  if (mesh.path.empty()) throw InputError(Defect::CannotRead, mesh.why_not);
  TriangleMesh triangles = read_mesh(mesh.path, {.non_finite = NonFinite::Keep});
  if (mesh.scale != Vec3{1, 1, 1})
    for (Vec3& p : triangles.positions) p = {p.x * mesh.scale.x, p.y * mesh.scale.y, p.z * mesh.scale.z};
  if (mirrors(mesh.scale))
    for (auto& corners : triangles.triangles) std::swap(corners[1], corners[2]);
  return triangles;
}

TriangleMesh in_frame(TriangleMesh mesh, const Pose& origin, const Frame& frame) {
  if (frame.in_link == origin) return mesh;
  return placed(origin, std::move(mesh));
}

TriangleMesh link_triangles(std::span<const Shape> shapes, const Frame& frame) {
  TriangleMesh triangles;
  for (const Shape& shape : shapes) {
    if (std::holds_alternative<OtherForm>(shape.form)) continue;
    const MeshFile* const file = shape.mesh();
    append(triangles,
           in_frame(file ? mesh_triangles(*file) : form_mesh(shape.form, Curved::Around), shape.origin, frame));
  }
  return triangles;
}

}  // namespace prohull::robot
