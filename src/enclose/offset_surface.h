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

/// The same of any triangles, as sheets that are cut where a surface turns by more than a right angle, where more than
/// two faces meet, and where a vertex has no room. Nothing is around needles. Sheets may pass through each other.
TriangleMesh sheets_around(const TriangleMesh& triangles, double distance);

}  // namespace prohull
