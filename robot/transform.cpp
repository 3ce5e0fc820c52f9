#include "robot/transform.h"

#include <cmath>

namespace prohull::robot {
namespace {

Vec3 rotated(const Pose& pose, const Vec3& v) {
  return {dot(pose.rotation[0], v), dot(pose.rotation[1], v), dot(pose.rotation[2], v)};
}

Vec3 column(const Pose& pose, int axis) {
  return {pose.rotation[0][axis], pose.rotation[1][axis], pose.rotation[2][axis]};
}

}  // namespace

Pose of_columns(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& translation) {
  return {{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}, translation};
}

Pose composed(const Pose& outer, const Pose& inner) {
  return of_columns(rotated(outer, column(inner, 0)), rotated(outer, column(inner, 1)),
                    rotated(outer, column(inner, 2)), placed(outer, inner.translation));
}

Pose inverse(const Pose& pose) {
  Pose result = of_columns(pose.rotation[0], pose.rotation[1], pose.rotation[2], {});
  result.translation = -rotated(result, pose.translation);
  return result;
}

Pose pose_of_rpy(const Vec3& rpy, const Vec3& translation) {
  const double cr = std::cos(rpy.x), sr = std::sin(rpy.x);
  const double cp = std::cos(rpy.y), sp = std::sin(rpy.y);
  const double cy = std::cos(rpy.z), sy = std::sin(rpy.z);
  return {{Vec3{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
           Vec3{sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr}, Vec3{-sp, cp * sr, cp * cr}},
          translation};
}

Pose rotation_about(const Vec3& axis, double angle) {
  const Vec3 v = axis / norm(axis) * std::sin(angle / 2);
  return pose_of_quaternion(std::cos(angle / 2), v.x, v.y, v.z);
}

Pose translation_by(const Vec3& offset) {
  Pose pose;
  pose.translation = offset;
  return pose;
}

}  // namespace prohull::robot
