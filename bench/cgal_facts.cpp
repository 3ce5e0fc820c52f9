#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/intersection.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Side_of_triangle_mesh.h>

#include <algorithm>
#include <vector>

#include "cgal_self_intersections.h"
#include "peers.h"
#include "surface_mesh.h"

namespace prohull::bench {
namespace {

namespace processing = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

bool is_manifold(const TriangleMesh& mesh) {
  std::vector<std::array<std::size_t, 3>> faces;
  for (const auto& t : mesh.triangles) faces.push_back({index(t[0]), index(t[1]), index(t[2])});
  return processing::is_polygon_soup_a_polygon_mesh(faces);
}

}  // namespace

std::optional<ExactFacts> exact_facts(const TriangleMesh& original, const TriangleMesh& hull) {
  if (!is_manifold(hull)) return std::nullopt;
  const SurfaceMesh inner = surface_mesh<Kernel::Point_3>(original), outer = surface_mesh<Kernel::Point_3>(hull);
  if (!CGAL::is_closed(outer)) return std::nullopt;

  const CGAL::Side_of_triangle_mesh<SurfaceMesh, Kernel> side(outer);
  const auto outside =
      std::ranges::count_if(inner.vertices(), [&](auto v) { return side(inner.point(v)) == CGAL::ON_UNBOUNDED_SIDE; });
  return ExactFacts{static_cast<std::size_t>(outside), cgal_self_intersections(hull).value(),
                    processing::do_intersect(outer, inner)};
}

}  // namespace prohull::bench
