#pragma once

#include "prohull/triangle_mesh.h"
#include "render/color.h"

namespace prohull::render {

/// Colours that people with any kind of colour vision tell apart; the first 21 differ, then they repeat.
Rgb piece_color(std::size_t i);

/// A mesh with its parts drawn apart.
struct Exploded {
  TriangleMesh mesh;
  PerFace<Rgb> colors;  ///< equal for the faces of a part
  std::size_t parts = 0;
};

/// Moves each part of a mesh away from the middle of all, by `factor` times the distance of their middles. Parts are
/// what shared vertices connect.
Exploded exploded(TriangleMesh mesh, double factor);

}  // namespace prohull::render
