#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "prohull/detail/names.h"
#include "prohull/detail/shapes.h"
#include "robot/model.h"

namespace prohull::robot {

/// By the suffix: URDF, xacro, SDF or MJCF.
bool is_robot_file(const std::filesystem::path& path);

enum class RobotFormat { Urdf, Sdf, Mjcf };

/// "urdf", "sdf", "mjcf"
Names<RobotFormat> robot_format_names();

struct FileOptions {
  /// Folders in which packages are looked for, before the folders above the robot's file and those that the environment
  /// variables ROS_PACKAGE_PATH and AMENT_PREFIX_PATH name.
  std::vector<std::filesystem::path> package_paths;
  /// Only read mesh files in the package of the robot's file, or in its folder if that is in no package, and in the
  /// folders above that name packages, none of which may have data in other files; and no xacro file, whose macros may
  /// read any file.
  bool no_outside_files = false;
};

/// A robot, and the text that it was read from.
struct RobotFile {
  Robot robot = {};
  RobotFormat format = RobotFormat::Urdf;
  std::filesystem::path path = {};
  std::string text = {};  ///< of the file, with those that MJCF includes; of xacro what the program xacro made of it
  std::vector<std::string> notes = {};               ///< sentences for the user: what was not read
  FileOptions options = {};                          ///< with which it was read
  std::vector<std::filesystem::path> included = {};  ///< whose text is here, too; those of xacro are not known
};

/// Reads URDF, SDF or MJCF; the content tells which. A .xacro file is expanded by the program xacro.
///
/// Throws InputError with the file and the line: CannotRead; Malformed for text that is no XML or no robot: entities
/// that the document declares itself, loops of joints, links that do not exist, names that occur twice, numbers that
/// are none; UnknownFormat for USD, other formats, and for xacro where the program xacro is not installed. A mesh that
/// is not found is no error here: MeshFile::why_not. CannotRead for what FileOptions::no_outside_files refuses.
RobotFile read_robot(const std::filesystem::path& path, const FileOptions& options = {});

/// The robot that `text` describes. `path` stands in messages, and relative mesh files are looked for beside it.
RobotFile read_robot(std::string text, const std::filesystem::path& path, const FileOptions& options = {});

/// What takes the place of all collision elements of a link.
struct NewCollision {
  std::size_t link = 0;              ///< in Robot::links
  Geometry from = Geometry::Visual;  ///< which shapes of the link `same_origin_as` and `kept` count
  /// URIs of mesh files, for the format of the robot: of the hull, or of each convex piece.
  std::vector<std::string> hulls = {};
  /// The shape whose origin the hulls have; none: they are in the frame of the link.
  std::optional<std::size_t> same_origin_as = {};
  std::vector<Ball> balls = {};        ///< in the frame of the link
  std::vector<std::size_t> kept = {};  ///< shapes that become collision elements as they are
};

/// The URI by which a new robot names the file of a URI in the old one.
using NewUri = std::function<std::string(const std::string&)>;

/// The text with new collision elements; `collisions` names no link twice. Every byte outside of the collision elements
/// of these links stays as it is, except that URIs of mesh and texture files which only resolve beside the old file
/// become paths that resolve from `folder`, where the text is going to be written. With `new_uri`, which MJCF does not
/// heed, every URI that stays becomes what it says. Throws InputError(Malformed) if what is new has letters beyond
/// ASCII, and the document declares an encoding other than UTF-8.
std::string with_collisions(const RobotFile& file, std::span<const NewCollision> collisions,
                            const std::filesystem::path& folder, const NewUri& new_uri = {});

}  // namespace prohull::robot
