#pragma once

#include "prohull/collide.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// Of the faces alone: a closed mesh would stand for its solid, too. With a face given twice it is not closed.
inline CollisionIndex surface_of(TriangleMesh mesh) {
  for (const FaceId f : mesh.triangles.ids())
    if (const Triangle t = mesh.triangle(f); t.a != t.b && t.b != t.c && t.c != t.a) {
      mesh.triangles.push_back(mesh.triangles[f]);
      break;
    }
  return CollisionIndex(mesh);
}

}  // namespace prohull
