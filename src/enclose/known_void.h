#pragma once

#include "prohull/enclosing_hull.h"

namespace prohull {

/// EnclosingHull::void_ratio of `hull`, which `made` has or will have.
double known_void(const EnclosingHulls& made, const EnclosingHull& hull);

/// Throws InputError if `bounds` limit the void, as a share of nothing.
void require_volume(double volume, const HullBounds& bounds);

}  // namespace prohull
