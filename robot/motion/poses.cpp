#include "robot/motion/poses.h"

#include <cmath>

#include "robot/transform.h"

namespace prohull::robot {
namespace {

RigidMotion motion_between(const Pose& from, const Pose& to) {
  const Pose turn = composed({to.rotation, {}}, inverse({from.rotation, {}}));
  auto [w, x, y, z] = quaternion_of(turn);
  RigidMotion motion{
      .start = from, .through = from.translation, .axis = {x, y, z}, .shift = to.translation - from.translation};
  if (w < 0) motion.axis = -motion.axis;
  const double length = norm(motion.axis);
  motion.angle = 2 * std::atan2(length, std::abs(w));
  if (length > 0) motion.axis = motion.axis / length;
  return motion;
}

}  // namespace

Pose corrected(const Pose& pose) {
  require_rigid(pose);
  const auto [w, x, y, z] = quaternion_of(pose);
  return pose_of_quaternion(w, x, y, z, pose.translation);
}

std::vector<RigidMotion> motions_between(std::span<const Pose> poses) {
  if (poses.size() == 1) return {{.start = poses[0]}};
  std::vector<RigidMotion> motions;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) motions.push_back(motion_between(poses[i], poses[i + 1]));
  return motions;
}

}  // namespace prohull::robot
