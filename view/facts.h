#pragma once

#include <nlohmann/json.hpp>

#include "prohull/distance.h"
#include "view/page.h"

namespace prohull::view {

/// What `prohull verify` finds of a hull; or why it cannot be asked.
nlohmann::json verification_facts(const Shown& hull, const TriangleMesh& original, const PageOptions& options);

/// Proven bounds, and the farthest point.
nlohmann::json distance_facts(const TriangleMesh& from, const TriangleMesh& to, const PageOptions& options);

/// Counts, volume and defects.
nlohmann::json mesh_facts(const TriangleMesh& mesh);

}  // namespace prohull::view
