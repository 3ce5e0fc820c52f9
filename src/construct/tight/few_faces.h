#pragma once

#include <cstddef>

#include "construct/tight/original.h"
#include "prohull/hull_builder.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// Up to so many faces a tight hull is searched on from.
constexpr std::size_t kFewFaces = 200;

/// Searches a hull of less volume than `tight`, a tight hull of few faces of `mesh`. The result has at most as many
/// faces, at most as much volume and at most as many pairs of intersecting faces. It encloses the original as `tight`
/// does, and keeps the guards of its shape. The number of trials is fixed, and HullOptions::seed decides which they
/// are, so that the result is the same everywhere.
///
/// How it works: see few_faces.cpp.
TriangleMesh with_less_volume(TriangleMesh tight, const Original& original, const TriangleMesh& coarse,
                              const HullOptions& options);

}  // namespace prohull
