#pragma once

#include <cstddef>

#include "prohull/triangle_mesh.h"

namespace prohull {

// Each gives about `faces` faces, or the fewest that its shape allows; make_sample has checked the range.
TriangleMesh make_sphere(std::size_t faces);
TriangleMesh make_asteroid(std::size_t faces);
TriangleMesh make_torus(std::size_t faces);
TriangleMesh make_knot(std::size_t faces);
TriangleMesh make_box(std::size_t faces);
TriangleMesh make_bracket(std::size_t faces);
TriangleMesh make_gyroid(std::size_t faces);
TriangleMesh make_pony(std::size_t faces);

}  // namespace prohull
