#pragma once

#include "prohull/progressive_hull.h"
#include "values.h"

namespace prohull::js {

/// Whole numbers from 0 to 2^32 - 1; `name` is for messages.
std::vector<std::uint32_t> indices_of(const val& array, const std::string& name);

/// What index.d.ts calls Levels: of the splits six numbers for each, o, d, l, r, od, do.
val object_of_levels(const ProgressiveHull& hull);
/// Throws InputError if that is no progressive hull.
ProgressiveHull levels_of(const val& levels);

}  // namespace prohull::js
