#pragma once

#include <utility>

#include "prohull/triangle_mesh.h"
#include "wrap/surface_mesh.h"

namespace prohull::bench {

/// CGAL's mesh of a 2-manifold.
template <class Point>
CGAL::Surface_mesh<Point> surface_mesh(const TriangleMesh& mesh) {
  using SurfaceMesh = CGAL::Surface_mesh<Point>;
  SurfaceMesh surface;
  for (const Vec3& p : mesh.positions) surface.add_vertex({p.x, p.y, p.z});
  const auto vertex = [](VertexId v) { return typename SurfaceMesh::Vertex_index(index(v)); };
  for (const auto& t : mesh.triangles) surface.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  return surface;
}

/// Collects the garbage of `surface` first.
template <class Point>
TriangleMesh triangle_mesh(CGAL::Surface_mesh<Point>& surface) {
  surface.collect_garbage();
  return prohull::triangle_mesh(std::as_const(surface));
}

}  // namespace prohull::bench
