#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "construct/shape_guards.h"
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

/// A large hull moves only where it misses the bounds: of three parts, hulls of 19,220, 39,808 and 50,476 faces that
/// kept them broke them by moving, after 3, 7 and 11 s.
bool may_move(std::size_t faces, double excess) { return is_small(faces) || (excess > 1 && excess <= kNearerByMoving); }

/// A hull with further collapses, which keep so much of the bound of the distance, or all bounds of the void.
struct FurtherTrial {
  HullResult result;
  TriangleMesh mesh;
  double excess;  ///< HullBounds::excess: above 1, it breaks a bound
};

/// The hull, moved towards the triangles if it keeps the bounds then, too: between vertices, it may come farther from
/// them. Large ones stay: moving takes most of the time.
TriangleMesh start_of(const TriangleMesh& hull, const Making& making) {
  if (!is_small(hull.face_count())) return hull;
  TriangleMesh moved = placed(hull, making);
  return excess_of(moved, making) <= 1 ? moved : hull;
}

FurtherTrial try_further(const TriangleMesh& start, double distance, const Making& making) {
  HullOptions how = making.hull_options();
  const bool is_of_void = std::isinf(distance);
  if (!is_of_void) {
    how.tolerances.assign(start.face_count(), distance);
    how.deviations = distances_from(making.to_cover(), start);
  }
  how.guards.max_overhang =
      overhang_left(bounding_box(start), bounding_box(making.request.input.original), how.guards.max_overhang);
  HullResult result = build_hull(start, how);
  const auto keeps = [&](const TriangleMesh& level) { return excess_of(level, making) <= 1; };
  TriangleMesh mesh =
      is_of_void && keeps(start) ? result.hull.level(faces_within(result.hull, keeps)) : result.hull.base();
  const double excess = excess_of(mesh, making);
  FurtherTrial trial{std::move(result), std::move(mesh), excess};
  if (trial.excess > 1 && is_small(trial.mesh.face_count())) {
    TriangleMesh moved = placed(trial.mesh, making);
    if (const double nearer = excess_of(moved, making); nearer < trial.excess)
      trial.mesh = std::move(moved), trial.excess = nearer;
  }
  return trial;
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
  } else if (const double excess = excess_of(hull.mesh, making); may_move(hull.mesh.face_count(), excess)) {
    TriangleMesh moved = placed(hull.mesh, making);
    if (excess_of(moved, making) <= std::max(1.0, excess)) hull.mesh = std::move(moved);
  }
  return hull;
}

// What collapses count as used up of the bound is more than what the hull is away. So that is measured, and there are
// further collapses. Between vertices, they may break the bound: where moving does not help, they keep less of it.
// Without a move before each round, a head at 3 % of the diagonal had 156 faces, with it 116.
EnclosingHull built_further(const Making& making) {
  constexpr int kMostRounds = 4;
  constexpr double kFewer = 0.95;  // with more faces than so much of those before, another round is not worth its time
  constexpr double kNearer = 0.85;
  EnclosingHull hull = *making.candidate.start;
  hull.levels.reset();
  TriangleMesh start = start_of(hull.mesh, making);
  double distance = making.bounds().max_distance, fewer = 0;
  for (int round = 0; round < kMostRounds && fewer <= kFewer && distance > 0; ++round) {
    FurtherTrial trial = try_further(start, distance, making);
    fewer = double(trial.mesh.face_count()) / double(hull.mesh.face_count());
    if (trial.excess > 1) {
      distance *= std::min(kNearer, 1 / trial.excess);
    } else if (fewer < 1) {
      hull.mesh = std::move(trial.mesh);
      if (fewer <= kFewer && round + 1 < kMostRounds) start = start_of(hull.mesh, making);
      hull.refusals += trial.result.refusals, hull.blocked = trial.result.blocked;
      hull.relaxed_guards = std::max(hull.relaxed_guards, trial.result.relaxed_guards);
    }
  }
  return hull;
}

}  // namespace prohull
