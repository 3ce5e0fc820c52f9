#include <hacdHACD.h>

#include <stdexcept>

#include "cover_peers.h"
#include "machine.h"
#include "prohull/convex_hull.h"

namespace prohull::bench {
namespace {

using Point = HACD::Vec3<HACD::Real>;
using Corners = HACD::Vec3<long>;

/// The vertices of a cluster's convex hull; made a mesh by ours, because not all of its own are closed.
TriangleMesh piece_of(HACD::HACD& made, std::size_t cluster) {
  std::vector<Point> points(made.GetNPointsCH(cluster));
  std::vector<Corners> triangles(made.GetNTrianglesCH(cluster));
  made.GetCH(cluster, points.data(), triangles.data());
  TriangleMesh mesh;
  for (const Point& p : points) mesh.positions.push_back({p.X(), p.Y(), p.Z()});
  const auto vertex = [](long corner) { return VertexId(static_cast<std::uint32_t>(corner)); };
  for (const Corners& t : triangles) mesh.triangles.push_back({vertex(t.X()), vertex(t.Y()), vertex(t.Z())});
  return convex_hull(mesh);
}

}  // namespace

std::optional<PiecesRun> run_hacd(const TriangleMesh& mesh, std::size_t pieces, std::size_t vertices) {
  std::vector<Point> points;
  for (const Vec3& p : mesh.positions) points.emplace_back(p.x, p.y, p.z);
  std::vector<Corners> triangles;
  for (const auto& t : mesh.triangles) triangles.emplace_back(index(t[0]), index(t[1]), index(t[2]));
  constexpr double kNoLimit =
      1e300;  // of the concavity, and of the gaps between components: the number of pieces ends it
  HACD::HACD hacd;
  hacd.SetPoints(points.data());
  hacd.SetNPoints(points.size());
  hacd.SetTriangles(triangles.data());
  hacd.SetNTriangles(triangles.size());
  hacd.SetNClusters(pieces);
  hacd.SetNVerticesPerCH(vertices);
  hacd.SetConcavity(kNoLimit);
  hacd.SetConnectDist(kNoLimit);
  hacd.SetCompacityWeight(0.1);  // as in Bullet's own example
  hacd.SetVolumeWeight(0);
  PiecesRun run{};
  run.seconds = elapsed_seconds_of([&] {
    if (!hacd.Compute()) throw std::runtime_error("HACD failed");
  });
  for (std::size_t cluster = 0; cluster < hacd.GetNClusters(); ++cluster)
    if (TriangleMesh piece = piece_of(hacd, cluster); piece.face_count() > 0) run.pieces.push_back(std::move(piece));
  return run;
}

}  // namespace prohull::bench
