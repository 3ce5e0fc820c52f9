#pragma once

#include "enclose/candidate.h"

namespace prohull {

/// Decides exactly whether the hull is one of the triangles that were given, and sets its `certified`, `verdict` and
/// `proof`. With padding, it is moved away first as far as that takes, and its `padding` is what is proven. Where few
/// triangles of a closed mesh stick out, as those of folds, vertices of the hull are lifted over them.
void certify(Attempt& attempt, const Request& request, Solids& solids);

}  // namespace prohull
