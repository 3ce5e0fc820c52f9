#pragma once

#include <utility>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// Inside out.
inline TriangleMesh turned(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

}  // namespace prohull
