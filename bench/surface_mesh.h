#pragma once

#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>

#include "prohull/triangle_mesh.h"

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
  TriangleMesh mesh;
  for (const auto v : surface.vertices()) {
    const Point& p = surface.point(v);
    mesh.positions.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : surface.faces()) {
    std::array<VertexId, 3> corners;
    std::size_t i = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f))) corners.at(i++) = VertexId(v.idx());
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

}  // namespace prohull::bench
