#include "view/shared_faces.h"

#include <algorithm>

namespace prohull::view {

SharedFaces::Corners SharedFaces::corners_of(const Triangle& face) {
  const auto numbers = [](const Vec3& p) { return std::array{p.x, p.y, p.z}; };
  Corners corners{numbers(face.a), numbers(face.b), numbers(face.c)};
  std::ranges::sort(corners);
  return corners;
}

SharedFaces::SharedFaces(const TriangleMesh& original) {
  faces_.reserve(original.face_count());
  for (const FaceId f : original.triangles.ids()) faces_.push_back(corners_of(original.triangle(f)));
  std::ranges::sort(faces_);
}

TriangleMesh SharedFaces::left_out_of(TriangleMesh mesh) const {
  PerFace<std::array<VertexId, 3>> others;
  for (const FaceId f : mesh.triangles.ids())
    if (!std::ranges::binary_search(faces_, corners_of(mesh.triangle(f)))) others.push_back(mesh.triangles[f]);
  mesh.triangles = std::move(others);
  return mesh;
}

}  // namespace prohull::view
