#include "cgal_self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "surface_mesh.h"

namespace prohull::bench {

std::optional<std::size_t> cgal_self_intersections(const TriangleMesh& mesh) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Face = CGAL::Surface_mesh<Kernel::Point_3>::Face_index;
  std::vector<std::pair<Face, Face>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(surface_mesh<Kernel::Point_3>(mesh), std::back_inserter(pairs));
  // It pairs faces without area with themselves.
  return static_cast<std::size_t>(std::ranges::count_if(pairs, [](const auto& p) { return p.first != p.second; }));
}

}  // namespace prohull::bench
