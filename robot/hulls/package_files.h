#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "robot/files/mesh_references.h"
#include "robot/files/packages.h"
#include "robot/files/robot_file.h"
#include "robot/hulls/file_names.h"

namespace prohull::robot {

/// A file of the robot that is written.
struct OutputFile {
  std::filesystem::path path;  ///< relative to the folder of the robot
  std::function<void(const std::filesystem::path&)> write;
};

/// Copies of the files that a robot names, which make a package out of its new folder. Meshes and images, and the
/// materials, images and buffers that mesh files name, are in meshes/visual, and others in files. Their names are
/// distinct and plain, and mesh files name them so. Files with the same bytes are one.
class PackageFiles {
 public:
  PackageFiles(const RobotFile& file, std::string package);

  /// The URI of the copy; `uri` itself if there is no such file on this machine, or if it is a robot of its own.
  /// Throws InputError(CannotRead) for what FileOptions::no_outside_files refuses.
  std::string uri_of(const std::string& uri);

  const std::vector<OutputFile>& files() const { return files_; }
  /// The copies by what they were made of, as MeshFile::path says it.
  const std::map<std::filesystem::path, std::filesystem::path>& copies() const { return copies_; }
  /// What is named as before, because it is not copied: a URI, or "wood.png of base.dae".
  const std::set<std::string>& left() const { return left_; }

 private:
  struct Content {
    std::filesystem::path source;
    std::vector<XmlEdit> edits;
  };

  std::filesystem::path copy_of(const std::filesystem::path& source);
  std::vector<XmlEdit> edits_of(const std::filesystem::path& source);
  std::filesystem::path found_beside(const std::filesystem::path& source, const std::string& name) const;
  std::filesystem::path placed(Content content);

  const Packages packages_;
  const std::string package_;
  FileNames names_;
  std::vector<Content> contents_;  // of files_
  std::vector<OutputFile> files_;
  std::map<std::filesystem::path, std::filesystem::path> copies_;
  std::set<std::string> left_;
};

}  // namespace prohull::robot
