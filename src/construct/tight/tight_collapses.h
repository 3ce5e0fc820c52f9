#pragma once

#include "construct/tight/contacts.h"
#include "construct/tight/original.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/hull_builder.h"

namespace prohull {

/// Collapses edges of a tight hull, that of least added volume first, until HullOptions::target_faces or none is legal.
/// Unlike build_hull, the new vertex need not lie outside of the star that it replaces, but only of the original: from
/// where the linear program of the star puts it, outside of all faces, it moves at once as far as tight_placement.h
/// lets it. The volume in which collapses are ordered is what is added then. docs/performance.md has what that gains.
void collapse_tightly(HalfEdgeMesh& hull, const Original& original, const HullOptions& options, Contacts& contacts);

}  // namespace prohull
