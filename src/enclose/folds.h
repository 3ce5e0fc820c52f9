#pragma once

#include <optional>
#include <vector>

#include "prohull/enclosing_hull.h"
#include "prohull/hull_builder.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// The hull, with vertices lifted over `triangles` until it covers them. `offenders` are those of them that it does not
/// cover yet. None if there is no room.
std::optional<TriangleMesh> lifted_until_covered(TriangleMesh hull, const TriangleMesh& triangles,
                                                 std::vector<Offender> offenders, const HullOptions& how);

struct Unfolded {
  TriangleMesh mesh;
  Folds folds;
};

/// A mesh around a closed one that does not cover all of its own faces: it has the same faces, but for some around the
/// folds, where edges are collapsed and vertices lifted until it covers all. None if the mesh covers itself, if it
/// intersects itself in many places, or if nothing helps. Requires a closed 2-manifold that is oriented outwards.
std::optional<Unfolded> unfolded(const TriangleMesh& mesh, const HullOptions& how);

/// The mesh, and thin sheets around those triangles that it does not cover: no farther away than about `distance`. None
/// if it covers all, if too many are left out, or if sheets do not help. The sheets cross the mesh, and each other.
std::optional<Unfolded> with_sheets(TriangleMesh mesh, const TriangleMesh& triangles, double distance,
                                    const HullOptions& how);

}  // namespace prohull
