#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "peers.h"
#include "robot/check/check.h"
#include "robot/files/robot_file.h"
#include "table.h"

namespace prohull::bench {
namespace {

// Which links of robots have collision meshes that do not cover their visual meshes? Of each leak, CGAL is asked as
// well: it shares no code with the check.

struct LeaksOptions {
  std::vector<std::filesystem::path> robots;
  std::vector<std::filesystem::path> package_paths;
  std::filesystem::path out;
};

struct SecondOpinion {
  PointsOutside vertices;         ///< of the visual geometry
  bool worst_is_outside = false;  ///< the point that the check found
};

/// Nothing if CGAL is not there, or does not take the collision geometry: it asks for one closed 2-manifold.
std::optional<SecondOpinion> second_opinion(const robot::LinkCheck& check) {
  if (check.verdict == robot::CheckVerdict::Missing || check.pieces != 1) return std::nullopt;
  const auto vertices = points_outside(check.visual.positions, check.collision);
  const auto worst = points_outside({&check.worst_point, 1}, check.collision);
  if (!vertices || !worst) return std::nullopt;
  return SecondOpinion{*vertices, worst->count == 1};
}

/// A vertex that CGAL finds outside must not be farther than we have proven, and the worst point must be outside.
/// Points have been moved into the frame of the link, which rounds them.
bool agrees(const robot::LinkCheck& check, const SecondOpinion& opinion) {
  constexpr double kRounding = 1e-12;
  if (opinion.vertices.farthest > check.sticks_out_at_most + kRounding) return false;
  return check.sticks_out_at_least <= kRounding || opinion.worst_is_outside;
}

std::string millimetres(double metres) { return number(metres * 1000, 4); }

int run_leaks(const LeaksOptions& options) {
  Table table({"robot", "link", "verdict", "sticks out mm", "at most mm", "faces outside", "visual faces",
               "collision faces", "CGAL: vertices outside", "CGAL: farthest mm"});
  Table csv({"robot", "link", "verdict", "sticks_out_at_least_mm", "sticks_out_at_most_mm", "faces_outside",
             "visual_faces", "collision_faces", "cgal_vertices_outside", "cgal_farthest_mm"});
  std::size_t asked = 0, agreed = 0;
  for (const std::filesystem::path& path : options.robots) {
    const robot::RobotFile file = robot::read_robot(path, {.package_paths = options.package_paths});
    for (const robot::LinkCheck& check : robot::check_links(file.robot)) {
      if (check.verdict == robot::CheckVerdict::NoVisual) continue;
      const auto opinion = second_opinion(check);
      asked += opinion.has_value();
      agreed += opinion && agrees(check, *opinion);
      const std::vector<std::string> cells{as_cell(path.stem().string()),
                                           as_cell(file.robot.links[check.link].name),
                                           std::string(robot::name_of(check.verdict)),
                                           millimetres(check.sticks_out_at_least),
                                           millimetres(check.sticks_out_at_most),
                                           fmt::to_string(check.faces_outside),
                                           fmt::to_string(check.visual_faces),
                                           fmt::to_string(check.collision_faces),
                                           opinion ? fmt::to_string(opinion->vertices.count) : "",
                                           opinion ? millimetres(opinion->vertices.farthest) : ""};
      table.add(cells);
      csv.add(cells);
    }
  }
  const std::string text = fmt::format(
      "# Leaks of collision meshes that are shipped\n\nCGAL's exact predicates were asked about {} links and agree "
      "about "
      "{}; they ask for one closed 2-manifold.\n\n{}",
      asked, agreed, table.markdown());
  publish(options.out, "leaks", text, csv.csv());
  return asked == agreed ? kDone : kAnswerIsNo;
}

}  // namespace

void add_leaks(CLI::App& app, Run& run) {
  const auto options = std::make_shared<LeaksOptions>();
  CLI::App& command = *app.add_subcommand(
      "leaks", "Links whose collision meshes do not cover their visual meshes; exits with 1 if CGAL disagrees");
  command.add_option("robots", options->robots, "Files of robots")->required()->check(CLI::ExistingFile);
  command.add_option("--package-path", options->package_paths, "Folders in which packages are looked for");
  add_out_option(command, options->out, "leaks.md and leaks.csv");
  command.callback([options, &run] { run = [options] { return run_leaks(*options); }; });
}

}  // namespace prohull::bench
