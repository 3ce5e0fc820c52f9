#include "enclose/making.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "mesh/area.h"
#include "prohull/error.h"
#include "prohull/tight_hull.h"

namespace prohull {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

/// What the volumes of hulls are compared with; 0 where nothing is inside, or nothing is known of it yet.
double original_volume(const Making& making) { return making.solids.verified_volume(making.candidate.target_faces); }

/// Of one that is built from a mesh that intersects itself, overlaps are looked at where they may decide.
double enclosed_volume(const TriangleMesh& hull, const HullBounds& bounds, double volume, const Making& making) {
  const double with_overlaps = signed_volume(hull);
  const bool is_enough = making.request.is_outer() && with_overlaps <= (1 + bounds.max_void_ratio) * volume &&
                         with_overlaps <= volume + bounds.max_added_volume;
  if (making.solid().self_intersections == 0 || !bounds.any_of_volume() || is_enough) return with_overlaps;
  return solid_volume(hull, making.options().progress).value_or(with_overlaps);
}

double excess_of(const HullBounds& bounds, const TriangleMesh& hull, double hull_volume, double volume,
                 const Making& making) {
  const Solid& solid = making.solid();
  // What lies around folds is not of the mesh.
  const bool is_near_solid = solid.source == Source::Mesh && solid.folds.faces == 0;
  return bounds.excess(hull, hull_volume, is_near_solid ? solid.mesh : making.to_cover(), volume,
                       making.options().progress);
}

}  // namespace

std::pair<std::optional<Float32Hull>, std::string> as_stored(const TriangleMesh& hull, const Making& making) {
  if (!making.options().hull.float32_coordinates) return {Float32Hull{hull, 0}, {}};
  try {
    const bool may_lift = making.solid().self_intersections > 0;
    return {with_float32_coordinates(hull, making.options().hull.side, may_lift ? NoRoom::Round : NoRoom::Refuse), {}};
  } catch (const InputError& error) {
    return {std::nullopt, error.what()};
  }
}

double excess_of(const TriangleMesh& hull, const Making& making) {
  const double volume = original_volume(making);
  return excess_of(making.bounds(), hull, enclosed_volume(hull, making.bounds(), volume, making), volume, making);
}

double verified_excess_of(const EnclosingHull& hull, const HullBounds& bounds, const Making& making) {
  return excess_of(bounds, hull.mesh, volume_of(hull), original_volume(making), making);
}

double excess_when_padded(const TriangleMesh& hull, const Making& making) {
  const double padding = making.options().padding;
  if (padding == 0 || making.solid().source != Source::Mesh) return excess_of(hull, making);
  const double volume = original_volume(making), gain = padding * area_of(hull);
  HullBounds left = making.bounds();
  left.max_distance -= padding;
  left.max_added_volume = std::min(left.max_added_volume, std::exchange(left.max_void_ratio, kNoBound) * volume);
  const double most = making.request.is_outer() ? volume - gain : volume + gain;
  return excess_of(left, hull, enclosed_volume(hull, left, most, making), most, making);
}

double excess_as_stored(const TriangleMesh& hull, const Making& making) {
  const auto [stored, why_not] = as_stored(hull, making);
  return stored ? excess_when_padded(stored->mesh, making) : std::numeric_limits<double>::infinity();
}

TriangleMesh placed(const TriangleMesh& level, const Making& making) {
  // That move in all rounds. Of 57,806 faces around 19 triangles, one round took 7 s and six 18 s; they were as near
  // then, with 1.6 times the void.
  constexpr double kLeast = 16'000, kPerTriangle = 100;
  const double most = std::max(kLeast, kPerTriangle * double(making.to_cover().face_count()));
  const double rounds = kRoundsAtTheEnd * most / double(level.face_count());
  return placed(level, making, static_cast<unsigned>(std::clamp(rounds, 1.0, double(kRoundsAtTheEnd))));
}

TriangleMesh placed(const TriangleMesh& level, const Making& making, unsigned max_rounds, const MayReach& may_reach) {
  const MoveOptions how = making.request.move_options(max_rounds);
  return making.recipe().approach == Approach::Touching
             ? moved_towards_closed(level, making.request.input.closed->mesh, how.side, how, may_reach)
             : moved_towards(level, making.to_cover(), how, may_reach);
}

}  // namespace prohull
