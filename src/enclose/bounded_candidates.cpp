#include <cmath>

#include "enclose/candidates.h"

namespace prohull {

Candidate Candidates::within(SolidId id, double max_distance, const Solids& solids) const {
  const bool moves = solids[id].source == Source::Wrap;  // it has less void then
  return {.solid = id,
          .target_faces = target_faces_,
          .recipe = {Method::Within, moves, Approach::Clear},
          .within = max_distance};
}

/// Collapses can keep what is asked for.
bool Candidates::may_stay_within() const {
  const double max_distance = bounds_.max_distance;
  return max_distance > 0 && std::isfinite(max_distance) && !request_.is_bound_to_mesh() && !request_.is_padded() &&
         !request_.options.levels;
}

/// A hull that keeps what is asked for may move, and have further collapses.
bool Candidates::may_go_further() const {
  return bounds_.any() && !(bounds_.max_distance <= 0) && !request_.is_bound_to_mesh() && !request_.is_padded() &&
         !request_.options.levels;
}

// A level has the same priority everywhere. At 0.3 % of the diagonal, two robots' parts have 32 and 13 % fewer faces
// where each collapse keeps the bound by itself; at 3 %, levels may have fewer.
void Candidates::plan_within_of_mesh() {
  steps_.push_back([this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
    if (!is_worth_the_mesh(solids) || has_few_faces(ranking)) return std::nullopt;
    const SolidId id = ranking.has_certified() ? ranking.best().hull.solid : 0;
    return within(id, bounds_.max_distance, solids);
  });
}

// Of 16 robots' parts at 0.3, 1 and 3 % of the diagonal, 41 hulls of 43 have fewer faces, 0.72 times as many in the
// median, and a wheel 644 for 2,988; builds take 1.09 times as long in the median, 1.25 times at 0.3 %.
// Within bounds of the void, a wheel has 248 faces for 316, and a screwdriver 118 for 192.
void Candidates::plan_further() {
  steps_.push_back([this](const Ranking& ranking, Solids&) -> std::optional<Candidate> {
    if (!ranking.keeps_bounds() || has_few_faces(ranking) || ranking.best().candidate.recipe.method == Method::Further)
      return std::nullopt;
    return further(ranking.best().hull, ranking.best().candidate.within);
  });
}

Candidate Candidates::further(const EnclosingHull& hull, double within) const {
  const bool may_touch = hull.source == Source::Mesh || !request_.is_outer();
  Candidate candidate{.solid = hull.solid,
                      .target_faces = target_faces_,
                      .recipe = {Method::Further, /*moves=*/true, may_touch ? Approach::Touching : Approach::Clear}};
  candidate.start = hull, candidate.within = within;
  return candidate;
}

/// Hulls are compared with what further collapses make of them: down to a fourth of a wrap's faces. Those of the mesh
/// are about as good as each other before, and the better one has them.
bool Candidates::is_worth_further(const Ranking& ranking) const {
  constexpr std::size_t kMostReduced = 4;
  const EnclosingHull* const last = ranking.last_kept();
  return last && may_go_further() && last_->recipe.method != Method::Further &&
         (last->source != Source::Mesh || last_->recipe.moves || last_->recipe.method == Method::Tight) &&
         last->mesh.face_count() > target_faces_ &&
         last->mesh.face_count() <= kMostReduced * ranking.best().hull.mesh.face_count();
}

/// The level of a wrap kept the bounds by far, so that coarser ones, which go up and down, do not: a finger at 3 % of
/// the diagonal had one of 1,860 faces at 0.53 of the bound, and 496 in the end. Within the bound, the wrap has 258.
bool Candidates::has_passed_coarser_levels(const Ranking& ranking) const {
  constexpr double kByFar = 0.7;
  return ranking.last_kept() && last_->recipe.method == Method::Further && may_stay_within() &&
         last_->start->source == Source::Wrap && last_->within == 0 && last_->start->excess < kByFar;
}

// Where the coarsest level that would keep the bounds cannot move away by the gap: finer ones pass through themselves
// less.
void Candidates::plan_finer_levels() {
  constexpr std::size_t kMostMoved = 16'000;  // to move away takes most of the time
  for (const std::size_t part : {4, 2, 1})
    steps_.push_back([=, this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
      if (ranking.is_empty() || ranking.keeps_bounds() || !is_worth_the_mesh(solids)) return std::nullopt;
      Candidate candidate = of(0, solids);
      candidate.least_faces = solids[0].mesh.face_count() / part;
      const bool is_finer = candidate.least_faces > ranking.best().hull.mesh.face_count();
      return is_finer && candidate.least_faces <= kMostMoved ? std::optional(candidate) : std::nullopt;
    });
}

}  // namespace prohull
