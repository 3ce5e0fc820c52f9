#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "robot/model.h"

namespace prohull::robot {

/// Positions of a joint; none if the lower one is above the upper one.
struct JointRange {
  double lower = 0, upper = 0;

  double middle() const;
  bool is_empty() const { return lower > upper; }
  bool contains(double position) const { return lower <= position && position <= upper; }
};

/// The positions that the joint's own limits allow. A continuous joint has no limits.
JointRange own_limits(const Joint& joint);

/// A whole turn, [-pi, pi] if it is in the range, where the range has one. Positions that differ by whole turns are the
/// same for what one joint moves.
JointRange one_turn(const JointRange& range);

/// All positions of the joint that is followed at which the one that follows is in the range, rounded outwards.
JointRange followed_range(const JointRange& range, const Mimic& mimic);

/// What moves a joint: itself, or what it follows in the end.
struct Leader {
  std::size_t joint = 0;
  JointRange range;  ///< all positions of it at which the other one is within its own limits, rounded outwards
};
Leader leader_of(const Robot& robot, std::size_t joint);

/// The result has, for each joint, all positions at which it and the joints that follow it are within their limits;
/// rounded outwards where others follow.
std::vector<JointRange> allowed_ranges(const Robot& robot);

/// Likewise, of joints that follow only those positions to which the others take them.
std::vector<JointRange> passed_ranges(const Robot& robot);

/// A sentence about each joint that has fewer positions because others follow it: planners may not hold these to their
/// limits.
std::vector<std::string> cut_notes(const Robot& robot);

}  // namespace prohull::robot
