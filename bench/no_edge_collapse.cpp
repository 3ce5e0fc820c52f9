#include "peers.h"

namespace prohull::bench {

std::optional<PeerRun> run_garland_heckbert(const TriangleMesh&, std::size_t) { return std::nullopt; }
std::optional<PeerRun> run_lindstrom_turk(const TriangleMesh&, std::size_t) { return std::nullopt; }

}  // namespace prohull::bench
