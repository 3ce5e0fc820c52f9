#pragma once

#include <span>
#include <string>
#include <vector>

#include "robot/hulls/write_robot.h"
#include "robot/motion/pair_proof.h"

namespace prohull::robot {

/// Pairs of links with geometry that a joint connects: JointPaths::are_adjacent.
std::vector<LinkPair> adjacent_pairs(const Robot& robot);

struct MujocoFiles {
  std::vector<OutputFile> files;
  std::vector<std::string> notes;  ///< as MjcfRobot::notes
};

/// The robots of `written` as MJCF, ROBOT.xml beside each URDF file, with the same collision geometry. Other meshes
/// that they name become STL files in meshes/visual, or OBJ files where STL would round their coordinates or has too
/// many faces for MuJoCo; flat ones are left out, because MuJoCo refuses them. Throws as mjcf_of.
MujocoFiles mujoco_files(const RobotFile& file, const RobotFiles& written, std::span<const LinkPair> apart);

}  // namespace prohull::robot
