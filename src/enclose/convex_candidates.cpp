#include <algorithm>

#include "enclose/candidates.h"

namespace prohull {

// Bounds that ask for no more faces shall not ask for more void.
Candidate Candidates::of_convex(SolidId id, const Ranking& ranking, const Solids& solids) const {
  Candidate candidate = of(id, solids);
  if (has_few_faces(ranking) && !request_.options.levels) candidate.recipe.method = Method::InSteps;
  return candidate;
}

// Of a mesh that is convex, such as a cylinder with vertices on its flat ends and along its sides, guards of the shape
// refuse collapses that add nothing: of 672 faces, 500 had a void of 0.3 %, where the 188 of the convex hull have none.
void Candidates::plan_convex_hull() {
  steps_.push_back([this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
    constexpr double kLittleVoid = 0.02, kNoVoid = 1e-6;
    constexpr std::size_t kMany = 100'000;  // the convex hull of more points may take as long as the hull
    const EnclosingOptions& options = request_.options;
    const bool keeps_guards = !options.hull.relax_guards || options.hull.guards != ShapeGuards{};
    const bool is_good = has_few_faces(ranking), is_near = is_good && ranking.slack() < kLittleVoid;
    if (options.levels || (is_good && options.keep_cavities) ||
        (is_near && (ranking.slack() <= kNoVoid || request_.is_padded() || keeps_guards ||
                     request_.to_cover().face_count() > kMany)))
      return std::nullopt;
    const auto too_large = is_good ? std::optional(ranking.best_volume()) : std::nullopt;
    const auto id = solids.convex_hull(too_large);
    if (!id || (too_large && solids[*id].volume >= *too_large) ||
        (is_near && solids[*id].mesh.face_count() > target_faces_))
      return std::nullopt;
    return of_convex(*id, ranking, solids);
  });
}

// What comes down to the faces asked for without bounds may keep them: of a gyroid, a hull of 60 faces that is nearer
// than the level of 90.
void Candidates::plan_convex_hull_in_steps() {
  steps_.push_back([this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
    if (has_few_faces(ranking) || !ranking.keeps_bounds() || ranking.best().hull.source != Source::ConvexHull)
      return std::nullopt;
    Candidate candidate = of(ranking.best().hull.solid, solids);
    candidate.recipe.method = Method::InSteps;
    return candidate;
  });
}

// With few faces, each has a large part in the volume, and collapses have too little choice: around a cube, the 10
// faces that they led to had a void of 466 %, where a polytope of 10 has one of 65 %. Of 75 files of robots and broken
// ones, hulls of 20, 30, 50 and 100 faces were smaller for 29, 27, 14 and 2.
void Candidates::plan_polytope() {
  steps_.push_back([this](const Ranking& ranking, Solids& solids) -> std::optional<Candidate> {
    constexpr std::size_t kFewest = 4;
    if (!is_worth_a_polytope(ranking, solids)) return std::nullopt;
    const auto id = solids.polytope(std::max(target_faces_, kFewest));
    return id ? std::optional(of_convex(*id, ranking, solids)) : std::nullopt;
  });
}

// Where the mesh's own hull has little void, no wrap does better, but a polytope may.
bool Candidates::is_worth_a_polytope(const Ranking& ranking, Solids& solids) const {
  constexpr std::size_t kFew = 50;
  constexpr double kLittleVoid = 0.03;
  if (ranking.is_of_flat()) return !ranking.is_near_flat();
  if (target_faces_ > kFew) return false;
  if (is_worth_a_wrap(ranking, solids, true)) return true;
  if (request_.options.keep_cavities || ranking.is_on_triangles() || ranking.slack() <= kLittleVoid) return false;
  const auto convex = solids.convex_hull(ranking.best_volume());
  return convex && solids[*convex].volume < ranking.best_volume();
}

}  // namespace prohull
