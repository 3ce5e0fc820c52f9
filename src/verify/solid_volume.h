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
/// where faces intersect so often that it would take some seconds.
double solid_volume(const TriangleMesh& mesh, ProgressMeter& meter);

/// The same, if its self_intersections are known.
double solid_volume(const Surface& surface, const FacePairs& pairs, ProgressMeter& meter);

/// A triangle, rounded, and how often it counts. The triangles of a face may overlap: with their numbers they add up to
/// the part of the face that bounds the solid, or to less than nothing where it bounds it from inside.
struct BoundaryPiece {
  Triangle triangle;
  int times;
};

/// Nothing where solid_volume is NaN.
std::optional<std::vector<BoundaryPiece>> solid_boundary(const TriangleMesh& mesh, ProgressMeter& meter);

}  // namespace prohull::verify
