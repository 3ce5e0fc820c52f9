#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "robot/model.h"

namespace prohull::robot {

/// Where the child is in the frame of the joint's parent.
Pose joint_pose(const Joint& joint, double position);

/// Where each link is, in the frame of the root that it hangs on, for the positions of all joints. The position of a
/// joint that mimics is multiplier * position of the other + offset, whatever `positions` says. Joints that mimic each
/// other in a circle keep their positions, and so do those that mimic these. A ball, planar or floating joint stays at
/// rest.
std::vector<Pose> link_poses(const Robot& robot, std::span<const double> positions);

/// Positions of all joints for pictures: Joint::rest, or the middle of the limits of a joint that cannot be there. The
/// limits of joints that follow count, too.
std::vector<double> rest_positions(const Robot& robot);

/// The joints that are not fixed, by their names, with their positions; none where there are no positions.
std::vector<std::pair<std::string, double>> named_positions(const Robot& robot, std::span<const double> positions);

/// "joint1 0.5, joint2 -1"
std::string positions_text(const Robot& robot, std::span<const double> positions);

/// Sets the positions of all joints that mimic.
void follow(const Robot& robot, std::vector<double>& positions);

/// Whether the joint moves the same child on, after the one that stands before it.
bool continues_row(const Robot& robot, std::size_t joint);

}  // namespace prohull::robot
