#pragma once

#include "prohull/mesh_query.h"
#include "view/blocks.h"

namespace prohull::view {

/// Of 0 to 65535, which stands for the greatest distance.
std::uint32_t scaled(double distance, double greatest);

/// Distances of a mesh's surface from another mesh, for colours: on a regular grid on each face, finer on larger faces,
/// some 200,000 points in all. web/src/data/heat.js draws them. With `outside_only`, points inside of the original,
/// which must be closed, count as 0.
nlohmann::json heat_facts(const TriangleMesh& mesh, const QueryIndex& original, bool outside_only,
                          const BatchOptions& batch, Blocks& blocks);

}  // namespace prohull::view
