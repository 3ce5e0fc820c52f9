#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "construct/growth.h"
#include "construct/shape_guards.h"
#include "enclose/level_search.h"
#include "enclose/making.h"
#include "prohull/distance.h"
#include "verify/nearest_face.h"

namespace prohull {
namespace {

// Of the levels, the coarsest that keeps the bounds. Where the solid misses them itself, as one that was changed around
// its folds, the coarsest that is about as near: all bounds that are missed have the same answer.
std::size_t faces_of_level(const ProgressiveHull& hull, const Making& making) {
  constexpr double kAsNear = 1.01;
  const std::size_t target = making.candidate.target_faces;
  std::size_t faces = std::max(target, making.candidate.least_faces);
  if (making.bounds().any()) {
    const double least = excess_when_padded(making.solid().mesh, making), most = least <= 1 ? 1 : kAsNear * least;
    const auto is_near = [&](const TriangleMesh& level) { return excess_as_stored(level, making) <= most; };
    if (std::isfinite(least)) faces = std::max(faces, faces_within(hull, is_near));
  }
  if (!making.request.is_symmetric()) return faces;
  const std::size_t coarser = symmetric_faces(hull, *making.options().hull.mirror, faces);
  return faces > target && coarser < faces ? faces + 2 : coarser;  // bounds need the finer one
}

LevelTrial try_level(const ProgressiveHull& hull, std::size_t faces, const Making& making) {
  TriangleMesh mesh = placed(hull.level(faces), making);
  const double excess = excess_as_stored(mesh, making);
  return {faces, std::move(mesh), excess};
}

// Whether many faces keep the bounds, or else how near they come: with four times as many, a hull of a tangled head had
// 0.6 times the void. All bounds that are missed have the same answer, so that closer ones have no looser hull.
LevelTrial nearest_level(std::size_t fewest, std::size_t finest, const std::function<LevelTrial(std::size_t)>& trial) {
  constexpr std::size_t kMore = 3;
  const std::size_t faces = std::min(finest, faces_of_first_trial(fewest));
  LevelTrial first = trial(faces);
  if (first.keeps_bounds() || faces == finest) return first;
  LevelTrial second = trial(std::min(finest, kMore * faces));
  return second.excess < first.excess ? second : first;
}

// Of a hull that moves, coarse levels are tried first: what moves far may keep a bound that finer levels miss. Where
// the solid misses the bounds itself, one that moves may keep them; if it does not either, it is near at least.
LevelTrial moved_level(const ProgressiveHull& hull, const Making& making) {
  const std::size_t target = making.candidate.target_faces, finest = hull.original_face_count();
  const std::size_t fewest = std::min(std::max(target, hull.base_face_count()), finest);
  const auto trial = [&](std::size_t faces) { return try_level(hull, faces, making); };
  const double least = excess_when_padded(making.solid().mesh, making);
  const bool is_possible = least <= 1;
  if (least > kNearerByMoving && making.solid().source != Source::Wrap) return trial(target);
  if (!is_possible)
    if (LevelTrial nearest = nearest_level(fewest, finest, trial); !nearest.keeps_bounds()) return nearest;
  LevelTrial found = search_levels(fewest, finest, trial);
  if (found.keeps_bounds() || !is_possible) return found;
  const std::size_t faces = faces_of_level(hull, making);
  return {faces, hull.level(faces), 1};
}

std::size_t faces_of(double of_those_asked_for, const Making& making) {
  return std::size_t(std::llround(of_those_asked_for * double(making.candidate.target_faces)));
}

struct Step {
  double faces;  ///< of those asked for
  unsigned rounds;
  double stuck;  ///< with more, in Candidate::most_faces
};

// One that is stuck with too many faces to be better than another hull does not move any more.
EnclosingHull in_steps(TriangleMesh start, std::span<const Step> steps, const MayReach& may_reach,
                       const Making& making) {
  EnclosingHull hull;
  hull.mesh = std::move(start);
  for (const auto& [faces, rounds, stuck] : steps) {
    if (!(signed_volume(hull.mesh) > 0)) break;  // an inner hull may vanish
    HullOptions options = making.hull_options();
    options.target_faces = faces_of(faces, making);
    options.guards.max_overhang = overhang_left(bounding_box(hull.mesh), bounding_box(making.request.input.original),
                                                making.options().hull.guards.max_overhang);
    HullResult result = build_hull(hull.mesh, options, may_reach);
    hull.mesh = result.hull.base();
    const bool is_stuck = double(hull.mesh.face_count()) > stuck * double(making.candidate.most_faces);
    if (!is_stuck) hull.mesh = placed(hull.mesh, making, rounds, may_reach);
    hull.target_reached = result.stopped == Stopped::TargetReached;
    hull.refusals += result.refusals, hull.blocked = result.blocked;
    hull.relaxed_guards = std::max(hull.relaxed_guards, result.relaxed_guards);
    if (is_stuck) break;
  }
  return hull;
}

}  // namespace

EnclosingHull built_of_levels(const Making& making) {
  const HullResult& result = making.solids.levels(making.candidate.solid, making.candidate.seed);
  std::optional<LevelTrial> moved;
  if (making.recipe().moves) moved = moved_level(result.hull, making);
  const std::size_t faces = moved ? moved->faces : faces_of_level(result.hull, making);
  const TriangleMesh level = result.hull.level(faces);
  EnclosingHull hull;
  hull.mesh = moved ? std::move(moved->mesh) : TriangleMesh(level);
  const bool is_coarsest = level.face_count() == result.hull.base_face_count();
  hull.target_reached = making.bounds().any() && faces > making.candidate.target_faces &&  // which they ask for
                        !(making.request.is_bound_to_mesh() && is_coarsest);
  if (hull.mesh == level)
    hull.levels = faces > result.hull.base_face_count() ? result.hull.with_base(faces) : result.hull;
  hull.refusals = result.refusals, hull.blocked = result.blocked;
  if (is_coarsest) hull.relaxed_guards = result.relaxed_guards;
  return hull;
}

// Moved before it has come down to its faces, too, a hull is up to 1 % smaller. The mesh has its levels already: one of
// them comes first.
EnclosingHull built_in_steps(const Making& making) {
  constexpr Step kSteps[]{{1.5, 2, 4}, {1, kRoundsAtTheEnd, 1}};
  return in_steps(making.solid().source == Source::Mesh
                      ? making.solids.levels(making.candidate.solid, making.candidate.seed)
                            .hull.level(faces_of(kSteps[0].faces, making))
                      : making.solid().mesh,
                  kSteps, {}, making);
}

double short_bound_of_reach(const TriangleMesh& hull, const TriangleMesh& triangles) {
  constexpr std::size_t kMostCells = 20'000;
  return distance_bounds(hull, triangles, {.max_cells = kMostCells}).upper;
}

// A collapse places its vertex outside of faces that stand off already: what moves on the way keeps what follows near.
// Of 122 tight hulls of robots' wraps with 60 to 300 faces, the void is 0.90 times that before in the median, the time
// 1.17 times; without --tight, 0.87 and 1.33, up to 5 times. Each move makes the hull smaller, but not nearer: without
// a limit, a knuckle of 500 faces reached out by 18.8 mm for 2.1 after the moves at twice the faces.
std::optional<EnclosingHull> built_early(const Making& making) {
  constexpr Step kSteps[]{{4, 4, 10}, {2, 4, 5}, {1.4, 4, 4}, {1, kRoundsAtTheEnd, 1}};
  constexpr double kAsNear = 1.1;  // between the points that are asked about, faces may reach farther
  const double within = making.candidate.within;
  const TriangleMesh& original = making.request.input.original;  // doors of the solid are no part of it
  const verify::NearestFace triangles(original);
  const auto is_near = [&](const Vec3& p) {
    std::size_t looked_at = 0;
    return triangles.nearest(p, {0, within}, looked_at).distance < within;
  };
  EnclosingHull hull = in_steps(making.solid().mesh, kSteps, is_near, making);
  if (hull.mesh.face_count() > making.candidate.target_faces ||
      short_bound_of_reach(hull.mesh, original) > kAsNear * within)
    return std::nullopt;
  return hull;
}

}  // namespace prohull
