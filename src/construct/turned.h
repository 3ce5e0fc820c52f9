#pragma once

#include <utility>

#include "prohull/hull_builder.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// Inside out.
inline TriangleMesh turned(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Inner hulls are made as outer hulls of the mesh turned inside out: what was inside of a face is then outside.
inline TriangleMesh turned_if_inner(TriangleMesh mesh, HullSide side) {
  return side == HullSide::Inner ? turned(std::move(mesh)) : mesh;
}

}  // namespace prohull
