#include <meshoptimizer.h>

#include <limits>
#include <vector>

#include "machine.h"
#include "peers.h"

namespace prohull::bench {
namespace {

/// Those vertices of the original, bit for bit, that are left.
TriangleMesh mesh_of(const TriangleMesh& original, const std::vector<unsigned>& corners) {
  TriangleMesh mesh;
  constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
  PerVertex<VertexId> renumbered(original.vertex_count(), VertexId(kUnused));
  const auto number = [&](VertexId v) {
    if (index(renumbered[v]) == kUnused) renumbered[v] = mesh.positions.push_back(original.positions[v]);
    return renumbered[v];
  };
  for (std::size_t i = 0; i < corners.size(); i += 3)
    mesh.triangles.push_back(
        {number(VertexId(corners[i])), number(VertexId(corners[i + 1])), number(VertexId(corners[i + 2]))});
  return mesh;
}

}  // namespace

std::optional<PeerRun> run_meshoptimizer(const TriangleMesh& mesh, std::size_t faces) {
  std::vector<float> positions;
  for (const Vec3& p : mesh.positions)
    for (const double x : {p.x, p.y, p.z}) positions.push_back(static_cast<float>(x));
  std::vector<unsigned> corners;
  for (const auto& t : mesh.triangles)
    for (const VertexId v : t) corners.push_back(index(v));
  std::vector<unsigned> left(corners.size());
  constexpr float kAnyError = 1e6F;  // relative to the extent of the mesh
  const double seconds = seconds_of([&] {
    left.resize(meshopt_simplify(left.data(), corners.data(), corners.size(), positions.data(), mesh.vertex_count(),
                                 3 * sizeof(float), 3 * faces, kAnyError, 0, nullptr));
  });
  return PeerRun{seconds, mesh_of(mesh, left)};
}

}  // namespace prohull::bench
