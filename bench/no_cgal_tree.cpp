#include "query_peers.h"

namespace prohull::bench {

std::unique_ptr<QueryPeer> make_cgal_tree(const TriangleMesh&) { return nullptr; }

}  // namespace prohull::bench
