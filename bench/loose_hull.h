#pragma once

#include <optional>

#include "construct/star.h"
#include "prohull/hull_builder.h"

namespace prohull::bench {

/// Where a collapse puts its vertex, in the star's own frame: outside of all planes of the star, by `margin` at least.
/// Nothing if the rule finds no such place.
using PlacementRule = std::optional<Vec3> (*)(const Star& star, double margin);

/// P&T 3.1.2: the place that adds the least volume.
std::optional<Vec3> by_linear_program(const Star& star, double margin);

// Looser rules, of the kind that P&T section 5 has in mind. They move a point along the mean normal of the star to the
// first place that is outside of all planes.
std::optional<Vec3> lifted_midpoint(const Star& star, double margin);  ///< that of the edge
std::optional<Vec3> lifted_center(const Star& star, double margin);    ///< the mean of the link
/// Of both and the two ends of the edge, lifted, that which adds the least volume.
std::optional<Vec3> best_lifted(const Star& star, double margin);

/// The hull of the paper's first or second strategy, built as P&T 3.1 has it, with a heap, but for the rule. It is
/// here, beside the construction of the library, because the library has no use for looser rules. The volume added
/// where the rule puts the vertex is the priority of the first strategy. Requires the mesh that build_hull requires.
ProgressiveHull loose_hull(const TriangleMesh& mesh, Strategy strategy, PlacementRule rule, std::size_t target_faces);

}  // namespace prohull::bench
