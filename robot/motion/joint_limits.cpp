#include "robot/motion/joint_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "robot/motion/kinematics.h"

namespace prohull::robot {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

double below(double number) { return std::nextafter(number, -kUnlimited); }
double above(double number) { return std::nextafter(number, kUnlimited); }

/// All positions of the joint that follows while the one that is followed is in the range, rounded outwards.
JointRange following_range(const JointRange& range, const Mimic& mimic) {
  if (range.is_empty()) return range;
  if (mimic.multiplier == 0) return {mimic.offset, mimic.offset};
  const auto [lower, upper] = std::minmax({mimic.multiplier * range.lower, mimic.multiplier * range.upper});
  const auto rounding = [&](double scaled) { return 0x1p-50 * (std::abs(scaled) + std::abs(mimic.offset)); };
  return {lower + mimic.offset - rounding(lower), upper + mimic.offset + rounding(upper)};
}

}  // namespace

double JointRange::middle() const { return std::midpoint(lower, upper); }

JointRange own_limits(const Joint& joint) {
  if (joint.type == JointType::Continuous) return {-kUnlimited, kUnlimited};
  return {joint.lower, joint.upper};
}

JointRange one_turn(const JointRange& range) {
  constexpr double kTurn = 2 * std::numbers::pi * (1 + 0x1p-40);  // covers the rounding of its ends
  if (range.upper - range.lower < kTurn) return range;
  const double start = std::clamp(-kTurn / 2, range.lower, range.upper - kTurn);
  return {start, start + kTurn};
}

// prohull_check_motion rounds likewise.
JointRange followed_range(const JointRange& range, const Mimic& mimic) {
  if (mimic.multiplier == 0 && range.contains(mimic.offset)) return {-kUnlimited, kUnlimited};
  if (mimic.multiplier == 0 || range.is_empty()) return {kUnlimited, -kUnlimited};
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

std::vector<JointRange> allowed_ranges(const Robot& robot) {
  std::vector<JointRange> allowed;
  for (const Joint& joint : robot.joints) allowed.push_back(own_limits(joint));
  const std::vector<std::size_t> order = leaders_first(robot);
  for (std::size_t i = order.size(); i-- > 0;) {
    const Joint& joint = robot.joints[order[i]];
    if (!joint.mimic || !moves(joint)) continue;
    JointRange& leader = allowed[joint.mimic->joint];
    const JointRange range = followed_range(allowed[order[i]], *joint.mimic);
    leader = {std::max(leader.lower, range.lower), std::min(leader.upper, range.upper)};
  }
  return allowed;
}

std::vector<JointRange> passed_ranges(const Robot& robot) {
  std::vector<JointRange> ranges = allowed_ranges(robot);
  for (const std::size_t j : leaders_first(robot)) {
    const auto& mimic = robot.joints[j].mimic;
    if (!mimic) continue;
    const JointRange passed = following_range(ranges[mimic->joint], *mimic);
    ranges[j] = {std::max(ranges[j].lower, passed.lower), std::min(ranges[j].upper, passed.upper)};
  }
  return ranges;
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
