#pragma once

#include <chrono>
#include <optional>

#include "prohull/triangle_mesh.h"

namespace prohull::bench {

/// CGAL's alpha_wrap_3: a closed surface around the triangles, which enters no opening narrower than about `alpha` and
/// stays about `offset` away from them. Both are in the unit of the mesh. Nothing if it takes longer than `limit`, or
/// if it was not built.
std::optional<TriangleMesh> alpha_wrap(const TriangleMesh& triangles, double alpha, double offset,
                                       std::chrono::seconds limit = std::chrono::hours(1));

}  // namespace prohull::bench
