#include "enclose/candidate.h"

#include <iterator>
#include <optional>
#include <utility>

#include "construct/turned.h"
#include "enclose/folds.h"
#include "prohull/detail/replay.h"
#include "prohull/detail/summary.h"
#include "prohull/enclosure.h"
#include "prohull/padded_hull.h"
#include "prohull/tight_hull.h"
#include "verify/gap.h"

namespace prohull {
namespace {

bool covers(const TriangleMesh& hull, const TriangleMesh& triangles, const Progress& progress) {
  if (triangles.face_count() == 0) return true;
  return verify_cover(triangles, hull, {.max_offenders = 0, .most_outside = 0, .progress = progress}).encloses;
}

/// Stops where more faces than so many lie outside.
Verification verdict_of(const TriangleMesh& hull, const Request& request, Solids& solids, std::size_t most_outside,
                        double gap) {
  return of_file(verify::verify_hull(hull, solids.original(), request.options.hull.side,
                                     {.gap = gap,
                                      .max_offenders = most_outside,
                                      .most_outside = most_outside,
                                      .progress = request.options.progress}),
                 request.input);
}

/// The triangles of the input that the verdict names; with a cap, all caps: only faces of the file have numbers.
TriangleMesh outside_of(const Verification& verdict, const RepairedMesh& input) {
  TriangleMesh outside{input.original.positions, {}};
  bool has_cap = false;
  for (const Offender& o : verdict.worst)
    if (index(o.face) < input.original.face_count())
      outside.triangles.push_back(input.original.triangles[o.face]);
    else
      has_cap = true;
  if (has_cap) append(outside, input.caps);
  return outside;
}

bool encloses_mesh(EnclosingHull& hull, const Solid& solid, const Request& request, Solids& solids) {
  constexpr std::size_t kMostProtrusions = 200;
  const EnclosingOptions& options = request.options;
  const double gap = hull.padding > 0 ? options.padding : 0;
  const bool may_lift = request.input.closed && request.is_outer() && solid.source == Source::Mesh && !options.levels &&
                        hull.padding == 0;
  hull.verdict = verdict_of(hull.mesh, request, solids, may_lift ? kMostProtrusions : 0, gap);
  if (hull.verdict.certified || !may_lift) return hull.verdict.certified;
  if (hull.verdict.worst.size() < hull.verdict.faces_outside) return false;
  auto lifted = lifted_until_covered(hull.mesh, outside_of(hull.verdict, request.input), hull.verdict.worst,
                                     request.hull_options(hull.target_faces, request.options.hull.seed));
  if (!lifted) return false;
  hull.mesh = std::move(*lifted);
  hull.levels.reset();
  hull.verdict = verdict_of(hull.mesh, request, solids, 0, gap);
  return hull.verdict.certified;
}

// The splits of a progressive hull, replayed, lead from its base mesh to the solid. Of a hull that was rounded to
// float32, the base mesh is another one, which has to hold as well: levels may be saved. The doors of a wrap have to be
// covered too.
bool is_proven(EnclosingHull& hull, const Solid& solid, const Request& request, Solids& solids) {
  const Progress& progress = request.options.progress;
  const bool is_base = hull.levels && hull.mesh == hull.levels->base();
  std::optional<Verification> of_levels;
  if (hull.levels && solid.source == Source::Mesh)
    of_levels = verify::verify_hull(*hull.levels, solids.original(),
                                    {.max_offenders = 0, .most_outside = 0, .progress = progress});
  const bool are_proven = of_levels && of_levels->encloses;
  if (hull.levels && !are_proven) {
    if (!verify_replay(*hull.levels, solid.mesh, progress).holds) return false;
    const bool base_holds = is_base || verdict_of(hull.levels->base(), request, solids, 0, 0).encloses;
    if (!base_holds && request.options.levels) return false;
    if (!base_holds) hull.levels.reset();
  }
  if (are_proven && is_base)
    hull.verdict = of_file(std::move(*of_levels), request.input);
  else if (!encloses_mesh(hull, solid, request, solids))
    return false;
  return !request.is_outer() || (covers(hull.mesh, solid.doors, progress) &&
                                 (request.input.closed || covers(hull.mesh, request.input.caps, progress)));
}

void certify_as_it_is(EnclosingHull& hull, const Solid& solid, const Request& request, Solids& solids) {
  hull.certified = is_proven(hull, solid, request, solids);
}

// What is missing is added, and measured again; twice of it after the first time, as faces turn when they move, and
// then four times. The distances propose only: verify_gap decides.
void keep_away(EnclosingHull& hull, const Request& request, Solids& solids) {
  constexpr double kOfWhatIsMissing[]{1, 2, 2, 4, 4, 4};
  constexpr unsigned kMostRounds = 6;
  const double padding = request.options.padding;
  const bool is_float32 = request.options.hull.float32_coordinates;
  const TriangleMesh before = hull.mesh;
  double added = 0;
  for (std::size_t i = 0;; ++i) {
    hull.padding = solids.distance_from(hull.mesh, hull.solid);
    if (hull.padding >= padding || (i > 0 && hull.padding == 0) || i == std::size(kOfWhatIsMissing)) break;
    added += kOfWhatIsMissing[i] * (request.aim() - hull.padding);
    hull.mesh = request.is_outer() ? padded_hull(before, added, is_float32).mesh
                                   : turned(padded_hull(turned(before), added, is_float32).mesh);
  }
  // Where the solid is thin, the faces of an inner hull have passed through each other.
  if (!request.is_outer() && count_self_intersections(hull.mesh) > 0) hull.padding = 0;
  if (added == 0 || hull.padding < padding) return;
  TriangleMesh moved = moved_towards(hull.mesh, solids.to_cover(hull.solid), request.move_options(kMostRounds));
  if (const double distance = solids.distance_from(moved, hull.solid); distance >= padding)
    hull.mesh = std::move(moved), hull.padding = distance;
}

// Why the distance suffices: a point nearer to the triangles than their distance from the surface is joined to a
// triangle by a segment that does not meet the surface. So the hull winds around it as often as around the triangle,
// which it covers: at least once. Points inside of the triangles are enclosed.
void certify_with_padding(Attempt& attempt, const Solid& solid, const Request& request, Solids& solids) {
  EnclosingHull& hull = attempt.hull;
  const double padding = request.options.padding;
  if (solid.source == Source::Mesh) {
    certify_as_it_is(hull, solid, request, solids);  // also lifts it over what sticks out
    if (!hull.certified) return;
    attempt.void_before_padding = signed_volume(hull.mesh) / solids.volume(attempt.candidate.target_faces) - 1;
  }
  hull.certified = false;
  keep_away(hull, request, solids);
  if (hull.padding < padding) return;
  hull.padding = verify::verify_gap(hull.mesh, solids.to_cover(hull.solid), padding, {}).proven_distance;
  if (hull.padding < padding) return;
  hull.levels.reset();
  certify_as_it_is(hull, solid, request, solids);
  if (hull.certified) hull.verdict.proof = "padding", hull.verdict.gap = hull.padding;
  // One that keeps clear all along does not pass through itself, and comes next.
  const bool has_other_way = solid.source == Source::Wrap && other_way(attempt.candidate.recipe, request).has_value();
  if (has_other_way && hull.verdict.self_intersections > 0) hull.certified = false;
}

}  // namespace

void certify(Attempt& attempt, const Request& request, Solids& solids) {
  const Solid& solid = solids[attempt.hull.solid];
  if (request.is_padded())
    certify_with_padding(attempt, solid, request, solids);
  else
    certify_as_it_is(attempt.hull, solid, request, solids);
}

}  // namespace prohull
