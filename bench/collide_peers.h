#pragma once

#include <memory>
#include <string>

#include "prohull/collide.h"

namespace prohull::bench {

/// Another library's answer to whether two meshes have a point in common.
class CollisionPeer {
 public:
  virtual ~CollisionPeer() = default;
  virtual std::string name() const = 0;
  virtual bool collide(const PosePair& poses) = 0;
};

/// FCL's trees of oriented boxes, in double precision, without exact predicates; of surfaces only. Null if it was not
/// built.
std::unique_ptr<CollisionPeer> make_fcl_obb(const TriangleMesh& a, const TriangleMesh& b);
std::unique_ptr<CollisionPeer> make_fcl_obbrss(const TriangleMesh& a, const TriangleMesh& b);
/// The least distance, and whether that is 0.
std::unique_ptr<CollisionPeer> make_fcl_distance(const TriangleMesh& a, const TriangleMesh& b);

/// CGAL's Rigid_triangle_mesh_collision_detection with exact predicates (GPL). Null if it was not built.
std::unique_ptr<CollisionPeer> make_cgal_collision(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace prohull::bench
