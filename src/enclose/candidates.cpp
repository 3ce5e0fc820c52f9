#include "enclose/candidates.h"

#include <algorithm>
#include <cmath>

#include "construct/tight/few_faces.h"

namespace prohull {

Candidates::Candidates(const Request& request, std::size_t target_faces, const HullBounds& bounds, std::uint64_t seed,
                       Notes& notes)
    : request_(request), target_faces_(target_faces), bounds_(bounds), seed_(seed), notes_(notes) {
  if (request.is_free() && !request.input.closed && std::isfinite(bounds.max_void_ratio)) plan_volume();
  plan_mesh();
  if (request.is_padded() && bounds.any()) plan_finer_levels();
  if (request.is_outer() && !request.is_bound_to_mesh()) plan_unfolded_mesh();
  if (may_move_mesh()) plan_moved_mesh();
  if (request.is_outer() && may_stay_within()) plan_within_of_mesh();
  if (may_go_further()) plan_further();
  if (request.is_free()) {
    plan_convex_hull();
    if (bounds_.any() && !request.options.levels) plan_convex_hull_in_steps();
    if (!request.options.levels) plan_polytope();
    if (!bounds_.any() || !request.options.levels) plan_wraps();
    if (bounds_.any())
      plan_bounded_wraps();
    else
      plan_other_wraps(), plan_clear_of_wraps();
    if (!bounds_.any() && request.options.tight) plan_early();
  }
  if (!request.is_outer() && request.options.repair != Repair::None) {
    if (!request.is_bound_to_mesh() && !request.options.levels) plan_inner();
    if (request.is_padded()) plan_inner_with_padding();
  }
  if (request.options.tight) plan_tight();
}

std::optional<Candidate> Candidates::next(const Ranking& ranking, Solids& solids) {
  std::optional<Candidate> next = last_ ? follow_up(ranking, solids) : std::nullopt;
  while (!next && next_step_ < steps_.size()) next = steps_[next_step_++](ranking, solids);
  if (next) next->bounds = bounds_, next->seed = seed_;
  if (next && ranking.is_as_asked()) next->most_faces = std::max(target_faces_, ranking.best().hull.mesh.face_count());
  return last_ = next;
}

/// Another way with the solid that was just tried.
std::optional<Candidate> Candidates::follow_up(const Ranking& ranking, const Solids& solids) const {
  if (is_worth_further(ranking)) return further(*ranking.last_kept(), last_->within);
  if (has_passed_coarser_levels(ranking)) return within(last_->solid, bounds_.max_distance, solids);
  // With few faces, a tight hull of the mesh may have less void than one of its gap's body.
  const bool is_body_of_mesh =
      last_->recipe.method == Method::TightOfGapBody && solids[last_->solid].source == Source::Mesh;
  const auto other = other_way(last_->recipe, request_);
  if (!other || !(is_body_of_mesh || ranking.last_failed())) return std::nullopt;
  Candidate next = *last_;
  next.recipe = *other;
  return next;
}

// A hull that moves away by a gap of more than its details passes through itself.
bool Candidates::is_small_gap(double spacing) const {
  constexpr double kSmallGap = 0.6;  // in spacings
  return request_.aim() < kSmallGap * spacing;
}

bool Candidates::keeps_clear(const Solid& solid) const {
  const bool moves_away_later = request_.is_outer() && !bounds_.any() && is_small_gap(solid.wrap_spacing);
  return (request_.is_padded() && !moves_away_later) || !request_.input.closed || solid.doors.face_count() > 0;
}

Candidate Candidates::of(SolidId id, const Solids& solids) const {
  Candidate candidate = moved(id);
  if (solids[id].source == Source::Mesh || request_.options.levels)
    candidate.recipe = {.method = Method::Levels};
  else if (keeps_clear(solids[id]))
    candidate.recipe.approach = Approach::Clear;
  return candidate;
}

Candidate Candidates::moved(SolidId id) const {
  const Method method = bounds_.any() ? Method::Levels : Method::InSteps;
  return {.solid = id, .target_faces = target_faces_, .recipe = {method, /*moves=*/true}};
}

// Where so few are asked for that not even tetrahedra around its parts would do, and something else may.
bool Candidates::has_too_many_parts(const Solid& solid) const {
  return request_.is_free() && !request_.options.levels && !bounds_.any() && 4 * solid.components > target_faces_;
}

/// The best hull is as asked for, and bounds ask for no more faces.
bool Candidates::has_few_faces(const Ranking& ranking) const {
  return ranking.is_as_asked() && ranking.best().hull.mesh.face_count() <= target_faces_;
}

// Where many parts overlap, the mesh's hull is several times larger than the others, if there is any. But it may be the
// only one that keeps a bound, unless a component is a tangle: of a crumpled sphere with 160 pairs for each face, it
// took minutes to find none. 200 tetrahedra with 107 have one.
bool Candidates::is_worth_the_mesh(const Solids& solids) const {
  constexpr std::size_t kMany = 120;
  constexpr std::size_t kTangle = 50;  // pairs for each face and component
  if (!solids.has_mesh() || has_too_many_parts(solids[0])) return false;
  const std::size_t most = bounds_.any() ? kTangle * solids[0].mesh.face_count() * solids[0].components : kMany;
  return !request_.is_free() || request_.options.levels || solids[0].self_intersections <= most;
}

void Candidates::plan_mesh() {
  steps_.push_back([this](const Ranking&, Solids& solids) -> std::optional<Candidate> {
    if (!is_worth_the_mesh(solids)) return std::nullopt;
    return of(0, solids);
  });
}

/// Levels do not move, and with padding or bounds the mesh has other candidates that do.
bool Candidates::may_move_mesh() const {
  return request_.is_outer() && !request_.is_bound_to_mesh() && !request_.is_padded() && !request_.options.levels &&
         !bounds_.any();
}

// A vertex stays where its collapse left it, outside of faces that later collapses replace. Moved to the triangles in
// the end, hulls of 22 clean meshes with 300 and 1,000 faces have 0.63 times the void in the median, in 1.9 times the
// time; of 90 robots' parts and these, none has more. Where there is little void, it is not worth the time, nor the
// levels.
void Candidates::plan_moved_mesh() {
  steps_.push_back([this](const Ranking& ranking, Solids&) -> std::optional<Candidate> {
    constexpr double kLittleVoid = 0.05;
    const bool is_of_mesh = ranking.has_certified() && ranking.best().hull.target_reached &&  // it may meet itself
                            ranking.best().hull.source == Source::Mesh;
    if (is_of_mesh ? std::abs(ranking.best_void()) <= kLittleVoid : request_.is_outer()) return std::nullopt;
    return moved(is_of_mesh ? ranking.best().hull.solid : 0);
  });
}

// Where the mesh's own hull leaves folds uncovered, as with many faces, or meets itself around them.
void Candidates::plan_unfolded_mesh() {
  steps_.push_back([this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
    if (ranking.is_empty() || (ranking.has_certified() && (bounds_.any() || ranking.is_clean()))) return std::nullopt;
    const auto id = solids.unfolded();
    return id ? std::optional(of(*id, solids)) : std::nullopt;
  });
}

bool Candidates::is_worth_a_search(const EnclosingHull& hull) const {
  return request_.is_outer() && !request_.is_padded() && !bounds_.any() && hull.mesh.face_count() <= kFewFaces;
}

// Of the mesh, if that is closed, and of the solid that has the best hull so far. That hull is kept if no tight one is
// better. With few faces and without padding, a hull of a wrap or of the convex hull is searched on from itself: of 33
// robots' parts at 100 faces whose tight hulls of the mesh or the wrap were no better, 33 have up to 3.8 % less volume.
// With bounds, no tight hull of a wrap was better than its levels, of 8 robots' parts and of soups; with padding, too,
// one of 77,000 faces that missed them took 12 s and was no nearer.
void Candidates::plan_tight() {
  const auto tight = [this](SolidId id, const Solids& solids) {
    const bool may_have_body = request_.is_padded() && !bounds_.any() && solids[id].source != Source::ConvexHull;
    return Candidate{
        .solid = id, .target_faces = target_faces_, .recipe = {may_have_body ? Method::TightOfGapBody : Method::Tight}};
  };
  steps_.push_back([=, this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
    if (!is_worth_the_mesh(solids)) return std::nullopt;
    const bool is_of_mesh = ranking.best().hull.source == Source::Mesh;  // with its folds, or without
    return tight(is_of_mesh ? ranking.best().hull.solid : 0, solids);
  });
  steps_.push_back([=, this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
    if (!ranking.has_certified()) return std::nullopt;
    const EnclosingHull& best = ranking.best().hull;
    if (best.source == Source::Mesh) return std::nullopt;
    if (is_worth_a_search(best)) {
      Candidate candidate{.solid = best.solid, .target_faces = target_faces_, .recipe = {Method::Searched}};
      candidate.start = best;
      return candidate;
    }
    const bool has_levels_that_moved = bounds_.any() && best.source == Source::Wrap;
    if ((!request_.is_padded() && is_worth_the_mesh(solids)) ||
        (has_levels_that_moved && (!request_.is_padded() || !best.within_bounds)))
      return std::nullopt;
    return tight(best.solid, solids);
  });
}

}  // namespace prohull
