#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_3.h>

#include <cmath>
#include <vector>

#include "alpha_wrap.h"
#include "machine.h"
#include "peers.h"
#include "surface_mesh.h"

namespace prohull::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;

std::vector<Point> points_of(const TriangleMesh& mesh) {
  std::vector<Point> points;
  for (const Vec3& p : mesh.positions) points.emplace_back(p.x, p.y, p.z);
  return points;
}

PeerRun wrapped(const TriangleMesh& mesh, double alpha) {
  PeerRun run{};
  run.seconds = seconds_of([&] { run.mesh = alpha_wrap(mesh, alpha, alpha / 30).value(); });
  return run;
}

}  // namespace

std::optional<PeerRun> run_alpha_wrap(const TriangleMesh& mesh, std::size_t faces) {
  constexpr int kMaxWraps = 16;
  const Box box = bounding_box(mesh);
  double coarse = box.diagonal(), fine = 0;  // an alpha that keeps to the faces, and one that does not
  PeerRun best = wrapped(mesh, coarse);
  const auto is_full = [&] { return 100 * best.mesh.face_count() >= 98 * faces; };
  for (int wraps = 1; wraps < kMaxWraps && !is_full(); ++wraps) {
    const double alpha = fine > 0 ? std::sqrt(fine * coarse) : coarse / 2;
    PeerRun run = wrapped(mesh, alpha);
    if (run.mesh.face_count() > faces) {
      fine = alpha;
      continue;
    }
    coarse = alpha;
    // More faces with a larger alpha happen, as it is no monotone function.
    if (run.mesh.face_count() >= best.mesh.face_count()) best = std::move(run);
  }
  return best;
}

std::optional<PeerRun> run_convex_hull(const TriangleMesh& mesh) {
  const std::vector<Point> points = points_of(mesh);
  SurfaceMesh hull;
  const double seconds = seconds_of([&] { CGAL::convex_hull_3(points.begin(), points.end(), hull); });
  return PeerRun{seconds, triangle_mesh(hull)};
}

}  // namespace prohull::bench
