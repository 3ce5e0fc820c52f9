#include "peers.h"

namespace prohull::bench {

std::optional<PeerRun> run_meshoptimizer(const TriangleMesh&, std::size_t) { return std::nullopt; }

}  // namespace prohull::bench
