#include <optional>
#include <utility>

#include "enclose/making.h"
#include "prohull/detail/stopwatch.h"

namespace prohull {
namespace {

std::optional<EnclosingHull> built(const Making& making) {
  switch (making.recipe().method) {
    case Method::Levels:
      return built_of_levels(making);
    case Method::Within:
      return built_within(making);
    case Method::InSteps:
      return built_in_steps(making);
    case Method::Early:
      return built_early(making);
    case Method::Tight:
      return built_tight(making);
    case Method::Searched:
      return built_searched(making);
    case Method::Further:
      return built_further(making);
    default:
      return built_tight_of_gap_body(making);
  }
}

}  // namespace

std::optional<Recipe> other_way(Recipe recipe, const Request& request) {
  if (recipe.method == Method::TightOfGapBody)
    recipe.method = Method::Tight;
  else if (recipe.moves && recipe.method != Method::Early && recipe.approach == Approach::Touching &&
           request.is_outer())
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
      made.hull.verdict.certified ? made.hull.verdict.self_intersections : count_self_intersections(made.hull.mesh);
  if (stored && candidate.bounds.any()) measure(made, candidate.bounds, request, solids);
  made.hull.verify_seconds = verifying.seconds();
  return made;
}

void measure(Attempt& made, const HullBounds& bounds, const Request& request, Solids& solids) {
  made.hull.excess = verified_excess_of(made.hull, bounds, {made.candidate, request, solids});
  made.hull.within_bounds = made.hull.excess <= 1;
}

}  // namespace prohull
