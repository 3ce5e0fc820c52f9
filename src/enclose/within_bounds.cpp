#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "enclose/making.h"
#include "verify/nearest_face.h"

namespace prohull {
namespace {

/// Of each vertex, how far it is from the triangles, about.
PerVertex<double> distances_from(const TriangleMesh& triangles, const TriangleMesh& mesh) {
  const verify::NearestFace faces(triangles);
  PerVertex<double> distances(mesh.positions.size());
  constexpr std::uint32_t kTogether = 1024;  // neighbours, of which one tells where to look for the next
  const auto count = std::uint32_t(mesh.positions.size());
  oneapi::tbb::parallel_for(std::uint32_t{0}, (count + kTogether - 1) / kTogether, [&](std::uint32_t i) {
    std::uint32_t face = 0;
    std::size_t looked_at = 0;
    for (std::uint32_t v = i * kTogether; v < std::min(count, (i + 1) * kTogether); ++v) {
      const Vec3& p = mesh.positions[VertexId{v}];
      const auto found = faces.nearest(p, {face, faces.distance(p, face)}, looked_at);
      distances[VertexId{v}] = found.distance, face = found.face;
    }
  });
  return distances;
}

}  // namespace

// Where the hull moves, it has less void, and may come nearer.
EnclosingHull built_within(const Making& making) {
  const Solid& solid = making.solid();
  HullOptions how = making.hull_options();
  how.tolerances.assign(solid.mesh.face_count(), making.candidate.within);
  if (solid.source != Source::Mesh) how.deviations = distances_from(making.to_cover(), solid.mesh);
  HullResult result = build_hull(solid.mesh, how);
  EnclosingHull hull;
  hull.mesh = result.hull.base();
  hull.target_reached = hull.mesh.face_count() > making.candidate.target_faces;  // which bounds ask for
  hull.refusals = result.refusals, hull.blocked = result.blocked, hull.relaxed_guards = result.relaxed_guards;
  if (!making.recipe().moves) {
    hull.levels = std::move(result.hull);
  } else if (const double excess = excess_of(hull.mesh, making); is_worth_moving(hull.mesh.face_count(), excess)) {
    TriangleMesh moved = placed(hull.mesh, making);
    if (excess_of(moved, making) <= std::max(1.0, excess)) hull.mesh = std::move(moved);
  }
  return hull;
}

}  // namespace prohull
