#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "robot/model.h"

namespace prohull::robot {

/// A parent of joints that is no link: the world.
inline constexpr std::size_t kWorld = std::numeric_limits<std::size_t>::max();

/// A joint as a file lists it, in any order. Its parent may be kWorld; mimic counts listed joints.
struct ListedJoint {
  Joint joint;
  bool continues = false;  ///< it moves the same child as the joint before it, one after the other
};

/// Sets robot.joints to a forest of the listed joints. `in_world` has the pose of each link at rest.
///
/// A joint that closes a loop is left out; a joint whose child hangs on another joint already is turned around, which
/// changes nothing about how links move. If all links hang together, and no joint to the world turns or slides, joints
/// to the world are left out. Otherwise a link "world" without geometry is added, and a link that nothing joins to the
/// rest gets a joint of type `unjoined` to it. `notes` get a sentence for each joint that is left out but for those to
/// the world.
void set_joints(Robot& robot, std::vector<ListedJoint> listed, const std::vector<Pose>& in_world, JointType unjoined,
                std::vector<std::string>& notes);

}  // namespace prohull::robot
