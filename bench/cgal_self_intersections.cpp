#include "cgal_self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

namespace prohull::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

SurfaceMesh surface_mesh(const TriangleMesh& mesh) {
  SurfaceMesh surface;
  for (const Vec3& p : mesh.positions) surface.add_vertex({p.x, p.y, p.z});
  const auto vertex = [](VertexId v) { return SurfaceMesh::Vertex_index(index(v)); };
  for (const auto& t : mesh.triangles)
    if (surface.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])) == SurfaceMesh::null_face())
      throw std::invalid_argument("not a 2-manifold");
  return surface;
}

}  // namespace

std::optional<std::size_t> cgal_self_intersections(const TriangleMesh& mesh) {
  std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(surface_mesh(mesh), std::back_inserter(pairs));
  // It pairs faces without area with themselves.
  return static_cast<std::size_t>(std::ranges::count_if(pairs, [](const auto& p) { return p.first != p.second; }));
}

}  // namespace prohull::bench
