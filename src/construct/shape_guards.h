#pragma once

#include <optional>

#include "construct/star.h"
#include "prohull/hull_builder.h"

namespace prohull {

/// The two tests of P&T 3.1.4 on the faces that a collapse to `apex` (local) would make.
std::optional<Refusal> refused_shape(const Star& star, const Vec3& apex, const HullOptions& options);

}  // namespace prohull
