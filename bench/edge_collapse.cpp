#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "machine.h"
#include "peers.h"
#include "surface_mesh.h"

namespace prohull::bench {
namespace {

namespace simplification = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Stop = simplification::Count_stop_predicate<SurfaceMesh>;

template <class Collapse>
PeerRun timed(const TriangleMesh& mesh, std::size_t faces, Collapse&& collapse) {
  SurfaceMesh surface = surface_mesh<Kernel::Point_3>(mesh);
  // It stops below this count. A closed mesh has three edges for every two faces.
  const Stop stop(faces / 2 * 3 + 1);
  const double seconds = seconds_of([&] { collapse(surface, stop); });
  return {seconds, triangle_mesh(surface)};
}

}  // namespace

std::optional<PeerRun> run_garland_heckbert(const TriangleMesh& mesh, std::size_t faces) {
  return timed(mesh, faces, [](SurfaceMesh& surface, const Stop& stop) {
    const simplification::GarlandHeckbert_plane_policies<SurfaceMesh, Kernel> policies(surface);
    simplification::edge_collapse(
        surface, stop, CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  });
}

std::optional<PeerRun> run_lindstrom_turk(const TriangleMesh& mesh, std::size_t faces) {
  return timed(mesh, faces,
               [](SurfaceMesh& surface, const Stop& stop) { simplification::edge_collapse(surface, stop); });
}

}  // namespace prohull::bench
