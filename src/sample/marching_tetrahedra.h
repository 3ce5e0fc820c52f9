#pragma once

#include <functional>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// A solid: negative inside, positive outside, nowhere steeper than the distance (|f(p) - f(q)| <= |p - q|).
using DistanceBound = std::function<double(const Vec3&)>;

/// The surface of a solid within the ball of radius `extent` about the origin, by marching tetrahedra on a body-centred
/// cubic lattice of the given spacing. Closed, 2-manifold and free of self-intersection whatever the solid, as every
/// piece lies within its own tetrahedron. Time and memory are linear in the number of faces, about 12.7 area /
/// spacing^2.
TriangleMesh surface_of(const DistanceBound& solid, double extent, double spacing);

}  // namespace prohull
