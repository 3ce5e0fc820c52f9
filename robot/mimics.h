#pragma once

#include <cstddef>
#include <vector>

#include "robot/model.h"

namespace prohull::robot {

/// The joints, each after the one that it follows. Joints that follow each other in a circle are left out, and so are
/// those that follow these.
std::vector<std::size_t> leaders_first(const Robot& robot);

/// A joint of a circle of joints that follow each other, if there is one.
const Joint* joint_in_mimic_loop(const Robot& robot);

}  // namespace prohull::robot
