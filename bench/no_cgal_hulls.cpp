#include "peers.h"

namespace prohull::bench {

std::optional<PeerRun> run_alpha_wrap(const TriangleMesh&, std::size_t) { return std::nullopt; }
std::optional<PeerRun> run_convex_hull(const TriangleMesh&) { return std::nullopt; }

}  // namespace prohull::bench
