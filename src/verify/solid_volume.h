#pragma once

#include <optional>
#include <vector>

#include "prohull/detail/progress_meter.h"
#include "prohull/geometry.h"
#include "verify/self_intersection.h"
#include "verify/surface.h"

namespace prohull::verify {

/// The volume of all points that a closed mesh winds around at least once: parts that overlap count once, and folds
/// that are inside out not at all. Which pieces of the surface bound it is decided exactly; their sum is rounded. NaN
/// where faces intersect so often that it would take long, in 100,000 pieces.
double solid_volume(const TriangleMesh& mesh, ProgressMeter& meter);

/// The same, if its self_intersections are known.
double solid_volume(const Surface& surface, const FacePairs& pairs, ProgressMeter& meter);

/// A piece of the boundary of that solid, rounded, and how often it counts: less than 0 where it bounds the solid from
/// inside, and in parts where others lie on it.
struct BoundaryPiece {
  Triangle triangle;
  double times;
};

/// Nothing where solid_volume is NaN.
std::optional<std::vector<BoundaryPiece>> solid_boundary(const TriangleMesh& mesh, ProgressMeter& meter);

}  // namespace prohull::verify
