#pragma once

#include "prohull/progressive_hull.h"
#include "values.h"

namespace prohull::js {

/// What index.d.ts calls Levels: of the splits six numbers for each, o, d, l, r, od, do.
val object_of_levels(const ProgressiveHull& hull);
/// Throws InputError if that is no progressive hull.
ProgressiveHull levels_of(const val& levels);

}  // namespace prohull::js
