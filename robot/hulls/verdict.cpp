#include "robot/hulls/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "prohull/detail/rounded.h"
#include "prohull/error.h"
#include "prohull/union_verification.h"
#include "prohull/verification.h"
#include "robot/form_measures.h"

namespace prohull::robot {
namespace {

/// The solid, or the triangles if they bound none.
const TriangleMesh& solid_of(const RepairedMesh& input) { return input.closed ? input.closed->mesh : input.original; }

/// `sealed` are the triangles with what closes their openings; `distance_from` measures from one of the two.
template <class Measure>
void measure_distances(LinkHull& hull, const TriangleMesh& sealed, const RepairedMesh& input, std::size_t cap_faces,
                       Measure distance_from) {
  DistanceBounds from_sealed = distance_from(sealed);
  const DistanceBounds from_triangles = cap_faces > 0 ? distance_from(input.original) : from_sealed;
  from_sealed.upper = std::min(from_sealed.upper, from_triangles.upper);  // the sealed has these
  hull.verdict.cap_faces = cap_faces;
  hull.verdict.distance_to_triangles = from_triangles;
  if (input.closed || cap_faces > 0) hull.verdict.distance_to_solid = from_sealed;
}

/// A reach counts the caps of a solid only.
template <class Parts>
void measure_reaches(LinkHull& hull, const Parts& parts, const JudgedGeometry& geometry, const Progress& go_on) {
  const RepairedMesh& input = geometry.input;
  measure_distances(hull, solid_of(input), input, input.closed ? input.caps.face_count() : 0,
                    [&](const TriangleMesh& from) {
                      const DistanceBounds reach = union_reach(parts, from, {.progress = go_on});
                      return from_forms(reach, geometry.curved.around, is_closed(from));
                    });
}

void judge_hull(LinkHull& hull, const JudgedGeometry& geometry, const Budget& budget, const Progress& go_on) {
  const RepairedMesh& input = geometry.input;
  const double gap = budget.padding > 0 ? hull.padding : 0;
  const Verification found = verify_hull(hull.mesh, geometry.triangles, HullSide::Outer,
                                         {.gap = gap, .finite_only = true, .max_offenders = 0, .progress = go_on});
  hull.verdict = found;
  hull.verdict.certified = found.certified && hull.padding >= budget.padding;
  if (budget.padding > 0) hull.verdict.proof = "padding";
  hull.volume = found.hull_volume;
  hull.self_intersections = found.self_intersections;
  TriangleMesh sealed = solid_of(input);
  if (!input.closed) append(sealed, input.caps);
  const double around = geometry.curved.around;
  const DistanceOptions how{.decides = distance_left(budget, around).value_or(0), .progress = go_on};
  measure_distances(hull, sealed, input, input.caps.face_count(), [&](const TriangleMesh& from) {
    return from_forms(distance_bounds(hull.mesh, from, how), around, hull.certified());
  });
  if (budget.max_distance > 0 && hull.within_bounds && hull.verdict.distance().upper > budget.max_distance)
    hull.notes.emplace_back("keeps the largest distance only if the openings that its wrap closed count as closed");
}

void judge_pieces(LinkHull& hull, const JudgedGeometry& geometry, const Progress& go_on) {
  const UnionVerification found =
      verify_union(hull.pieces, geometry.triangles, {.finite_only = true, .max_offenders = 1, .progress = go_on});
  hull.mesh = mesh_of(hull.pieces, {});
  hull.volume = found.union_volume;
  hull.verdict = found;
  measure_reaches(hull, hull.pieces, geometry, go_on);
}

void judge_balls(LinkHull& hull, const JudgedGeometry& geometry, const Progress& go_on) {
  hull.verdict =
      verify_union(hull.balls, geometry.triangles, false, {.finite_only = true, .max_offenders = 1, .progress = go_on});
  hull.mesh = mesh_of({}, hull.balls);
  hull.volume = union_volume(hull.balls);
  measure_reaches(hull, hull.balls, geometry, go_on);
}

/// Whether a hull is of the kind and of the size that the budget asks for, with float32 coordinates.
bool is_as_asked(const LinkHull& hull, const Budget& budget) {
  switch (budget.collision) {
    case Collision::Hull:
      return hull.pieces.empty() && hull.balls.empty() && keeps_float32(hull.mesh) &&
             (!hull.target_reached || budget.max_distance > 0 || hull.mesh.face_count() <= hull.target_faces);
    case Collision::Convex:
      return !hull.pieces.empty() && hull.pieces.size() <= budget.pieces && hull.balls.empty() &&
             std::ranges::all_of(hull.pieces, [&](const TriangleMesh& piece) {
               return keeps_float32(piece) && piece.vertex_count() <= budget.vertices && signed_volume(piece) >= 0;
             });
    case Collision::Spheres:
      return !hull.balls.empty() && hull.balls.size() <= budget.spheres && hull.pieces.empty() &&
             std::ranges::all_of(hull.balls, [](const Ball& ball) { return ball.radius > 0; });
  }
  return false;
}

bool is_within_bounds(const LinkHull& hull, const Budget& budget) {
  return budget.max_distance == 0 || hull.verdict.distance().upper <= budget.max_distance;
}

std::vector<std::size_t> targets_of(const Budget& budget) {
  return budget.collision == Collision::Hull ? budget.faces : std::vector<std::size_t>{0};
}

}  // namespace

std::optional<double> distance_left(const Budget& budget, double around) {
  double left = budget.max_distance - around;
  while (left > budget.padding && left + around > budget.max_distance) left = std::nextafter(left, 0.0);
  return left > budget.padding ? std::optional(left) : std::nullopt;
}

void judge(LinkHull& hull, const JudgedGeometry& geometry, const Budget& budget, const Progress& go_on) {
  if (budget.max_distance > 0 && !distance_left(budget, geometry.curved.around)) {
    hull.within_bounds = false;
    hull.notes.push_back(fmt::format(
        "keeps no largest distance: the meshes around its curved shapes reach out of them by up to {:.3g} mm",
        1000 * rounded_up(geometry.curved.around, 3)));
  }
  switch (budget.collision) {
    case Collision::Hull:
      judge_hull(hull, geometry, budget, go_on);
      break;
    case Collision::Convex:
      judge_pieces(hull, geometry, go_on);
      break;
    case Collision::Spheres:
      judge_balls(hull, geometry, go_on);
      break;
  }
}

InsideVolume sealed_volume(const JudgedGeometry& geometry, std::span<const LinkHull> hulls, const Progress& go_on) {
  const SolidPieces& parts = geometry.curved.parts;
  const RepairedMesh& input = geometry.input;
  const InsideVolume inside = !parts.empty()                         ? volume_of(parts, go_on)
                              : input.repairs.dropped_components > 0 ? volume_inside(input.closed->mesh, go_on)
                                                                     : volume_inside(input, go_on);
  const auto encloses = [&](const LinkHull& hull) { return hull.volume >= inside.volume; };
  const bool may_be = !inside.is_estimated || std::ranges::all_of(hulls, encloses);
  return {may_be ? inside.volume : 0, inside.is_estimated};
}

std::optional<std::vector<LinkHull>> verified(std::vector<LinkHull> proposal, const JudgedGeometry& geometry,
                                              const Budget& budget, const Progress& go_on) {
  if (!std::ranges::equal(proposal, targets_of(budget), {}, &LinkHull::target_faces)) return std::nullopt;
  for (LinkHull& hull : proposal) {
    if (!is_as_asked(hull, budget)) return std::nullopt;
    try {
      judge(hull, geometry, budget, go_on);
    } catch (const InputError&) {  // it bounds no solid
      return std::nullopt;
    }
    const bool is_convex = !std::isnan(hull.volume);  // as verify_union says of pieces
    if (!hull.certified() || !is_convex || (hull.within_bounds && !is_within_bounds(hull, budget))) return std::nullopt;
  }
  return proposal;
}

}  // namespace prohull::robot
