#pragma once

#include <functional>

#include "prohull/hull_builder.h"
#include "prohull/tight_hull.h"

namespace prohull {

/// Whether a hull may grow as far as this point. Empty: everywhere. Several threads ask at a time.
using MayReach = std::function<bool(const Vec3&)>;

/// build_hull, where collapses place new vertices only there.
HullResult build_hull(const TriangleMesh& mesh, const HullOptions& options, const MayReach& may_reach);

/// moved_towards and moved_towards_closed, where a face that grows has its new corner, its middle and those of its
/// moved edges only there.
TriangleMesh moved_towards(const TriangleMesh& hull, const TriangleMesh& triangles, const MoveOptions& options,
                           const MayReach& may_reach);
TriangleMesh moved_towards_closed(const TriangleMesh& hull, const TriangleMesh& mesh, HullSide side,
                                  const MoveOptions& options, const MayReach& may_reach);

}  // namespace prohull
