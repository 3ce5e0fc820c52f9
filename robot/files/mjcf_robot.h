#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "robot/files/robot_file.h"

namespace prohull::robot {

/// The name, relative to the MJCF file, of a file with the triangles of a mesh in metres, in a format that MuJoCo
/// reads. Throws InputError if there is none: the geom is then left out.
using MujocoMesh = std::function<std::string(const MeshFile&)>;

struct MjcfRobot {
  std::string text;
  std::vector<std::string> notes;  ///< sentences for the user: what is not as in the file
};

/// A URDF robot as MuJoCo reads it. `robot` is that of the file, but for collision shapes, which may be others.
///
/// The root stands still in the world, or is the world if it is called so. Fixed joints, and joints whose limits are
/// equal, are bodies without a joint. Visual shapes are geoms of the class "visual", in group 2, without contacts.
/// Collision shapes are of the class "collision", in group 3. Neither has any mass: that of <inertial> counts. A link
/// that moves and has no mass takes that of a link that is fixed to it, or else that of its collision geoms with the
/// density of water. `apart`: pairs of links without contacts.
///
/// Throws InputError: Malformed for what <inertial>, <dynamics> and <color> say; InvalidOption for a file that is no
/// URDF, and for more links below each other than MuJoCo's reader of XML takes.
MjcfRobot mjcf_of(const RobotFile& urdf, const Robot& robot, std::span<const std::pair<std::size_t, std::size_t>> apart,
                  const MujocoMesh& mesh);

}  // namespace prohull::robot
