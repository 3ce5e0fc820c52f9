#pragma once

#include <nlohmann/json.hpp>

#include "prohull/distance.h"
#include "view/page.h"

namespace prohull::view {

/// What `prohull verify` finds, for pieces and balls with --union; or why it cannot be asked.
nlohmann::json verification_facts(const Shown& shown, const Original& original, const PageOptions& options);

/// Proven bounds of how far it is from the original, and the farthest point. Of pieces and balls, how far they reach
/// out of it.
nlohmann::json distance_facts(const TriangleMesh& from, const TriangleMesh& to, const PageOptions& options);
nlohmann::json distance_facts(const Pieces& from, const TriangleMesh& to, const PageOptions& options);
nlohmann::json distance_facts(const Balls& from, const TriangleMesh& to, const PageOptions& options);

/// Counts, volume and defects.
nlohmann::json mesh_facts(const TriangleMesh& mesh);

}  // namespace prohull::view
