#pragma once

#include <cstddef>
#include <span>

#include "prohull/triangle_mesh.h"

namespace prohull::certificate {

/// How many triangles of the original without area lie in the plane of a triangle of the hull near them, and neither on
/// an edge nor at a corner of a triangle that has an area: a checker may not prove that such a triangle is covered.
std::size_t flat_triangles_in_doubt(const TriangleMesh& original, std::span<const TriangleMesh> hull);

}  // namespace prohull::certificate
