#pragma once

#include "construct/growth.h"
#include "prohull/hull_builder.h"

namespace prohull {

/// The outer hull of a closed mesh (P&T 3.1), whatever options.side says; that is only recorded. First in rounds: space
/// is split into cells, each is simplified by itself, up to a priority that is the same for all; the next round has
/// other cells. All cells of a round are independent of each other, so that their threads never meet, and each fits
/// into the cache. What is left, mostly the last sixteen thousand faces, is simplified as a whole. Throws InputError
/// unless the mesh is a closed 2-manifold; Cancelled.
///
/// With `part`, the mesh is a part of a closed mesh: all faces that reach into that box. Only stars that lie strictly
/// inside of it change. The hull of the result is then no closed mesh.
HullResult simplify_in_rounds(const TriangleMesh& mesh, const HullOptions& options, const Box* part = nullptr,
                              const MayReach& may_reach = {});

}  // namespace prohull
