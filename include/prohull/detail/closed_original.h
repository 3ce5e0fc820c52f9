#pragma once

#include <optional>

#include "prohull/enclosing_hull.h"
#include "prohull/repair.h"

namespace prohull {

/// For VerificationOptions::closed: the closed mesh that stands for an open original where hulls of that side are built
/// from it. None if it is closed itself, if its openings are kept, or if no repair closes it. Throws InputError as
/// prepared_for_hulls.
inline std::optional<ClosedMesh> closed_original(const TriangleMesh& original, HullSide side, OpenShells open_shells) {
  if (open_shells == OpenShells::Keep || is_closed(original)) return std::nullopt;
  return prepared_for_hulls(original, {.hull = {.side = side}}).closed;
}

}  // namespace prohull
