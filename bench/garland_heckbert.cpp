#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "machine.h"
#include "peers.h"

namespace prohull::bench {
namespace {

namespace simplification = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

SurfaceMesh surface_mesh(const TriangleMesh& mesh) {
  SurfaceMesh surface;
  for (const Vec3& p : mesh.positions) surface.add_vertex({p.x, p.y, p.z});
  const auto vertex = [](VertexId v) { return SurfaceMesh::Vertex_index(index(v)); };
  for (const auto& t : mesh.triangles) surface.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  return surface;
}

}  // namespace

std::optional<PeerRun> run_garland_heckbert(const TriangleMesh& mesh, std::size_t faces) {
  SurfaceMesh surface = surface_mesh(mesh);
  // It stops below this count. A closed mesh has three edges for every two faces.
  const simplification::Count_stop_predicate<SurfaceMesh> stop(faces / 2 * 3 + 1);
  const double seconds = seconds_of([&] {
    const simplification::GarlandHeckbert_plane_policies<SurfaceMesh, Kernel> policies(surface);
    simplification::edge_collapse(
        surface, stop, CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  });
  return PeerRun{seconds, surface.number_of_faces()};
}

}  // namespace prohull::bench
