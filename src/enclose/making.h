#pragma once

#include <optional>
#include <string>
#include <utility>

#include "construct/growth.h"
#include "enclose/candidate.h"
#include "prohull/detail/float32_hull.h"

namespace prohull {

constexpr unsigned kRoundsAtTheEnd = 6;  ///< of moving

/// One candidate on its way: what it is, and what it is built with.
struct Making {
  const Candidate& candidate;
  const Request& request;
  Solids& solids;

  const Recipe& recipe() const { return candidate.recipe; }
  const HullBounds& bounds() const { return candidate.bounds; }
  const EnclosingOptions& options() const { return request.options; }
  const Solid& solid() const { return solids[candidate.solid]; }
  const TriangleMesh& to_cover() const { return solids.to_cover(candidate.solid); }
  HullOptions hull_options() const { return request.hull_options(candidate.target_faces, candidate.seed); }
};

/// With the coordinates that a file keeps, or why it has none. A hull of a mesh that intersects itself may have no room
/// for its vertices: the certificate decides, and lifting may help.
std::pair<std::optional<Float32Hull>, std::string> as_stored(const TriangleMesh& hull, const Making& making);

/// HullBounds::excess. Overlaps of the hull count once, where that makes a difference.
double excess_of(const TriangleMesh& hull, const Making& making);
/// The same of other bounds, and of the volume that the verdict has.
double verified_excess_of(const EnclosingHull& hull, const HullBounds& bounds, const Making& making);
/// The same of a hull that is moved away by the padding when it is done, if it is one of the mesh: it gains about its
/// area times the padding. Wraps keep the padding themselves.
double excess_when_padded(const TriangleMesh& hull, const Making& making);
/// With the coordinates that a file keeps; infinite if it has none.
double excess_as_stored(const TriangleMesh& hull, const Making& making);

constexpr double kNearerByMoving = 4;  ///< by moving, a hull comes so much nearer than its wrap

/// Moving takes 0.1 to 0.4 ms for each face, most of it in soups.
inline bool is_small(std::size_t faces) { return faces <= 16'000; }

/// Moved towards the triangles; in few rounds, where they are few beside its faces.
TriangleMesh placed(const TriangleMesh& level, const Making& making);
TriangleMesh placed(const TriangleMesh& level, const Making& making, unsigned max_rounds,
                    const MayReach& may_reach = {});

// One for each method.
EnclosingHull built_of_levels(const Making& making);
EnclosingHull built_in_steps(const Making& making);
/// How far a hull reaches out of the triangles at most, by a short search.
double short_bound_of_reach(const TriangleMesh& hull, const TriangleMesh& triangles);
/// None if it has more faces than asked for, or reaches out farther than it may.
std::optional<EnclosingHull> built_early(const Making& making);
EnclosingHull built_within(const Making& making);
EnclosingHull built_further(const Making& making);
EnclosingHull built_tight(const Making& making);
EnclosingHull built_searched(const Making& making);
/// None if the gap's body of the solid intersects itself.
std::optional<EnclosingHull> built_tight_of_gap_body(const Making& making);

}  // namespace prohull
