#pragma once

#include "prohull/triangle_mesh.h"

namespace prohull {

/// The sum of the areas of the faces.
inline double area_of(const TriangleMesh& mesh) {
  double sum = 0;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    sum += norm(cross(t.b - t.a, t.c - t.a)) / 2;
  }
  return sum;
}

}  // namespace prohull
