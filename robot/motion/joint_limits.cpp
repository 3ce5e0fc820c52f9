#include "robot/motion/joint_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace prohull::robot {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double below(double number) { return std::nextafter(number, -kInfinity); }
double above(double number) { return std::nextafter(number, kInfinity); }

}  // namespace

double JointRange::middle() const { return std::midpoint(lower, upper); }

JointRange own_limits(const Joint& joint) {
  if (joint.type == JointType::Continuous) return {-kInfinity, kInfinity};
  return {joint.lower, joint.upper};
}

// prohull_check_motion rounds likewise.
JointRange followed_range(const JointRange& range, const Mimic& mimic) {
  if (mimic.multiplier == 0 && range.contains(mimic.offset)) return {-kInfinity, kInfinity};
  if (mimic.multiplier == 0 || range.is_empty()) return {kInfinity, -kInfinity};
  double lower = below(range.lower - mimic.offset) / mimic.multiplier;
  double upper = above(range.upper - mimic.offset) / mimic.multiplier;
  if (mimic.multiplier < 0) std::swap(lower, upper);
  return {below(lower), above(upper)};
}

Leader leader_of(const Robot& robot, std::size_t joint) {
  Leader leader{joint, own_limits(robot.joints[joint])};
  for (std::size_t steps = 0; robot.joints[leader.joint].mimic && steps < robot.joints.size(); ++steps) {
    const Mimic& mimic = *robot.joints[leader.joint].mimic;
    leader = {mimic.joint, followed_range(leader.range, mimic)};
  }
  return leader;
}

// A joint is done when all that follow it are. Those that follow each other in a circle never are.
std::vector<JointRange> allowed_ranges(const Robot& robot) {
  std::vector<JointRange> allowed;
  std::vector<std::size_t> followers(robot.joints.size()), done;
  for (const Joint& joint : robot.joints) {
    allowed.push_back(own_limits(joint));
    if (joint.mimic) ++followers[joint.mimic->joint];
  }
  for (std::size_t j = 0; j < followers.size(); ++j)
    if (followers[j] == 0) done.push_back(j);
  for (std::size_t i = 0; i < done.size(); ++i) {
    const Joint& joint = robot.joints[done[i]];
    if (!joint.mimic) continue;
    JointRange& leader = allowed[joint.mimic->joint];
    if (moves(joint)) {
      const JointRange range = followed_range(allowed[done[i]], *joint.mimic);
      leader = {std::max(leader.lower, range.lower), std::min(leader.upper, range.upper)};
    }
    if (--followers[joint.mimic->joint] == 0) done.push_back(joint.mimic->joint);
  }
  return allowed;
}

std::vector<std::string> cut_notes(const Robot& robot) {
  constexpr double kTiny = 1e-3;  // limits that were rounded in a file differ by less
  std::vector<std::string> notes;
  const std::vector<JointRange> allowed = allowed_ranges(robot);
  for (std::size_t j = 0; j < allowed.size(); ++j) {
    const JointRange own = own_limits(robot.joints[j]);
    if (allowed[j].lower <= own.lower + kTiny && own.upper - kTiny <= allowed[j].upper) continue;
    if (robot.joints[j].mimic || own.is_empty()) continue;
    const std::string range = allowed[j].is_empty()
                                  ? "has no position"
                                  : fmt::format("counts from {:.6g} to {:.6g}", allowed[j].lower, allowed[j].upper);
    notes.push_back(
        fmt::format("joint '{}' {}, where the joints that follow it are within their own limits; a planner "
                    "that does not heed these may move it further",
                    robot.joints[j].name, range));
  }
  return notes;
}

}  // namespace prohull::robot
