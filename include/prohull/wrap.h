#pragma once

#include <functional>

#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// A function that makes a *wrap* of any finite triangles: a closed 2-manifold around them that is oriented outwards
/// and free of self-intersection. `alpha` is the radius of the smallest ball that can enter openings and hollows.
/// `offset` is the distance that the wrap keeps from the triangles. Both are in the input's unit and greater than 0.
/// The stage of `progress` is "wrap". Throws Cancelled. Nobody has to trust a wrap: verify_cover decides whether it
/// covers the triangles.
using Wrapper =
    std::function<TriangleMesh(const TriangleMesh& triangles, double alpha, double offset, const Progress& progress)>;

/// A Wrapper by CGAL's alpha_wrap_3 (Portaneri et al. 2022). It is in the library prohull::wrap, which is built where
/// CGAL has that package; it is under the GPL, unlike the rest. Time and memory grow with (diagonal / alpha)^2: with an
/// alpha of diagonal / 50 the wrap has 10,000 to 50,000 faces and takes up to a second.
TriangleMesh alpha_wrap(const TriangleMesh& triangles, double alpha, double offset, const Progress& progress = {});

}  // namespace prohull
