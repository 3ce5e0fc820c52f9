#include "robot/motion/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prohull/detail/scramble.h"
#include "robot/motion/joint_limits.h"
#include "robot/motion/kinematics.h"

namespace prohull::robot {
namespace {

double random_turn(const Joint& joint, double unit) {
  if (std::isfinite(joint.lower) && std::isfinite(joint.upper)) return std::lerp(joint.lower, joint.upper, unit);
  const double turn = 2 * std::numbers::pi * unit;
  if (std::isfinite(joint.lower)) return joint.lower + turn;
  if (std::isfinite(joint.upper)) return joint.upper - turn;
  return turn - std::numbers::pi;
}

bool is_limited_slide(const Joint& joint) {
  return std::abs(joint.lower) <= kFarthestLimit && std::abs(joint.upper) <= kFarthestLimit;
}

double random_shift(const Joint& joint, double unit) {
  return is_limited_slide(joint) ? std::lerp(joint.lower, joint.upper, unit)
                                 : std::min(std::max(joint.rest, joint.lower), joint.upper);
}

double random_position(const Joint& joint, double unit) {
  if (joint.type == JointType::Continuous) return std::numbers::pi * (2 * unit - 1);
  if (turns(joint)) return random_turn(joint, unit);
  return slides(joint) ? random_shift(joint, unit) : 0;
}

/// The joint with these limits.
Joint within(Joint joint, const JointRange& allowed) {
  if (allowed.is_empty()) return joint;
  const bool has_limits = std::isfinite(allowed.lower) || std::isfinite(allowed.upper);
  if (joint.type == JointType::Continuous && has_limits) joint.type = JointType::Revolute;
  joint.lower = allowed.lower, joint.upper = allowed.upper;
  return joint;
}

/// Whether random positions reach all that the joint can do, apart from what it follows.
bool moves_as_it_can(const Joint& joint, const JointRange& allowed) {
  if (allowed.is_empty()) return false;
  if (slides(joint)) return joint.mimic || is_limited_slide(within(joint, allowed));
  return turns(joint) || joint.type == JointType::Fixed;
}

}  // namespace

std::vector<bool> sampled_joints(const Robot& robot) {
  std::vector<bool> sampled(robot.joints.size());
  const std::vector<JointRange> allowed = allowed_ranges(robot);
  for (const std::size_t j : leaders_first(robot)) {
    const Joint& joint = robot.joints[j];
    sampled[j] = moves_as_it_can(joint, allowed[j]) && (!joint.mimic || sampled[joint.mimic->joint]);
  }
  return sampled;
}

std::vector<double> random_positions(const Robot& robot, std::uint64_t seed, std::uint64_t number) {
  std::vector<double> positions(robot.joints.size());
  const std::vector<JointRange> allowed = allowed_ranges(robot);
  for (std::size_t j = 0; j < positions.size(); ++j)
    positions[j] =
        random_position(within(robot.joints[j], allowed[j]), unit_random(scramble(scramble(seed) + number) + j));
  follow(robot, positions);
  return positions;
}

}  // namespace prohull::robot
