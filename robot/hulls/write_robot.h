#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "robot/files/robot_file.h"
#include "robot/hulls/link_hulls.h"

namespace prohull::robot {

/// A file of the robot that is written.
struct OutputFile {
  std::filesystem::path path;  ///< relative to the folder of the robot
  std::function<void(const std::filesystem::path&)> write;
};

struct WriteOptions {
  std::vector<std::size_t> faces{500};  ///< Budget::faces of the robot; each set of hulls is named by one
  Geometry from = Geometry::Visual;     ///< as LinkHullOptions::from
  std::string format = "stl";           ///< as LinkHullOptions::format
  /// The package that the new files make up, with a package.xml; URIs of hulls begin with package://PACKAGE/. Empty:
  /// no package, and URIs are relative paths.
  std::string package;
};

/// "arm" of arm.urdf and of arm.urdf.xacro: what the names of its files begin with.
std::string robot_stem(const RobotFile& file);

/// Throws InputError(InvalidOption) for the name of a package that ROS does not take, and for what MuJoCo does not
/// read: GLB files and packages.
void check_options(const RobotFile& file, const WriteOptions& options);

/// The files of a robot whose collision elements name the hulls. With the first number of faces the robot has the name
/// of its file, and its hulls are meshes/collision/LINK.stl; with each other number it has _FACES after its name, and
/// its hulls are meshes/collision_FACES/LINK.stl. `folder` is where the files are going to be. Convex pieces are
/// meshes/collision/LINK_01.stl and so on. The spheres of all links that have them are in ROBOT_spheres.yaml, too, as
/// cuRobo reads them.
///
/// A link keeps its collision elements if it was skipped, has no geometry, or has no certified hull.
/// Throws as check_options. `links` must outlive the result.
std::vector<OutputFile> output_files(const RobotFile& file, std::span<const LinkHulls> links,
                                     const std::filesystem::path& folder, const WriteOptions& options = {});

}  // namespace prohull::robot
