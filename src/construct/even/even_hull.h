#pragma once

#include <cstddef>

#include "construct/tight/original.h"
#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

struct EvenOptions {
  std::size_t max_faces = 400;
  double compactness = 0.5;  ///< of the worst face, to be reached
  bool float32_coordinates = false;
  Progress progress = {};  ///< stage "even"
};

/// A hull around the same triangles whose thinnest faces are better, as far as they can be made so: edges are split,
/// flipped and collapsed, and vertices move. Of a hull of an inner mesh, both are turned inside out.
///
/// Exact predicates decide that every change keeps the triangles covered, and its distance from them
/// (Original::padded_triangles). Only a split is not asked whether the hull intersects itself then: where coordinates
/// are nearly as coarse as the hull, the new vertex may be rounded to the far side of another face. `original` is one
/// of triangles.
TriangleMesh even_hull(const TriangleMesh& hull, const Original& original, const EvenOptions& options);

}  // namespace prohull
