#pragma once

#include "prohull/geometry.h"

namespace prohull {

/// Whether two triangles have a point in common beyond the corner or the edge that they share; corners are shared if
/// their positions are equal. Touching counts. Two triangles with the same three corners meet.
/// Exact for all finite coordinates, in any order of the arguments and of the corners. A triangle without area meets
/// nothing: in a closed mesh its points lie on edges of other faces, which answer for them.
/// Takes some 20 ns where a plane separates the triangles; callers reject disjoint boxes first.
bool triangles_intersect(const Triangle& s, const Triangle& t);

}  // namespace prohull
