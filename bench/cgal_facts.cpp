#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/intersection.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Side_of_triangle_mesh.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cgal_self_intersections.h"
#include "peers.h"
#include "surface_mesh.h"

namespace prohull::bench {
namespace {

namespace processing = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<SurfaceMesh>>>;

bool is_manifold(const TriangleMesh& mesh) {
  std::vector<std::array<std::size_t, 3>> faces;
  for (const auto& t : mesh.triangles) faces.push_back({index(t[0]), index(t[1]), index(t[2])});
  return processing::is_polygon_soup_a_polygon_mesh(faces);
}

}  // namespace

std::optional<PointsOutside> points_outside(std::span<const Vec3> points, const TriangleMesh& hull) {
  if (!is_manifold(hull)) return std::nullopt;
  const SurfaceMesh outer = surface_mesh<Kernel::Point_3>(hull);
  if (!CGAL::is_closed(outer)) return std::nullopt;

  const CGAL::Side_of_triangle_mesh<SurfaceMesh, Kernel> side(outer);
  const Tree tree(faces(outer).begin(), faces(outer).end(), outer);
  PointsOutside result;
  for (const Vec3& p : points) {
    const Kernel::Point_3 point(p.x, p.y, p.z);
    if (side(point) != CGAL::ON_UNBOUNDED_SIDE) continue;
    ++result.count;
    result.farthest = std::max(result.farthest, std::sqrt(tree.squared_distance(point)));
  }
  return result;
}

std::optional<ExactFacts> exact_facts(const TriangleMesh& original, const TriangleMesh& hull) {
  const auto outside = points_outside(original.positions, hull);
  if (!outside) return std::nullopt;
  const SurfaceMesh inner = surface_mesh<Kernel::Point_3>(original), outer = surface_mesh<Kernel::Point_3>(hull);
  return ExactFacts{outside->count, cgal_self_intersections(hull).value(), processing::do_intersect(outer, inner)};
}

}  // namespace prohull::bench
