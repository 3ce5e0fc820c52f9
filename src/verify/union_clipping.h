#pragma once

#include <vector>

#include "verify/solids.h"
#include "verify/surface.h"
#include "verify/union_pieces.h"

namespace prohull::verify {

/// Points, rounded, around all that is left of t once the kernels of all pieces are cut off; none if they cover it.
/// Exact. `t` has an area along `axis`.
std::vector<Vec3> points_beyond_kernels(const Triangle& t, int axis, const Pieces& pieces);

/// What the pieces leave open in the midst of `solid`, of which they cover every triangle. Exact. `all` is made of
/// pieces.together().
Holes find_holes(const Surface& solid, const Pieces& pieces, const Surface& all, const EnclosureOptions& options);

}  // namespace prohull::verify
