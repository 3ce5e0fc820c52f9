#pragma once

#include <vector>

#include "cover/part.h"

namespace prohull::cover {

/// A plane that divides a part, and what the convex hulls of both sides have.
struct Cut {
  Plane plane;
  double volume = 0;  ///< together
  /// Less is better. Between cuts that save the same, as nothing yet in a ring, even halves leave most to later cuts.
  double merit = 0;
};

/// The best cuts of a part among planes of many directions and offsets, the best first: at most one for each direction.
std::vector<Cut> cuts(const Part& part, const Solid& solid);

/// Turns and moves the plane as long as that makes the volume less.
Cut refined(const Part& part, const Cut& cut, const Solid& solid);

}  // namespace prohull::cover
