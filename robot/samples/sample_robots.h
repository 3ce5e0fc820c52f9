#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull::robot {

struct SampleRobotInfo {
  std::string_view name;
  std::string_view description;
};

/// The robots that make_sample_robot can make: "arm", "gripper" and "mobile-base".
std::span<const SampleRobotInfo> sample_robots();

struct SampleRobot {
  std::string urdf;
  std::vector<std::pair<std::string, TriangleMesh>> meshes;  ///< by their path beside the URDF file, such as
                                                             ///< "meshes/visual/base.stl"
};

/// Makes a robot to try things with, the same bits every time. All coordinates are float32, as STL files keep them. Its
/// visual meshes are as CAD programs export them: of many parts that overlap, some open where others hide them, some
/// inside out. Its collision geometry is as robots ship it: coarse meshes, convex hulls and primitives, some of which
/// leak by up to 2 mm (arm) or 8 mm (mobile-base). Throws InputError(InvalidOption) for an unknown name.
SampleRobot make_sample_robot(std::string_view name);

/// The mesh with the coordinates that STL files keep.
TriangleMesh rounded_to_float32(TriangleMesh mesh);

}  // namespace prohull::robot
