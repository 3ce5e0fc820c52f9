#pragma once

#include "prohull/geometry.h"

namespace prohull {

/// Whether two closed triangles have a point in common; touching counts, and so do shared corners. A triangle without
/// area is the segment or point that it is. Exact for all finite coordinates.
bool triangles_touch(const Triangle& s, const Triangle& t);

}  // namespace prohull
