#pragma once

#include <string>
#include <string_view>

#include "prohull/convex_cover.h"
#include "prohull/sphere_cover.h"

namespace prohull {

// As summary.h, of pieces and spheres. `diagonal` is that of the mesh.

/// The variant has its alternatives in the order of PieceShape.
inline PieceShape shape_of(const ConvexPiece& piece) { return static_cast<PieceShape>(piece.primitive.index()); }

/// "arm.obj: 12 convex pieces of at most 64 vertices, 3.25 % more volume than the mesh, which reach out by at most ..."
std::string line_of_cover(const std::string& name, const ConvexCover& cover, double diagonal);
/// `faces` are those of the mesh.
std::string line_of_cover(const std::string& name, const SphereCover& cover, std::size_t faces, double diagonal);

/// "volume: 10.55 with overlaps counted once, 31.9 % more than the solid's"; empty if that is not known
std::string line_of_volume(const SphereCover& cover);

std::string line_of_proof(const ConvexCover& cover, std::string_view what = "the union of the pieces as written");
std::string line_of_proof(const SphereCover& cover);

}  // namespace prohull
