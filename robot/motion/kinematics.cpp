#include "robot/motion/kinematics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "prohull/detail/rounded.h"
#include "prohull/detail/text.h"
#include "robot/motion/joint_limits.h"
#include "robot/transform.h"

namespace prohull::robot {
namespace {

Pose motion_of(const Joint& joint, double position) {
  if (turns(joint)) return rotation_about(joint.axis, position);
  return slides(joint) ? translation_by(joint.axis * position) : Pose{};
}

}  // namespace

Pose joint_pose(const Joint& joint, double position) {
  const Pose turned = composed(motion_of(joint, position), translation_by(-joint.anchor));
  return composed(joint.origin, composed(translation_by(joint.anchor), turned));
}

std::vector<std::pair<std::string, double>> named_positions(const Robot& robot, std::span<const double> positions) {
  std::vector<std::pair<std::string, double>> named;
  for (std::size_t j = 0; j < positions.size(); ++j)
    if (robot.joints[j].type != JointType::Fixed) named.emplace_back(robot.joints[j].name, positions[j]);
  return named;
}

std::string positions_text(const Robot& robot, std::span<const double> positions) {
  std::string text;
  for (const auto& [name, position] : named_positions(robot, positions))
    text += fmt::format("{}{} {:.6g}", text.empty() ? "" : ", ", name, position);
  return text;
}

void follow(const Robot& robot, std::vector<double>& positions) {
  for (const std::size_t j : leaders_first(robot))
    if (const auto& mimic = robot.joints[j].mimic)
      positions[j] = mimic->multiplier * positions[mimic->joint] + mimic->offset;
}

bool continues_row(const Robot& robot, std::size_t joint) {
  return joint > 0 && robot.joints[joint - 1].child == robot.joints[joint].child;
}

std::vector<Pose> link_poses(const Robot& robot, std::span<const double> positions) {
  std::vector<double> all(positions.begin(), positions.end());
  all.resize(robot.joints.size());
  follow(robot, all);
  std::vector<Pose> poses(robot.links.size());
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const Joint& joint = robot.joints[j];
    const std::size_t before = continues_row(robot, j) ? joint.child : joint.parent;
    poses[joint.child] = composed(poses[before], joint_pose(joint, all[j]));
  }
  return poses;
}

std::vector<double> rest_positions(const Robot& robot) {
  std::vector<double> positions;
  const std::vector<JointRange> allowed = allowed_ranges(robot);
  for (std::size_t j = 0; j < allowed.size(); ++j) {
    const JointRange range = allowed[j].is_empty() ? own_limits(robot.joints[j]) : allowed[j];
    const double rest = robot.joints[j].rest;
    positions.push_back(range.contains(rest) ? rest : range.middle());
    if (!std::isfinite(positions.back())) positions.back() = rest;
  }
  return positions;
}

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

Pose Correction::operator()(const Pose& pose) {
  constexpr double kRounding = 1e-14;
  const Pose made = corrected(pose);
  double change = 0;
  for (std::size_t row = 0; row < 3; ++row)
    for (int axis = 0; axis < 3; ++axis)
      change = std::max(change, std::abs(made.rotation[row][axis] - pose.rotation[row][axis]));
  changed_ += change > kRounding ? 1 : 0;
  most_ = std::max(most_, change);
  return made;
}

std::vector<std::string> Correction::notes() const {
  if (changed_ == 0) return {};
  return {
      fmt::format("{} of the poses {} rotation{}, but nearly: what is proven is about rotations whose numbers "
                  "differ from {} by up to {:.2g}",
                  counted(changed_, "matrix", "matrices"), changed_ == 1 ? "is no" : "are no", changed_ == 1 ? "" : "s",
                  changed_ == 1 ? "its" : "theirs", rounded_up(most_, 2))};
}

std::vector<RigidMotion> motions_between(std::span<const Pose> poses) {
  if (poses.size() == 1) return {{.start = poses[0]}};
  std::vector<RigidMotion> motions;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) motions.push_back(motion_between(poses[i], poses[i + 1]));
  return motions;
}

std::vector<std::size_t> leaders_first(const Robot& robot) {
  std::vector<std::size_t> order;
  std::vector<std::vector<std::size_t>> followers(robot.joints.size());
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    if (const auto& mimic = robot.joints[j].mimic)
      followers[mimic->joint].push_back(j);
    else
      order.push_back(j);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::vector<std::size_t>& next = followers[order[i]];
    order.insert(order.end(), next.begin(), next.end());
  }
  return order;
}

const Joint* joint_in_mimic_loop(const Robot& robot) {
  std::vector<bool> is_ordered(robot.joints.size());
  for (const std::size_t j : leaders_first(robot)) is_ordered[j] = true;
  const auto left_out = std::ranges::find(is_ordered, false);
  if (left_out == is_ordered.end()) return nullptr;
  auto at = static_cast<std::size_t>(left_out - is_ordered.begin());
  for (std::size_t steps = 0; steps < robot.joints.size(); ++steps) at = robot.joints[at].mimic->joint;
  return &robot.joints[at];
}

}  // namespace prohull::robot
