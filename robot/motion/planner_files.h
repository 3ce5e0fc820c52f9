#pragma once

#include <span>
#include <string>
#include <vector>

#include "robot/files/sphere_file.h"
#include "robot/motion/motion.h"

namespace prohull::robot {

/// What planners on GPUs read beside a URDF file.
struct PlannerRobot {
  const Robot& robot;                 ///< the base is its first root, the tool the link that most joints lead to
  std::span<const LinkBalls> balls;   ///< links without any are not checked for collisions, and the files say so
  std::span<const MotionPair> pairs;  ///< those that are adjacent, or proven to meet always or never, are left out
  std::string urdf;                   ///< the name of the URDF file, in the same folder
};

/// The links with geometry, but without spheres, to which planners that read the spheres are blind.
std::vector<std::string> links_without_spheres(const Robot& robot, std::span<const LinkBalls> balls);

/// The configuration of the robot for cuRobo: robot_cfg of its robot files. Joints rest in the middle of their limits.
/// Weights, accelerations and jerks are those of cuRobo's own template: a URDF file has none. Numbers read back as the
/// same doubles. Throws InputError(InvalidOption) for names that are not UTF-8.
std::string curobo_file(const PlannerRobot& planned);

/// The configuration as an Extended Robot Description, XRDF 1.0, as Isaac's cuMotion reads it.
std::string xrdf_file(const PlannerRobot& planned);

}  // namespace prohull::robot
