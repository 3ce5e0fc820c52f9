#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/stopwatch.h"
#include "construct/shape_guards.h"
#include "construct/tight/gap_body.h"
#include "enclose/candidate.h"
#include "enclose/certify.h"
#include "enclose/level_search.h"
#include "mesh/area.h"
#include "prohull/error.h"
#include "prohull/float32_hull.h"
#include "prohull/mesh_report.h"
#include "prohull/tight_hull.h"

namespace prohull {
namespace {

constexpr unsigned kRoundsAtTheEnd = 6;
constexpr double kNoBound = std::numeric_limits<double>::infinity();

/// One candidate on its way: what it is, and what it is built with.
struct Making {
  const Candidate& candidate;
  const Request& request;
  Solids& solids;

  const Recipe& recipe() const { return candidate.recipe; }
  const EnclosingOptions& options() const { return request.options; }
  const Solid& solid() const { return solids[candidate.solid]; }
  const TriangleMesh& to_cover() const { return solids.to_cover(candidate.solid); }
  HullOptions hull_options() const { return request.hull_options(candidate.target_faces); }
};

// With the coordinates that a file keeps, or why it has none. A hull of a mesh that intersects itself may have no room
// for its vertices: the certificate decides, and lifting may help.
std::pair<std::optional<Float32Hull>, std::string> as_stored(const TriangleMesh& hull, const Making& making) {
  if (!making.options().hull.float32_coordinates) return {Float32Hull{hull, 0}, {}};
  try {
    const bool may_lift = making.solid().self_intersections > 0;
    return {with_float32_coordinates(hull, making.options().hull.side, may_lift ? NoRoom::Round : NoRoom::Refuse), {}};
  } catch (const InputError& error) {
    return {std::nullopt, error.what()};
  }
}

/// What the volumes of hulls are compared with; 0 where nothing is inside, or nothing is known of it yet.
double original_volume(const Making& making) { return making.solids.volume(making.candidate.target_faces); }

double excess_of(const HullBounds& bounds, const TriangleMesh& hull, double volume, const Making& making) {
  const Solid& solid = making.solid();
  // What lies around folds is not of the mesh.
  const bool is_near_solid = solid.source == Source::Mesh && solid.folds.faces == 0;
  return bounds.excess(hull, is_near_solid ? solid.mesh : making.to_cover(), volume, making.options().progress);
}

double excess_of(const TriangleMesh& hull, const Making& making) {
  return excess_of(making.options().bounds, hull, original_volume(making), making);
}

// A hull of the mesh is moved away by the padding when it is done, and gains about its area times the padding. Wraps
// keep the padding themselves.
double excess_when_padded(const TriangleMesh& hull, const Making& making) {
  const double padding = making.options().padding;
  if (padding == 0 || making.solid().source != Source::Mesh) return excess_of(hull, making);
  const double volume = original_volume(making), gain = padding * area_of(hull);
  HullBounds left = making.options().bounds;
  left.max_distance -= padding;
  left.max_added_volume = std::min(left.max_added_volume, std::exchange(left.max_void_ratio, kNoBound) * volume);
  return excess_of(left, hull, making.request.is_outer() ? volume - gain : volume + gain, making);
}

bool is_within_as_stored(const TriangleMesh& hull, const Making& making) {
  const auto [stored, why_not] = as_stored(hull, making);
  return stored && excess_when_padded(stored->mesh, making) <= 1;
}

// Moved towards the triangles.
TriangleMesh placed(const TriangleMesh& level, const Making& making, unsigned max_rounds = kRoundsAtTheEnd) {
  const MoveOptions how = making.request.move_options(max_rounds);
  return making.recipe().approach == Approach::Touching
             ? moved_towards_closed(level, making.request.input.closed->mesh, how.side, how)
             : moved_towards(level, making.to_cover(), how);
}

// Of the levels, the coarsest that keeps the bounds, if any does.
std::size_t faces_of_level(const ProgressiveHull& hull, const Making& making) {
  const std::size_t target = making.candidate.target_faces;
  std::size_t faces = target;
  if (making.options().bounds.any() && excess_when_padded(making.solid().mesh, making) <= 1)
    faces = std::max(target,
                     faces_within(hull, [&](const TriangleMesh& level) { return is_within_as_stored(level, making); }));
  if (!making.request.is_symmetric()) return faces;
  const std::size_t coarser = symmetric_faces(hull, *making.options().hull.mirror, faces);
  return faces > target && coarser < faces ? faces + 2 : coarser;  // bounds need the finer one
}

LevelTrial try_level(const ProgressiveHull& hull, std::size_t faces, const Making& making) {
  LevelTrial trial{faces, placed(hull.level(faces), making), std::numeric_limits<double>::infinity()};
  if (const auto [stored, why_not] = as_stored(trial.mesh, making); stored)
    trial.excess = excess_when_padded(stored->mesh, making);
  return trial;
}

// Of a hull that moves, coarse levels are tried first: what moves far may keep a bound that finer levels miss. Where
// the solid misses the bounds itself, one that moves may keep them; if it does not either, it is near at least.
LevelTrial moved_level(const ProgressiveHull& hull, const Making& making) {
  const std::size_t target = making.candidate.target_faces, finest = hull.original_face_count();
  const std::size_t fewest = std::min(std::max(target, hull.base_face_count()), finest);
  const auto trial = [&](std::size_t faces) { return try_level(hull, faces, making); };
  const bool is_possible = excess_when_padded(making.solid().mesh, making) <= 1;
  if (!is_possible && making.solid().source != Source::Wrap) return trial(target);
  if (!is_possible)
    if (LevelTrial first = trial(std::min(finest, faces_of_first_trial(fewest))); !first.keeps_bounds()) return first;
  LevelTrial found = search_levels(fewest, finest, trial);
  if (found.keeps_bounds() || !is_possible) return found;
  const std::size_t faces = faces_of_level(hull, making);
  return {faces, hull.level(faces), 1};
}

EnclosingHull built_of_levels(const Making& making) {
  const HullResult& result = making.solids.levels(making.candidate.solid);
  std::optional<LevelTrial> moved;
  if (making.recipe().moves) moved = moved_level(result.hull, making);
  const std::size_t faces = moved ? moved->faces : faces_of_level(result.hull, making);
  const TriangleMesh level = result.hull.level(faces);
  EnclosingHull hull;
  hull.mesh = moved ? std::move(moved->mesh) : TriangleMesh(level);
  hull.target_reached = faces > making.candidate.target_faces;  // which bounds ask for
  if (hull.mesh == level)
    hull.levels = faces > result.hull.base_face_count() ? result.hull.with_base(faces) : result.hull;
  hull.refusals = result.refusals, hull.blocked = result.blocked;
  if (level.face_count() == result.hull.base_face_count()) hull.relaxed_guards = result.relaxed_guards;
  return hull;
}

// Moved before it has come down to its faces, too, a hull is up to 1 % smaller.
EnclosingHull built_in_steps(const Making& making) {
  constexpr std::pair<double, unsigned> kSteps[]{{1.5, 2}, {1, kRoundsAtTheEnd}};
  const double target = double(making.candidate.target_faces);
  EnclosingHull hull;
  hull.mesh = making.solid().mesh;
  for (const auto& [faces, rounds] : kSteps) {
    if (!(signed_volume(hull.mesh) > 0)) break;  // an inner hull may vanish
    HullOptions options = making.request.hull_options(std::size_t(std::llround(faces * target)));
    options.guards.max_overhang = overhang_left(bounding_box(hull.mesh), bounding_box(making.request.input.original),
                                                making.options().hull.guards.max_overhang);
    HullResult result = build_hull(hull.mesh, options);
    hull.mesh = placed(result.hull.base(), making, rounds);
    hull.target_reached = result.stopped == Stopped::TargetReached;
    hull.refusals += result.refusals, hull.blocked = result.blocked;
    hull.relaxed_guards = std::max(hull.relaxed_guards, result.relaxed_guards);
  }
  return hull;
}

TightHull tight_of(const TriangleMesh& mesh, const TriangleMesh* wrapped, double padding, const Making& making) {
  return build_tight_hull(mesh, making.hull_options(), wrapped, padding);
}

// At 2,000 faces a tight hull of the gap's body has up to a quarter less void than a tight hull of the mesh that is
// moved away from it.
std::optional<TightHull> tight_of_gap_body(const Making& making) {
  const auto body_of = making.solid().source == Source::Mesh ? gap_body : gap_body_of_wrap;
  const TriangleMesh body =
      body_of(making.solid().mesh, making.to_cover(), making.request.aim(), making.hull_options());
  if (count_self_intersections(body) > 0) return std::nullopt;
  TightHull tight = tight_of(body, nullptr, 0, making);
  tight.mesh = moved_towards(tight.mesh, making.to_cover(), making.request.move_options(kRoundsAtTheEnd));
  return tight;
}

TightHull tight_of_solid(const Making& making) {
  const TriangleMesh& mesh = making.solid().mesh;
  const TriangleMesh* wrapped = making.solid().source == Source::Mesh ? nullptr : &making.to_cover();
  const double aim = making.request.aim();
  if (!making.options().bounds.any()) return tight_of(mesh, wrapped, aim, making);
  return build_tight_hull_within(
      mesh, [&](const TriangleMesh& hull) { return is_within_as_stored(hull, making); }, making.hull_options(), wrapped,
      aim, making.candidate.most_faces);
}

std::optional<EnclosingHull> built(const Making& making) {
  const Method method = making.recipe().method;
  if (method == Method::Levels) return built_of_levels(making);
  if (method == Method::InSteps) return built_in_steps(making);
  std::optional<TightHull> tight =
      method == Method::TightOfGapBody ? tight_of_gap_body(making) : tight_of_solid(making);
  if (!tight) return std::nullopt;
  EnclosingHull hull;
  hull.mesh = std::move(tight->mesh);
  hull.target_reached = tight->stopped == Stopped::TargetReached;
  hull.refusals = tight->refusals, hull.blocked = tight->blocked;
  hull.relaxed_guards = tight->relaxed_guards;
  return hull;
}

}  // namespace

std::optional<Recipe> other_way(Recipe recipe, const Request& request) {
  if (recipe.method == Method::TightOfGapBody)
    recipe.method = Method::Tight;
  else if (recipe.moves && recipe.approach == Approach::Touching && request.is_outer())
    recipe.approach = Approach::Clear;
  else
    return std::nullopt;
  return recipe;
}

std::optional<Attempt> attempt(const Candidate& candidate, const Request& request, Solids& solids) {
  const Making making{candidate, request, solids};
  const Stopwatch building;
  std::optional<EnclosingHull> hull = built(making);
  if (!hull) return std::nullopt;
  Attempt made{.candidate = candidate, .hull = std::move(*hull)};
  made.hull.target_faces = candidate.target_faces;
  made.hull.target_reached |= made.hull.mesh.face_count() <= candidate.target_faces;
  made.hull.solid = candidate.solid;
  made.hull.source = making.solid().source;
  auto [stored, why_not] = as_stored(made.hull.mesh, making);
  made.why_not_storable = std::move(why_not);
  if (stored) made.hull.mesh = std::move(stored->mesh), made.hull.rounded_vertices = stored->rounded_vertices;
  made.hull.build_seconds = building.seconds();

  const Stopwatch verifying;
  if (stored) certify(made, request, solids);
  made.hull.self_intersections =
      made.hull.verdict.holds() ? made.hull.verdict.self_intersections : count_self_intersections(made.hull.mesh);
  if (stored && request.options.bounds.any()) made.hull.excess = excess_of(made.hull.mesh, making);
  made.hull.within_bounds = made.hull.excess <= 1;
  made.hull.verify_seconds = verifying.seconds();
  return made;
}

}  // namespace prohull
