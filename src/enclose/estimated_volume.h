#pragma once

#include "prohull/triangle_mesh.h"

namespace prohull {

/// Of all around which a closed mesh winds, where solid_volume takes too long: overlaps count once. By lengths of up to
/// 256 x 256 parallel lines inside. 0 if it winds around nothing.
double estimated_volume(const TriangleMesh& closed);

}  // namespace prohull
