#pragma once

#include <cstdint>
#include <vector>

#include "robot/model.h"

namespace prohull::robot {

/// In metres or radians: limits beyond this mean none, and would leave poses without digits.
inline constexpr double kFarthestLimit = 1000;

/// Random positions of all joints, evenly within their limits; `number` counts the configurations. A continuous joint,
/// or a revolute one without limits, makes one turn. A prismatic joint stays at 0, or at the limit closest to 0, if a
/// limit is missing or beyond 1 km. Joints that mimic follow, and the others stay where these are within their own
/// limits, but for rounding, if there are such positions. The same seed and number give the same positions.
std::vector<double> random_positions(const Robot& robot, std::uint64_t seed, std::uint64_t number);

/// Which joints random positions move as they can move.
std::vector<bool> sampled_joints(const Robot& robot);

}  // namespace prohull::robot
