#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include "machine.h"
#include "peers.h"

namespace prohull::bench {
namespace {

struct DoublePrecision : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<DoublePrecision>;
using Decimater = OpenMesh::Decimater::DecimaterT<Mesh>;
using Quadric = OpenMesh::Decimater::ModQuadricT<Mesh>;

Mesh openmesh_of(const TriangleMesh& mesh) {
  Mesh copy;
  for (const Vec3& p : mesh.positions) copy.add_vertex({p.x, p.y, p.z});
  const auto vertex = [](VertexId v) { return Mesh::VertexHandle(static_cast<int>(index(v))); };
  for (const auto& t : mesh.triangles) copy.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  return copy;
}

TriangleMesh mesh_of(const Mesh& openmesh) {
  TriangleMesh mesh;
  for (const auto v : openmesh.vertices()) {
    const auto& p = openmesh.point(v);
    mesh.positions.push_back({p[0], p[1], p[2]});
  }
  for (const auto f : openmesh.faces()) {
    std::array<VertexId, 3> corners;
    std::size_t i = 0;
    for (const auto v : openmesh.fv_range(f)) corners.at(i++) = VertexId(static_cast<std::uint32_t>(v.idx()));
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

}  // namespace

std::optional<PeerRun> run_openmesh(const TriangleMesh& mesh, std::size_t faces) {
  Mesh openmesh = openmesh_of(mesh);
  const double seconds = seconds_of([&] {
    Decimater decimater(openmesh);
    OpenMesh::Decimater::ModHandleT<Quadric> quadric;
    decimater.add(quadric);
    decimater.module(quadric).unset_max_err();
    decimater.initialize();
    decimater.decimate_to_faces(0, faces);
    openmesh.garbage_collection();
  });
  return PeerRun{seconds, mesh_of(openmesh)};
}

}  // namespace prohull::bench
