#pragma once

#include <optional>
#include <span>
#include <vector>

#include "prohull/progress.h"
#include "prohull/repair.h"
#include "robot/hulls/link_hulls.h"

namespace prohull::robot {

/// Decides what a hull proves, and measures it: `certified`, `proof`, `mesh` of pieces and balls, `volume`, distances
/// and `self_intersections`. It uses the coordinates of the hull and the finite triangles of the link, and shares
/// nothing with the construction: verify_hull or verify_union decides, for hulls of this run and for those of the
/// cache. A hull of a budget with padding has to keep LinkHull::padding as well.
///
/// `input` is the repaired geometry: LinkHull::distance counts from it, with the caps of its openings. Throws
/// InputError if the hull is no solid; Cancelled.
void judge(LinkHull& hull, const TriangleMesh& triangles, const RepairedMesh& input, const Budget& budget,
           const Progress& go_on);

/// Of what lies inside of the repaired geometry, in cubic metres: LinkHulls::sealed_volume. 0 if nothing does, or if it
/// can only be estimated and the estimate is larger than one of the judged hulls. Throws Cancelled.
double sealed_volume(const RepairedMesh& input, std::span<const LinkHull> hulls, const Progress& go_on);

/// What is left of a proposal: all hulls, judged; nullopt if one of them is not as the budget asks, is not certified,
/// or is not within the bounds that its construction claims. `float32` says that files keep coordinates in single
/// precision.
std::optional<std::vector<LinkHull>> verified(std::vector<LinkHull> proposal, const TriangleMesh& triangles,
                                              const RepairedMesh& input, const Budget& budget, bool float32,
                                              const Progress& go_on);

}  // namespace prohull::robot
