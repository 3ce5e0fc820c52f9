#pragma once

#include <functional>

#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// Makes of any finite triangles a closed 2-manifold around them, oriented outwards and free of self-intersection:
/// `alpha` is the radius of the largest ball that stays out of openings and hollows, `offset` the distance kept, both
/// in the input's unit and above 0. `progress`: stage "wrap". Throws Cancelled.
/// What a wrap promises nobody has to trust: verify_cover decides.
using Wrapper =
    std::function<TriangleMesh(const TriangleMesh& triangles, double alpha, double offset, const Progress& progress)>;

/// A Wrapper by CGAL's alpha_wrap_3 (Portaneri et al. 2022). Linked from prohull::wrap, which is there if CGAL's
/// package was (GPL, unlike the rest of the library). Takes time and memory with (diagonal / alpha)^2: an alpha of a
/// fiftieth gives some 10,000 to 50,000 faces within a second.
TriangleMesh alpha_wrap(const TriangleMesh& triangles, double alpha, double offset, const Progress& progress = {});

}  // namespace prohull
