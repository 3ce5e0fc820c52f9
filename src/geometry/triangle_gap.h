#pragma once

#include "prohull/geometry.h"

namespace prohull {

/// Whether no point of s is nearer to a point of t than `distance`, which is finite and at least 0. Exact for all
/// coordinates within 1e100: triangles that are precisely so far apart are apart. Triangles without area count as the
/// segments or points that they are.
bool are_apart(const Triangle& s, const Triangle& t, double distance);

}  // namespace prohull
