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

  /// Of this solid around a point that is not on its surface. Exact.
  int winding_number(const Pose& pose, const Vec3& point) const;

  ObbTree tree;
  TriangleMesh mesh;
  bool is_solid = false;
  std::vector<Segment> component_ends;  ///< two vertices of each part whose faces are connected by vertices
};

}  // namespace prohull
