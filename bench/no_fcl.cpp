#include "collide_peers.h"

namespace prohull::bench {

std::unique_ptr<CollisionPeer> make_fcl_obb(const TriangleMesh&, const TriangleMesh&) { return nullptr; }
std::unique_ptr<CollisionPeer> make_fcl_obbrss(const TriangleMesh&, const TriangleMesh&) { return nullptr; }
std::unique_ptr<CollisionPeer> make_fcl_distance(const TriangleMesh&, const TriangleMesh&) { return nullptr; }

}  // namespace prohull::bench
