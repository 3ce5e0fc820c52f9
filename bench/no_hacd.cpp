#include "cover_peers.h"

namespace prohull::bench {

std::optional<PiecesRun> run_hacd(const TriangleMesh&, std::size_t, std::size_t) { return std::nullopt; }

}  // namespace prohull::bench
