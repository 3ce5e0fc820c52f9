#pragma once

#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>

#include "prohull/triangle_mesh.h"

namespace prohull {

/// Of CGAL's mesh, which has no garbage.
template <class Point>
TriangleMesh triangle_mesh(const CGAL::Surface_mesh<Point>& surface) {
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

}  // namespace prohull
