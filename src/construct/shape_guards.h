#pragma once

#include <optional>

#include "construct/star.h"
#include "prohull/hull_builder.h"

namespace prohull {

/// What is left of an overhang, relative to the diagonal of `box`, where so much relative to that of `of` is allowed:
/// for a hull that is simplified in steps, of which each measures from the box of the step before.
double overhang_left(const Box& box, const Box& of, double max_overhang);

/// The two tests of P&T 3.1.4 on the faces that a collapse to `apex` (local) would make.
std::optional<Refusal> refused_shape(const Star& star, const Vec3& apex, const HullOptions& options);

/// The same where a vertex of the link moves too, as another collapse follows: link[moved] goes to `to` (local), or
/// into the apex, so that its two faces vanish.
std::optional<Refusal> refused_shape(const Star& star, const Vec3& apex, const HullOptions& options, std::size_t moved,
                                     const std::optional<Vec3>& to);

}  // namespace prohull
