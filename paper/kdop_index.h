#pragma once

#include <span>
#include <string_view>

#include "prohull/mesh_query.h"

namespace prohull {

/// Trees of k-DOPs (Klosowski et al. 1998), the peer that the paper measures hulls against (P&T Table 4). They are here
/// to be measured: the engines of QueryIndex are faster.
///   kdop6, kdop14, kdop18, kdop26   a line is clipped by the slabs of a node
///   kdop6-overlap, ...              the k-DOP of the line itself is compared with that of the node, as in the paper's
///                                   peer most likely; a ray is cut off where it leaves the box of the mesh
std::span<const std::string_view> kdop_names();

/// An index that asks one of these trees; its answers are those of all other engines. Throws as QueryIndex does, and
/// InputError(InvalidOption) for another name.
QueryIndex kdop_index(TriangleMesh mesh, std::string_view name);

}  // namespace prohull
