#include <optional>
#include <utility>

#include "construct/tight/few_faces.h"
#include "construct/tight/gap_body.h"
#include "enclose/making.h"
#include "prohull/tight_hull.h"

namespace prohull {
namespace {

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
  if (!making.bounds().any()) return tight_of(mesh, wrapped, aim, making);
  return build_tight_hull_within(
      mesh, [&](const TriangleMesh& hull) { return excess_as_stored(hull, making) <= 1; }, making.hull_options(),
      wrapped, aim, making.candidate.most_faces);
}

EnclosingHull as_hull(TightHull tight) {
  EnclosingHull hull;
  hull.mesh = std::move(tight.mesh);
  hull.target_reached = tight.stopped == Stopped::TargetReached;
  hull.refusals = tight.refusals, hull.blocked = tight.blocked;
  hull.relaxed_guards = tight.relaxed_guards;
  return hull;
}

}  // namespace

EnclosingHull built_tight(const Making& making) { return as_hull(tight_of_solid(making)); }

EnclosingHull built_searched(const Making& making) {
  const EnclosingHull& start = *making.candidate.start;
  HullOptions options = making.hull_options();
  if (start.relaxed_guards > 0) options.guards = weaker(options.guards, kRelaxedGuards[start.relaxed_guards - 1]);
  EnclosingHull hull;
  hull.mesh = with_less_volume(start.mesh, Original::triangles(making.to_cover(), options.threads), options);
  hull.target_reached = start.target_reached;
  hull.refusals = start.refusals, hull.blocked = start.blocked;
  hull.relaxed_guards = start.relaxed_guards;
  return hull;
}

std::optional<EnclosingHull> built_tight_of_gap_body(const Making& making) {
  std::optional<TightHull> tight = tight_of_gap_body(making);
  return tight ? std::optional(as_hull(std::move(*tight))) : std::nullopt;
}

}  // namespace prohull
