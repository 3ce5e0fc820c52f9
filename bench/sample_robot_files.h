#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/triangle_mesh.h"
#include "robot/files/robot_file.h"

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

/// Robots whose links are measured one by one.
struct LinkSources {
  std::vector<std::filesystem::path> robots;
  robot::FileOptions file;
  std::vector<std::string> samples;
};
void add_link_options(CLI::App& command, LinkSources& sources);

struct VisualLink {
  std::string robot, name;
  TriangleMesh mesh;  ///< of its visual geometry
};

/// All links that have visual geometry, those of the files first. What cannot be read is told on stderr.
void visit_visual_links(const LinkSources& sources, const std::function<void(const VisualLink&)>& visit);

}  // namespace prohull::bench
