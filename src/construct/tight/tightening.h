#pragma once

#include <cstddef>
#include <vector>

#include "construct/growth.h"
#include "construct/tight/contacts.h"
#include "construct/tight/original.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/tight_hull.h"

namespace prohull {

/// Moves the vertices of a hull towards the original mesh, one at a time (tight_placement.h), and flips edges, in
/// rounds until hardly anything is gained. Returns the number of moves.
///
/// Flipping an edge over which the hull is convex removes the tetrahedron of its two faces: the hull still encloses if
/// the original lies outside of that. Nor is a move or flip made that adds a pair of intersecting faces.
std::size_t tighten(HalfEdgeMesh& hull, const Original& original, const MoveOptions& options,
                    const MayReach& may_reach = {});
/// With the contacts of the hull's vertices from before, and those that it finds.
std::size_t tighten(HalfEdgeMesh& hull, const Original& original, const MoveOptions& options, Contacts& contacts,
                    const MayReach& may_reach = {});
/// The same where only these vertices have changed since the hull was tightened last.
std::size_t tighten_around(const std::vector<VertexId>& changed, HalfEdgeMesh& hull, const Original& original,
                           const MoveOptions& options, Contacts& contacts);

}  // namespace prohull
