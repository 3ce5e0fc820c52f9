#pragma once

#include <optional>

#include "parallel/progress_meter.h"
#include "prohull/triangle_mesh.h"

namespace prohull::verify {

/// The volume of all points that a closed mesh winds around at least once: parts that overlap count once, and folds
/// that are inside out not at all. Which pieces of the surface bound it is decided exactly; their sum is rounded. NaN
/// where faces intersect so often that it would take long, in 100,000 pieces. `bounds_one` is what bounds_one_solid
/// says, if that is known.
double solid_volume(const TriangleMesh& mesh, ProgressMeter& meter, std::optional<bool> bounds_one = std::nullopt);

}  // namespace prohull::verify
