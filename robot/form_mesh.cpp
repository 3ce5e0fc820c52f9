#include "prohull/detail/refuse.h"
#include "robot/link_triangles.h"

namespace prohull::robot {
namespace {

TriangleMesh box_mesh(const Vec3& size) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({(i & 1) != 0 ? size.x / 2 : -size.x / 2, (i & 2) != 0 ? size.y / 2 : -size.y / 2,
                              (i & 4) != 0 ? size.z / 2 : -size.z / 2});
  constexpr std::uint32_t kFaces[12][3]{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                        {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  for (const auto& [a, b, c] : kFaces) mesh.triangles.push_back({VertexId(a), VertexId(b), VertexId(c)});
  return mesh;
}

}  // namespace

std::optional<CurvedForm> curved_form(const Form& form, const Pose& pose) {
  if (const auto* sphere = std::get_if<SphereForm>(&form))
    return CurvedForm::sphere({pose.translation, sphere->radius});
  if (const auto* cylinder = std::get_if<CylinderForm>(&form))
    return CurvedForm::cylinder(cylinder->radius, cylinder->length, pose);
  if (const auto* capsule = std::get_if<CapsuleForm>(&form))
    return CurvedForm::capsule(capsule->radius, capsule->length, pose);
  return std::nullopt;
}

TriangleMesh form_mesh(const Form& form, Curved curved, std::size_t segments) {
  if (const auto* box = std::get_if<BoxForm>(&form)) return box_mesh(box->size);
  if (const auto curve = curved_form(form)) return curve->mesh(curved, segments);
  refuse("only a box, sphere, cylinder or capsule has a mesh of its own");
}

}  // namespace prohull::robot
