#pragma once

#include <string>
#include <utility>
#include <vector>

#include "robot/model.h"

namespace prohull::robot {

/// Links that have a box each.
inline Robot robot_of(std::size_t links, std::vector<Joint> joints) {
  Robot robot{.name = "test", .links = {}, .joints = std::move(joints)};
  robot.links.resize(links);
  for (std::size_t i = 0; i < links; ++i) {
    robot.links[i].name = "link" + std::to_string(i);
    robot.links[i].visual.push_back({BoxForm{{1, 1, 1}}});
  }
  for (Joint& joint : robot.joints) joint.name = "joint" + std::to_string(&joint - robot.joints.data());
  return robot;
}

inline Joint joint(JointType type, std::size_t parent, std::size_t child, const Vec3& at, const Vec3& axis) {
  Joint joint;
  joint.type = type, joint.parent = parent, joint.child = child, joint.axis = axis;
  joint.origin.translation = at;
  return joint;
}

inline Joint limited(Joint joint, double lower, double upper) {
  joint.lower = lower, joint.upper = upper;
  return joint;
}

inline Joint mimicking(Joint joint, std::size_t other, double multiplier, double offset) {
  joint.mimic = Mimic{other, multiplier, offset};
  return joint;
}

}  // namespace prohull::robot
