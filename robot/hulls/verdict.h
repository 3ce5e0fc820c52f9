#pragma once

#include <optional>
#include <span>
#include <vector>

#include "prohull/closed_solid.h"
#include "prohull/progress.h"
#include "prohull/repair.h"
#include "robot/hulls/link_hulls.h"
#include "robot/link_triangles.h"

namespace prohull::robot {

/// The geometry of a link that hulls are judged by.
struct JudgedGeometry {
  const TriangleMesh& triangles;
  const RepairedMesh& input;  ///< the triangles, repaired
  const CurvedParts& curved;  ///< of the forms around which `triangles` has meshes
};

/// The largest distance that hulls may have from the meshes around curved forms, so that they keep that of the budget,
/// which has one, from the forms themselves. nullopt if nothing is left for them.
std::optional<double> distance_left(const Budget& budget, double around);

/// Decides what a hull proves, and measures it: `verdict`, `mesh` of pieces and balls, `volume` and
/// `self_intersections`. It uses the coordinates of the hull and the finite triangles of the link, and shares
/// nothing with the construction: verify_hull or verify_union decides, for hulls of this run and for those of the
/// cache. A hull of a budget with padding has to keep LinkHull::padding as well.
///
/// The distance from the solid counts from the repaired geometry, with the caps of its openings, and from curved forms
/// themselves. Where no distance_left is, the hull is not `within_bounds`. Throws InputError if the hull is no solid;
/// Cancelled.
void judge(LinkHull& hull, const JudgedGeometry& geometry, const Budget& budget, const Progress& go_on);

/// LinkHulls::sealed_volume and is_estimated: the volume inside of the repaired geometry and of curved forms, in cubic
/// metres. 0 if nothing does, or if it can only be estimated and the estimate is larger than one of the judged hulls.
/// Throws Cancelled.
InsideVolume sealed_volume(const JudgedGeometry& geometry, std::span<const LinkHull> hulls, const Progress& go_on);

/// What is left of a proposal: all hulls, judged; nullopt if one of them is not as the budget asks, is not certified,
/// has other coordinates than float32, or is not within the bounds that its construction claims.
std::optional<std::vector<LinkHull>> verified(std::vector<LinkHull> proposal, const JudgedGeometry& geometry,
                                              const Budget& budget, const Progress& go_on);

}  // namespace prohull::robot
