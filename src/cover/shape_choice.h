#pragma once

#include "prohull/convex_cover.h"

namespace prohull::cover {

/// Gives the piece the primitive of a shape: box, capsule or sphere. The mesh of a box becomes its own.
void take_shape(ConvexPiece& piece, PieceShape shape, bool float32_coordinates);

/// A convex polytope around all that a piece with its primitive takes up; of capsules and spheres some per cent larger.
TriangleMesh mesh_around(const ConvexPiece& piece);

}  // namespace prohull::cover
