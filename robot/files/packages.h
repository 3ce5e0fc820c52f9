#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "robot/files/robot_file.h"
#include "robot/model.h"

namespace prohull::robot {

/// Where the files are that a robot names. Remembers where packages are: an object serves one thread at a time.
/// "arm" of "package://arm/link.stl"; "" of what is no such URI.
std::string_view package_of(std::string_view uri);

/// Whether a file is in a folder, wherever symbolic links lead.
bool is_in(const std::filesystem::path& file, const std::filesystem::path& folder);

class Packages {
 public:
  /// `robot` is the path of the robot's file.
  Packages(const std::filesystem::path& robot, const FileOptions& options);

  /// Fills `path`, or `why_not`, of a mesh from its `uri`: package://NAME/..., model://NAME/..., file:///..., or a path
  /// that is relative to `folder`, which is relative to the robot's file; "file:" may stand before it. %20 may stand
  /// for a blank, and so on.
  ///
  /// A package is a folder that is called NAME, or whose package.xml says <name>NAME</name>. It is looked for, in this
  /// order: at each package path, in it, and one level deeper; among the folders above the robot's file and their
  /// neighbours; likewise at the folders of ROS_PACKAGE_PATH, GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH,
  /// GAZEBO_MODEL_PATH and SDF_PATH; in share/ of the folders of AMENT_PREFIX_PATH. Of several folders, the first one
  /// counts that has the file. A file outside of the package that the URI names (by "..") is not found. Throws
  /// InputError(CannotRead) for a file that FileOptions::no_outside_files refuses, wherever symbolic links lead.
  MeshFile find(std::string uri, const Vec3& scale, const std::filesystem::path& folder = {}) const;

  /// Finds the file of a part of the robot's description in this way, and the files that it names.
  MeshFile find_description(std::string uri, const std::filesystem::path& folder = {}) const;

  /// The URI that a robot in `folder` has to name in place of `uri` to find the same file. A relative path that finds
  /// another file from there, or none, becomes a path relative to `folder`. So does model://NAME/..., which was found
  /// beside the robot, unless there are package paths. Every other URI stays as it is.
  std::string uri_from(const std::filesystem::path& folder, const MeshFile& mesh) const;

 private:
  const std::vector<std::filesystem::path>& folders_of(const std::string& package) const;
  std::string looked_in() const;
  MeshFile found(std::string uri, const Vec3& scale, const std::filesystem::path& folder) const;
  [[noreturn]] static void refuse_outside(const MeshFile& file, const std::string& why);
  void require_inside(const MeshFile& file) const;
  void find_in_package(std::string_view inside, std::string_view scheme, MeshFile& mesh) const;

  std::filesystem::path folder_;  // of the robot's file
  std::vector<std::filesystem::path> package_paths_, environment_paths_, prefixes_;
  std::vector<std::filesystem::path> inside_;  // the only folders to read from; empty: all
  mutable std::map<std::string, std::vector<std::filesystem::path>> known_;
};

}  // namespace prohull::robot
