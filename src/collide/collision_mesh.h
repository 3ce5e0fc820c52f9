#pragma once

#include <vector>

#include "collide/obb_tree.h"
#include "collide/placed_mesh.h"

namespace prohull {

/// What a CollisionIndex holds: the mesh in the order of its tree, so that neighbours in space are neighbours in
/// memory.
struct CollisionMesh {
  explicit CollisionMesh(const TriangleMesh& mesh, StandsFor what = StandsFor::Solid);

  Triangle triangle(std::size_t i) const { return mesh.triangle(FaceId(static_cast<std::uint32_t>(i))); }
  FaceId face(std::size_t i) const { return FaceId(tree.items()[i]); }  ///< of the mesh that was handed over

  /// Whether a component of another mesh lies inside of this mesh; false if this is no solid. Exact for
  /// surfaces that do not meet.
  bool contains_component(const Pose& pose, const CollisionMesh& other, const Pose& other_pose) const;

  /// Of this solid around a point in the root box of its tree that is not on its surface. Exact.
  int winding_number(const Pose& pose, const Vec3& point) const;

  ObbTree tree;
  TriangleMesh mesh;
  bool is_solid = false;
  std::vector<Segment> component_ends;  ///< two vertices of each part whose faces are connected by vertices
};

struct CollisionAccess {
  static const CollisionMesh& of(const CollisionIndex& index) { return *index.mesh_; }
};

/// For surfaces that do not meet. Then each component of one surface lies inside of the other solid as a whole, or
/// outside of it. If none lies inside, the solids have no point in common: the boundary of what they had in common
/// would lie on one of the surfaces, inside of the other solid.
inline bool one_is_inside(const CollisionMesh& a, const Pose& pose_a, const CollisionMesh& b, const Pose& pose_b) {
  return b.contains_component(pose_b, a, pose_a) || a.contains_component(pose_a, b, pose_b);
}

/// visit(i, triangle i of a, j, triangle j of b) for all pairs of two leaves, the triangles placed, until it returns
/// true. Returns whether it did.
template <class Visit>
bool visit_pairs(const CollisionMesh& a, const Pose& pose_a, const ObbNode& in_a, const CollisionMesh& b,
                 const Pose& pose_b, const ObbNode& in_b, Visit visit) {
  const std::size_t count_a = a.tree.items_of(in_a).size(), count_b = b.tree.items_of(in_b).size();
  Triangle placed_b[ObbTree::kLeafSize];
  for (std::size_t j = 0; j < count_b; ++j) placed_b[j] = at_pose(pose_b, b.triangle(in_b.first() + j));
  for (std::size_t i = 0; i < count_a; ++i) {
    const Triangle placed_a = at_pose(pose_a, a.triangle(in_a.first() + i));
    for (std::size_t j = 0; j < count_b; ++j)
      if (visit(in_a.first() + i, placed_a, in_b.first() + j, placed_b[j])) return true;
  }
  return false;
}

}  // namespace prohull
