#pragma once

#include "prohull/triangle_mesh.h"

namespace prohull {

/// Two triangles, on either side of the shorter diagonal.
inline void add_quad(TriangleMesh& mesh, VertexId a, VertexId b, VertexId c, VertexId d) {
  const auto squared_length = [&](VertexId p, VertexId q) {
    return squared_norm(mesh.positions[p] - mesh.positions[q]);
  };
  if (squared_length(a, c) <= squared_length(b, d)) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  } else {
    mesh.triangles.push_back({a, b, d});
    mesh.triangles.push_back({b, c, d});
  }
}

}  // namespace prohull
