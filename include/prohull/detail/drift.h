#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "prohull/collide.h"

namespace prohull {

/// A joint that moves a mesh, from where it is, by no more than `reach` either way: it turns it around the line, by
/// radians, or slides it along.
struct JointMove {
  Vec3 point;      ///< of the line
  Vec3 direction;  ///< of length 1
  double reach = 0;
  bool turns = true;
  std::size_t number = 0;  ///< the caller's own
};

/// How points of a mesh may move. All is in the frame of the mesh.
struct Drift {
  std::vector<JointMove> moves;  ///< the joint that is closest to the mesh comes first: it is moved by the others
  double blur = 0;               ///< how far points may be from lines, more or less than it seems
  double rounding = 0;           ///< how far points may be from where they seem to be after all moves
};

/// Whether points of the convex hulls of `a` and `b`, the latter placed by the pose, stay farther apart than `gap`
/// along a direction in the frame of a, if all points drift. Proven if true.
bool stay_apart_along(const Vec3& direction, std::span<const Vec3> a, const Drift& drift_a, std::span<const Vec3> b,
                      const Pose& pose_b, const Drift& drift_b, double gap);

/// Two faces that may come near each other.
struct NearFaces {
  std::uint32_t leaf_a = 0, leaf_b = 0;  ///< where they are in the trees of the indices
  Vec3 point_a, point_b;                 ///< where they are nearest, each in the frame of its mesh
  Vec3 way;                              ///< from one to the other, in the frame of a; 0 if they may meet
};

/// Two faces that may come within `gap` of each other if all points drift. Nothing if no two faces may, which is proven
/// then, and neither solid is inside of the other. `first` are faces to look at first, such as those that were near in
/// another pose. To `leaf_pairs` is added how many pairs of leaves were looked at, which is what takes time. Throws as
/// collide.
std::optional<NearFaces> may_come_near(const CollisionIndex& a, const Pose& pose_a, const Drift& drift_a,
                                       const CollisionIndex& b, const Pose& pose_b, const Drift& drift_b, double gap,
                                       const NearFaces* first, std::size_t& leaf_pairs);

}  // namespace prohull
