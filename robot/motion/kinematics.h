#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "prohull/sweep.h"
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

/// The pose with a rotation that is one but for rounding. Throws InputError as require_rigid.
Pose corrected(const Pose& pose);

/// Makes rotations of matrices that are almost rigid, and tells if that was more than rounding.
class Correction {
 public:
  /// As `corrected`.
  Pose operator()(const Pose& pose);
  std::vector<std::string> notes() const;

 private:
  std::size_t changed_ = 0;
  double most_ = 0;  ///< that an entry of a matrix was changed by
};

/// From each pose to the next: the origin of the body's frame goes straight, and the body turns about one axis the
/// shorter way round, at a constant rate (slerp). A single pose is a motion that stands still. The end of a motion is
/// the next pose but for rounding, which is less than the margin of `sweep`.
std::vector<RigidMotion> motions_between(std::span<const Pose> poses);

/// The joints, each after the one that it follows. Joints that follow each other in a circle are left out, and so are
/// those that follow these.
std::vector<std::size_t> leaders_first(const Robot& robot);

/// A joint of a circle of joints that follow each other, if there is one.
const Joint* joint_in_mimic_loop(const Robot& robot);

}  // namespace prohull::robot
