#include "alpha_wrap.h"
#include "cgal_self_intersections.h"
#include "peers.h"

namespace prohull::bench {

std::optional<TriangleMesh> alpha_wrap(const TriangleMesh&, double, double, std::chrono::seconds) {
  return std::nullopt;
}
std::optional<PeerRun> run_alpha_wrap(const TriangleMesh&, std::size_t) { return std::nullopt; }
std::optional<PeerRun> run_convex_hull(const TriangleMesh&) { return std::nullopt; }
std::optional<PointsOutside> points_outside(std::span<const Vec3>, const TriangleMesh&) { return std::nullopt; }
std::optional<ExactFacts> exact_facts(const TriangleMesh&, const TriangleMesh&) { return std::nullopt; }
std::optional<std::size_t> cgal_self_intersections(const TriangleMesh&) { return std::nullopt; }

}  // namespace prohull::bench
