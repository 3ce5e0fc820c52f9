#pragma once

#include <cstddef>
#include <optional>

#include "prohull/triangle_mesh.h"

namespace prohull::bench {

/// Pairs of faces of a 2-manifold that meet beyond the vertices and edges that they share, by CGAL's exact predicates
/// (GPL), which share no code with ours; faces without area do not count. Nothing if it was not built.
std::optional<std::size_t> cgal_self_intersections(const TriangleMesh& mesh);

}  // namespace prohull::bench
