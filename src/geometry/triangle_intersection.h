#pragma once

#include "prohull/geometry.h"

namespace prohull {

/// Whether two triangles have a point in common beyond the corner or the edge that they share; corners are shared if
/// their positions are equal. Touching counts. Two triangles with the same three corners meet.
/// Exact for all finite coordinates, in any order of the arguments and of the corners. A triangle without area meets
/// nothing: in a closed mesh its points lie on edges of other faces, which answer for them.
/// Takes some 20 ns where a plane separates the triangles; callers reject disjoint boxes first.
bool triangles_intersect(const Triangle& s, const Triangle& t);

/// Whether two closed triangles have a point in common; touching counts, and so do shared corners. A triangle without
/// area is the segment or point that it is. Exact for all finite coordinates.
bool triangles_touch(const Triangle& s, const Triangle& t);

/// True only if a plane separates the triangles strictly; with rounded arithmetic, so that those very near to each
/// other may not count as apart.
bool certainly_apart(const Triangle& s, const Triangle& t);

/// The segment, or point, that a triangle without area is; `a` is not after `b` by coordinates.
Segment segment_of(const Triangle& t);

}  // namespace prohull
