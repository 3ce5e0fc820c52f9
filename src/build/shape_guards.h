#pragma once

#include <optional>

#include "build/star.h"
#include "prohull/hull_builder.h"

namespace prohull {

/// 4 sqrt(3) area / (sum of the squared edges), 1 for an equilateral triangle (Gueziec 1999); the area is given
/// doubled.
double compactness(double double_area, double squared_edges);

/// The two tests of P&T 3.1.4 on the faces that a collapse to `apex` (local) would make.
std::optional<Refusal> refused_shape(const Star& star, const Vec3& apex, const HullOptions& options);

}  // namespace prohull
