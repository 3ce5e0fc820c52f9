#pragma once

#include <algorithm>
#include <cmath>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// The sum of the areas of the faces. Squares of areas would overflow where lengths are 1e77 and more: these are
/// measured in a power of two.
inline double area_of(const TriangleMesh& mesh) {
  const double unit = std::ldexp(1.0, std::ilogb(std::max(bounding_box(mesh).diagonal(), 1e-100)));
  double sum = 0;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle t = mesh.triangle(f);
    sum += norm(cross((t.b - t.a) / unit, (t.c - t.a) / unit)) / 2;
  }
  return sum * unit * unit;
}

}  // namespace prohull
