#include "query_peers.h"

namespace prohull::bench {

std::unique_ptr<QueryPeer> make_embree(const TriangleMesh&, bool, unsigned) { return nullptr; }

}  // namespace prohull::bench
