#include "robot/form_measures.h"

#include <algorithm>

#include "prohull/enclosing_hull.h"
#include "prohull/union_verification.h"

namespace prohull::robot {

std::size_t shown_segments(std::size_t forms) { return forms <= 8 ? 64 : 32; }

TriangleMesh with_forms(TriangleMesh mesh, std::span<const CurvedForm> forms, Curved curved, std::size_t segments) {
  for (const CurvedForm& form : forms) append(mesh, form.mesh(curved, segments));
  return mesh;
}

TriangleMesh with_same_volume(const SolidPieces& all) {
  return with_forms(all.triangles, all.curved, Curved::SameVolume, shown_segments(all.curved.size()));
}

InsideVolume volume_of(const SolidPieces& all, const Progress& progress) {
  if (all.empty()) return {};
  if (const auto balls = only_balls(all); !balls.empty()) return {union_volume(balls)};
  InsideVolume inside = volume_inside(prepared_for_hulls(with_same_volume(all)), progress);
  inside.is_estimated |= !all.curved.empty() && (all.triangles.face_count() > 0 || all.curved.size() > 1);
  return inside;
}

double reach_at_most(const TriangleMesh& mesh, const CurvedForm& form) {
  double upper = 0;
  for (const Vec3& p : mesh.positions) upper = std::max(upper, form.distance(p).upper);
  return upper;
}

DistanceBounds widened(const DistanceBounds& bounds, double above, double below) {
  return {std::max(0.0, bounds.lower - below), bounds.upper + above, bounds.farthest};
}

DistanceBounds from_forms(const DistanceBounds& bounds, double around, bool only_outside) {
  return widened(bounds, around, only_outside ? 0 : around);
}

}  // namespace prohull::robot
