#pragma once

#include <span>

#include "prohull/triangle_mesh.h"

namespace prohull::verify {

/// The part of the surfaces of convex pieces that lies in no other piece: the surface of their union, rounded. Its
/// triangles share no corners. Each piece is enlarged first, by about 1e-9 of its size and each by another factor, so
/// that no two faces lie in one plane.
TriangleMesh exposed_surface(std::span<const TriangleMesh> pieces);

/// No point of it is farther from the union than this part of the diagonal of all pieces.
inline constexpr double kExposedSurfaceRounding = 1e-8;

/// The volume within that surface, measured before the surface is placed where the pieces are, so that none is lost far
/// from the origin.
double exposed_volume(std::span<const TriangleMesh> pieces);

/// Whether a closed mesh differs from its convex hull by no more than rounding.
bool is_about_convex(const TriangleMesh& mesh);

}  // namespace prohull::verify
