#include "collide_peers.h"

namespace prohull::bench {

std::unique_ptr<CollisionPeer> make_cgal_collision(const TriangleMesh&, const TriangleMesh&) { return nullptr; }

}  // namespace prohull::bench
