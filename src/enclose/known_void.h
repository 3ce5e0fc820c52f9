#pragma once

#include <string>
#include <vector>

#include "prohull/enclosing_hull.h"

namespace prohull {

/// EnclosingHull::void_ratio of `hull`, which `made` has or will have.
double known_void(const EnclosingHulls& made, const EnclosingHull& hull);

/// Throws InputError if `bounds` limit the void, as a share of nothing.
void require_volume(double volume, const HullBounds& bounds);

/// Whether there are cavities, where `volume` is that of a mesh as it is, and `filled` that without them.
bool add_note_of_cavities(double volume, double filled, std::vector<std::string>& notes);

}  // namespace prohull
