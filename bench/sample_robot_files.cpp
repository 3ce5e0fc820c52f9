#include "sample_robot_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>

#include "prohull/mesh_io.h"
#include "robot/samples/sample_robots.h"

namespace prohull::bench {

using std::filesystem::path;

WorkFolder::WorkFolder() : path_(std::filesystem::temp_directory_path() / fmt::format("prohull-robots-{}", getpid())) {
  std::filesystem::create_directories(path_);
}

WorkFolder::~WorkFolder() { std::filesystem::remove_all(path_); }

path sample_robot_in(const path& folder, std::string_view name) {
  const robot::SampleRobot robot = robot::make_sample_robot(name);
  const path home = folder / name;
  for (const auto& [file, mesh] : robot.meshes) {
    std::filesystem::create_directories((home / file).parent_path());
    write_mesh(home / file, mesh);
  }
  const path file = home / fmt::format("{}.urdf", name);
  std::ofstream(file) << robot.urdf;
  return file;
}

}  // namespace prohull::bench
