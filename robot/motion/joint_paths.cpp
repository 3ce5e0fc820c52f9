#include "robot/motion/joint_paths.h"

#include <algorithm>

#include "robot/motion/kinematics.h"
#include "robot/motion/sampling.h"

namespace prohull::robot {
namespace {

/// Numbers of links. Two have the same one if all joints between them are among those that `connects` names; links of
/// different trees never have.
std::vector<std::size_t> connected_groups(const Robot& robot, const std::vector<bool>& connects) {
  std::vector<std::size_t> groups(robot.links.size());
  for (std::size_t link = 0; link < groups.size(); ++link) groups[link] = link;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {  // those of the parent come first
    const Joint& joint = robot.joints[j];
    const bool was_connected = !continues_row(robot, j) || groups[joint.child] == groups[joint.parent];
    groups[joint.child] = connects[j] && was_connected ? groups[joint.parent] : joint.child;
  }
  return groups;
}

std::vector<bool> fixed_joints(const Robot& robot) {
  std::vector<bool> fixed;
  for (const Joint& joint : robot.joints) fixed.push_back(joint.type == JointType::Fixed);
  return fixed;
}

}  // namespace

JointPaths::JointPaths(const Robot& robot)
    : rigid_group_(connected_groups(robot, fixed_joints(robot))),
      sampled_group_(connected_groups(robot, sampled_joints(robot))),
      hangs_on_(robot.links.size()),
      moves_between_(robot.links.size()) {
  for (std::size_t j = 0; j < robot.joints.size(); ++j) hang(robot, j);
}

// Joints of parents come first, so those of the parent are known.
void JointPaths::hang(const Robot& robot, std::size_t j) {
  const Joint& joint = robot.joints[j];
  const Link& parent = robot.links[joint.parent];
  const bool has_geometry = !parent.visual.empty() || !parent.collision.empty();
  const std::size_t moves =
      (has_geometry ? 0 : moves_between_[joint.parent]) + (joint.type == JointType::Fixed ? 0 : 1);
  std::size_t& all_moves = moves_between_[joint.child];
  all_moves = continues_row(robot, j) ? std::max(all_moves, moves) : moves;
  const bool was_free = continues_row(robot, j) && !hangs_on_[joint.child];
  if (was_free || joint.type == JointType::Floating || joint.type == JointType::Planar)
    hangs_on_[joint.child].reset();
  else
    hangs_on_[joint.child] = has_geometry ? joint.parent : hangs_on_[joint.parent];
}

}  // namespace prohull::robot
