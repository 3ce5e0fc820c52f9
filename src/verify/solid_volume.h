#pragma once

#include "prohull/detail/progress_meter.h"
#include "verify/self_intersection.h"
#include "verify/surface.h"

namespace prohull::verify {

/// The volume of all points that a closed mesh winds around at least once: parts that overlap count once, and folds
/// that are inside out not at all. Which pieces of the surface bound it is decided exactly; their sum is rounded. NaN
/// where faces intersect so often that it would take long, in 100,000 pieces.
double solid_volume(const TriangleMesh& mesh, ProgressMeter& meter);

/// The same, if its self_intersections are known.
double solid_volume(const Surface& surface, const FacePairs& pairs, ProgressMeter& meter);

}  // namespace prohull::verify
