#include "sample_robot_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>

#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "robot/link_triangles.h"
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

void add_link_options(CLI::App& command, LinkSources& sources) {
  command.add_option("--robot", sources.robots, "URDF, SDF or MJCF file; may be given several times")
      ->check(CLI::ExistingFile);
  command.add_option("--package-path", sources.file.package_paths, "Folder of packages; may be given several times");
  command.add_option("--sample", sources.samples, "Bundled robot; may be given several times");
}

void visit_visual_links(const LinkSources& sources, const std::function<void(const VisualLink&)>& visit) {
  const WorkFolder folder;
  std::vector<std::filesystem::path> robots = sources.robots;
  for (const std::string& sample : sources.samples) robots.push_back(sample_robot_in(folder.get(), sample));
  for (const std::filesystem::path& path : robots)
    for (const robot::Link& link : robot::read_robot(path, sources.file).robot.links) try {
        const VisualLink found{path.stem().string(), link.name, robot::link_triangles(link.visual, {})};
        if (found.mesh.face_count() > 0) visit(found);
      } catch (const InputError& error) {
        fmt::print(stderr, "{}: left out, {}\n", link.name, error.what());
      }
}

}  // namespace prohull::bench
