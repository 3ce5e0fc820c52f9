#pragma once

#include <cstddef>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// The unit sphere as a subdivided icosahedron of 20 n^2 faces. So that few faces can be had in fine steps too, the
/// icosahedron's five panels may be any number from three to ten.
TriangleMesh geodesic_sphere(std::size_t faces);

}  // namespace prohull
