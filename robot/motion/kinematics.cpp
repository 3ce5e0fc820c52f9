#include "robot/motion/kinematics.h"

#include <fmt/format.h>

#include <cmath>

#include "robot/mimics.h"
#include "robot/motion/joint_limits.h"
#include "robot/transform.h"

namespace prohull::robot {
namespace {

Pose motion_of(const Joint& joint, double position) {
  switch (joint.type) {
    case JointType::Revolute:
    case JointType::Continuous:
      return rotation_about(joint.axis, position);
    case JointType::Prismatic:
      return translation_by(joint.axis * position);
    case JointType::Fixed:
    case JointType::Ball:
    case JointType::Planar:
    case JointType::Floating:
      break;
  }
  return {};
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

}  // namespace prohull::robot
