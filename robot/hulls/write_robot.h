#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "robot/files/robot_file.h"
#include "robot/files/sphere_file.h"
#include "robot/hulls/link_hulls.h"
#include "robot/hulls/package_files.h"

namespace prohull::robot {

/// The files of a certified hull; of spheres there are none.
struct HullFiles {
  std::size_t link = 0, set = 0;  ///< in Robot::links, in LinkHulls::hulls
  /// meshes/collision/LINK: names of other files about the hull begin so. The name of the link in it is that of no
  /// other one, in no set.
  std::filesystem::path stem;
  std::vector<std::filesystem::path> meshes = {};  ///< relative to the folder of the robot
};

struct RobotFiles {
  std::vector<OutputFile> files;
  std::vector<HullFiles> hulls;  ///< which of them are those of hulls
  /// Each robot, by its file; the one with the first number of faces comes first.
  std::vector<std::pair<std::filesystem::path, Robot>> robots;
  std::vector<LinkBalls> balls;                                   ///< its spheres, as ROBOT_spheres.yaml has them
  std::map<std::filesystem::path, std::filesystem::path> copies;  ///< as PackageFiles::copies
  std::set<std::string> left;                                     ///< as PackageFiles::left
};

struct WriteOptions {
  std::vector<std::size_t> faces{500};  ///< Budget::faces of the robot; each set of hulls is named by one
  Geometry from = Geometry::Visual;     ///< as LinkHullOptions::from
  std::string format = "stl";           ///< of the hulls' files: "stl", "obj" or "glb"
  /// The package that the new files make up, with a package.xml and copies of what the robot names; URIs begin with
  /// package://PACKAGE/. Empty: no package, and URIs are relative paths.
  std::string package;
  bool to_mjcf = false;  ///< MuJoCo is going to read the hulls
};

/// MuJoCo reads no STL file of more.
inline constexpr std::size_t kMostMujocoStlFaces = 200'000;

/// "arm" of arm.urdf and of arm.urdf.xacro: what the names of its files begin with.
std::string robot_stem(const RobotFile& file);

/// The whole content of a file. Throws InputError(CannotWrite).
void write_text(const std::filesystem::path& file, std::string_view text);

/// Throws InputError(CannotWrite) when it is written, if that fails.
OutputFile text_file(std::filesystem::path name, std::string text);

/// Writes a mesh file. Throws InputError(CannotWrite) if it does not hold the same triangles, bit for bit.
void write_certified(const std::filesystem::path& target, const TriangleMesh& mesh);

/// Throws InputError(InvalidOption) for the name of a package that ROS does not take, and for what MuJoCo does not
/// read, of MJCF and with `to_mjcf`: GLB files, STL files of so many faces, and packages. Only URDF becomes MJCF.
void check_options(const RobotFile& file, const WriteOptions& options);

/// The files of a robot whose collision elements name the hulls. With the first number of faces the robot has the name
/// of its file, and its hulls are meshes/collision/LINK.stl; with each other number it has _FACES after its name, and
/// its hulls are meshes/collision_FACES/LINK.stl. `folder` is where the files are going to be. Convex pieces are
/// meshes/collision/LINK_01.stl and so on. The spheres of all links that have them are in ROBOT_spheres.yaml, too, as
/// cuRobo reads them.
///
/// What is written is read again: OutputFile::write throws InputError(CannotWrite) if a file does not hold the
/// triangles that were certified, bit for bit, and this function if the text does not say the certified shapes of a
/// link and no others. A link keeps its collision elements if it was skipped, has no geometry, or has no certified
/// hull. Throws as check_options. `links` must outlive the result.
RobotFiles output_files(const RobotFile& file, std::span<const LinkHulls> links, const std::filesystem::path& folder,
                        const WriteOptions& options = {});

}  // namespace prohull::robot
