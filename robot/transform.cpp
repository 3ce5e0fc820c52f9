#include "robot/transform.h"

#include <algorithm>
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

std::array<double, 4> quaternion_of(const Pose& pose) {
  const auto& r = pose.rotation;
  const std::array<double, 4> squares{1 + r[0].x + r[1].y + r[2].z, 1 + r[0].x - r[1].y - r[2].z,
                                      1 - r[0].x + r[1].y - r[2].z, 1 - r[0].x - r[1].y + r[2].z};
  const auto largest = static_cast<std::size_t>(std::ranges::max_element(squares) - squares.begin());
  const double yz = r[2].y - r[1].z, zx = r[0].z - r[2].x, xy = r[1].x - r[0].y;  // 4 w times x, y, z
  const double x_y = r[1].x + r[0].y, x_z = r[0].z + r[2].x, y_z = r[2].y + r[1].z;
  const std::array<std::array<double, 4>, 4> rows{
      {{squares[0], yz, zx, xy}, {yz, squares[1], x_y, x_z}, {zx, x_y, squares[2], y_z}, {xy, x_z, y_z, squares[3]}}};
  std::array<double, 4> q = rows[largest];  // by the largest of the four
  const double length = 2 * std::sqrt(squares[largest]);
  for (double& part : q) part /= length;
  return q;
}

Vec3 rpy_of(const Pose& pose) {
  const auto& r = pose.rotation;
  const double yaw = std::atan2(r[1].x, r[0].x), pitch = std::atan2(-r[2].x, std::hypot(r[0].x, r[1].x));
  // Where the pitch is a right angle, rounding decides the yaw. The roll belongs to the yaw that was found.
  const double s = std::sin(yaw), c = std::cos(yaw);
  return {std::atan2(s * r[0].z - c * r[1].z, c * r[1].y - s * r[0].y), pitch, yaw};
}

Pose rotation_about(const Vec3& axis, double angle) {
  const Vec3 v = axis / norm(axis) * std::sin(angle / 2);
  return pose_of_quaternion(std::cos(angle / 2), v.x, v.y, v.z);
}

Pose turn_of_z_to(const Vec3& z) {
  const Vec3 axis = cross({0, 0, 1}, z);
  const double sine = norm(axis);
  if (sine < 1e-10) return z.z > 0 ? Pose{} : of_columns({1, 0, 0}, {0, -1, 0}, {0, 0, -1});
  return rotation_about(axis, std::atan2(sine, z.z));
}

Pose translation_by(const Vec3& offset) {
  Pose pose;
  pose.translation = offset;
  return pose;
}

}  // namespace prohull::robot
