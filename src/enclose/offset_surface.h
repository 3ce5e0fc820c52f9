#pragma once

#include <optional>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// A closed surface whose faces are `distance` away from those of a mesh: on the outer side of a closed mesh, and
/// around a sheet on both sides. Where the mesh is sharp, vertices are up to six times as far, and faces nearer.
/// Vertices much nearer to each other than the distance are joined before, so that folds between them vanish. The
/// surface may pass through itself, and nothing is exact: certify what is made of it. None if two faces have an edge in
/// the same direction, or if the faces around a vertex leave no room.
std::optional<TriangleMesh> offset_surface(const TriangleMesh& mesh, double distance);

}  // namespace prohull
