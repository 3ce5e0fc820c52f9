#include "construct/tight/original.h"

#include <utility>
#include <vector>

#include "geometry/predicates.h"

namespace prohull {
namespace {

std::vector<Triangle> triangles_of(const TriangleMesh& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.face_count());
  for (const FaceId f : mesh.triangles.ids()) triangles.push_back(mesh.triangle(f));
  return triangles;
}

Bvh tree_of(const TriangleMesh& mesh) {
  std::vector<Box> boxes;
  boxes.reserve(mesh.face_count());
  for (const FaceId f : mesh.triangles.ids()) boxes.push_back(box_of(mesh.triangle(f)));
  return Bvh(boxes);
}

/// A point in the inside of the tetrahedron, if rounding leaves one there.
std::optional<Vec3> point_inside(const Tetrahedron& t) {
  const Vec3 center = t.a * 0.25 + t.b * 0.25 + t.c * 0.25 + t.d * 0.25;
  const bool is_inside = side(t.a, t.b, t.c, center) == Side::Inside && side(t.d, t.c, t.b, center) == Side::Inside &&
                         side(t.a, t.d, t.b, center) == Side::Inside && side(t.a, t.c, t.d, center) == Side::Inside;
  if (!is_inside) return std::nullopt;
  return center;
}

}  // namespace

Original::Original(TriangleMesh mesh, double clearance)
    : mesh_(std::move(mesh)), tree_(tree_of(mesh_)), bounds_(bounding_box(mesh_)), clearance_(clearance) {}

Original Original::closed(TriangleMesh mesh, HullSide side) {
  Original original(std::move(mesh), 0);
  original.winding_.emplace(triangles_of(original.mesh_));
  original.least_covered_ = side == HullSide::Outer ? 1 : 0;
  return original;
}

Original Original::triangles(TriangleMesh mesh, double clearance) { return {std::move(mesh), clearance}; }

bool Original::lies_outside_of(const Tetrahedron& removed) const {
  Box box;
  for (const Vec3& p : {removed.a, removed.b, removed.c, removed.d}) box.extend(p);
  bool met = false;
  tree_.visit([&](const Box& other) { return !met && other.overlaps(box); },
              [&](std::uint32_t f) {
                met = met || (winding_ ? meets_interior(mesh_.triangle(FaceId{f}), removed)
                                       : may_touch(mesh_.triangle(FaceId{f}), removed));
              });
  if (met || !winding_) return !met;
  const auto inside = point_inside(removed);
  return inside && winding_->at(*inside).value_or(least_covered_) < least_covered_;
}

}  // namespace prohull
