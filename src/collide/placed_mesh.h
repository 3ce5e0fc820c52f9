#pragma once

#include <algorithm>
#include <cmath>

#include "prohull/collide.h"

namespace prohull {

/// `placed` of the public header, for loops.
inline Vec3 at_pose(const Pose& pose, const Vec3& p) {
  const auto& [x, y, z] = pose.rotation;
  return {dot(x, p) + pose.translation.x, dot(y, p) + pose.translation.y, dot(z, p) + pose.translation.z};
}
inline Triangle at_pose(const Pose& pose, const Triangle& t) {
  return {at_pose(pose, t.a), at_pose(pose, t.b), at_pose(pose, t.c)};
}

inline Vec3 rotated(const Pose& pose, const Vec3& p) {
  return {dot(pose.rotation[0], p), dot(pose.rotation[1], p), dot(pose.rotation[2], p)};
}
/// By the transpose of the matrix.
inline Vec3 transposed_rotated(const Pose& pose, const Vec3& p) {
  return pose.rotation[0] * p.x + pose.rotation[1] * p.y + pose.rotation[2] * p.z;
}

/// The largest entry of |R^T R - I|, which is what the lengths of vectors change by at most, three times.
inline double rotation_defect(const Pose& pose) {
  double defect = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      double product = i == j ? -1 : 0;
      for (const Vec3& row : pose.rotation) product += row[i] * row[j];
      defect = std::max(defect, std::abs(product));
    }
  return 3 * defect;
}

/// How far rounding moves a point in no more than `reach` from the origin: three products and three sums for each
/// coordinate, with a relative error of 2^-53 of numbers no greater than reach + |t|.
inline double rounding_bound(const Pose& pose, double reach) {
  return 0x1p-49 * (reach + norm(pose.translation)) + 0x1p-1000;
}

}  // namespace prohull
