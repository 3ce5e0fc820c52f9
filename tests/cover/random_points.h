#pragma once

#include <random>

#include "prohull/triangle_mesh.h"

namespace prohull::meshes {

/// Normally distributed around the origin, with these standard deviations; triangles use all of them.
inline TriangleMesh random_points(std::mt19937& random, int count, const Vec3& sizes) {
  std::normal_distribution<double> normal;
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const double x = normal(random), y = normal(random), z = normal(random);
    mesh.positions.push_back({x * sizes.x, y * sizes.y, z * sizes.z});
  }
  for (std::uint32_t i = 2; i < mesh.vertex_count(); ++i)
    mesh.triangles.push_back({VertexId{0}, VertexId{1}, VertexId{i}});
  return mesh;
}

/// By angles about two axes; rounded.
inline TriangleMesh turned(TriangleMesh mesh) {
  for (Vec3& p : mesh.positions) {
    p = {0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z};
    p = {p.x, 0.28 * p.y - 0.96 * p.z, 0.96 * p.y + 0.28 * p.z};
  }
  return mesh;
}

}  // namespace prohull::meshes
