#pragma once

#include "prohull/collide.h"
#include "prohull/progressive_hull.h"

namespace prohull {

/// What answers for the original of these levels: the original itself, exactly; or for may_collide, if `conservative`,
/// the coarsest hull. Throws as CollisionIndex, and InputError(InvalidOption) if an inner hull would have to answer
/// conservatively: it encloses nothing of the original.
CollisionIndex collision_index(const ProgressiveHull& levels, bool conservative);

}  // namespace prohull
