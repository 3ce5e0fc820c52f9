#pragma once

#include <optional>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// A closed surface whose faces are at least `distance` away from those of a mesh: on the outer side of a closed mesh,
/// and around a sheet on both sides. Vertices much nearer to each other than the distance are joined before, so that
/// folds between them vanish. It may pass through itself, and rounding decides: certify what is made of it. None if an
/// edge has more than two faces or two of the same direction, or if the mesh is too sharp somewhere.
std::optional<TriangleMesh> offset_surface(const TriangleMesh& mesh, double distance);

}  // namespace prohull
