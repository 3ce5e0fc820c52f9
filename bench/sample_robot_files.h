#pragma once

#include <filesystem>
#include <string_view>

namespace prohull::bench {

/// A folder for robots and what the program makes of them; it vanishes with the object.
class WorkFolder {
 public:
  WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder();
  const std::filesystem::path& get() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Writes a bundled robot and its meshes to a folder; returns its URDF file.
std::filesystem::path sample_robot_in(const std::filesystem::path& folder, std::string_view name);

}  // namespace prohull::bench
