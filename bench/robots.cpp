#include <fmt/format.h>

#include <vector>

#include "command.h"
#include "machine.h"
#include "program.h"
#include "prohull/error.h"
#include "robot/check/check.h"
#include "robot/motion/bodies.h"
#include "sample_robot_files.h"
#include "table.h"

namespace prohull::bench {
namespace {

using namespace prohull::robot;
using std::filesystem::path;

// Hulls of all links of robots, what the robots ship with, and how often hulls collide where the robot does not.

struct RobotsOptions {
  std::vector<path> robots;
  robot::FileOptions file;
  std::vector<std::string> samples;
  std::size_t faces = 500, configurations = 2000;
  path out;
};

double ratio(double a, double b) { return b > 0 ? a / b : kUnknown; }

struct RobotTables {
  Table links{{"robot", "link", "faces", "hull_faces", "certified", "by_part", "by_convex", "distance_mm", "shipped",
               "sticks_out_mm", "shipped_by_part", "shipped_farthest_mm"}};
  Table motion{{"robot", "configurations", "pairs", "visual", "false_hull", "false_convex", "missed", "us_per_visual",
                "us_per_hull"}};
  Table runs{{"robot", "links", "seconds", "second_run_seconds"}};
  std::vector<double> by_part, by_convex;
  std::size_t uncertified = 0, missed = 0;
};

void add_link(const std::string& name, const Link& link, const LinkHulls& made, const LinkCheck& shipped,
              RobotTables& tables) {
  std::vector<std::string> row{as_cell(name), as_cell(link.name)};
  if (made.status == LinkStatus::Hulled) {
    const LinkHull& hull = made.hulls[0];
    const double by_part = ratio(hull.volume, made.sealed_volume), by_convex = ratio(hull.volume, made.convex_volume);
    tables.by_part.push_back(by_part), tables.by_convex.push_back(by_convex);
    tables.uncertified += !hull.certified();
    for (const std::string& cell : {std::to_string(made.triangles.face_count()), std::to_string(hull.mesh.face_count()),
                                    std::string(hull.certified() ? "yes" : "NO"), number(by_part, 3),
                                    number(by_convex, 3), number(1000 * hull.verdict.distance().upper, 3)})
      row.push_back(cell);
  } else {
    row.insert(row.end(), {"", "", std::string(name_of(made.status)), "", "", ""});
  }
  const bool leaks = shipped.verdict == CheckVerdict::Leaks;
  const bool is_measured = leaks || shipped.verdict == CheckVerdict::Covered;
  row.push_back(std::string(name_of(shipped.verdict)));
  row.push_back(leaks ? number(1000 * shipped.sticks_out_at_least, 3) : "");
  row.push_back(is_measured ? number(ratio(shipped.collision_volume, shipped.visual_volume), 3) : "");
  row.push_back(is_measured ? number(1000 * shipped.reach.upper, 3) : "");
  tables.links.add(row);
}

void add_motion(const std::string& name, const MotionResult& motion, RobotTables& tables) {
  std::size_t pairs = 0, visual = 0;
  for (const MotionPair& pair : motion.pairs) pairs += pair.kind != PairKind::Adjacent, visual += pair.visual;
  tables.missed += motion.missed();
  tables.motion.add({as_cell(name), std::to_string(motion.configurations), std::to_string(pairs),
                     std::to_string(visual), std::to_string(motion.false_hull()), std::to_string(motion.false_convex()),
                     std::to_string(motion.missed()), number(motion.visual_us, 2), number(motion.hull_us, 2)});
}

/// The program as a user runs it, twice.
void add_runs(const std::string& name, const path& file, const RobotsOptions& options, const path& folder,
              RobotTables& tables) {
  constexpr ProgramLimits kLimits{.seconds = 600, .address_bytes = std::size_t{16} << 30};
  std::vector<std::string> words{PROHULL_PROGRAM,          "urdf",           file,      "-o",
                                 folder / (name + "_out"), "--skip-missing", "--cache", folder / "cache"};
  for (const path& packages : options.file.package_paths) words.insert(words.end(), {"--package-path", packages});
  const ProgramEnd first = run_program(words, kLimits), second = run_program(words, kLimits);
  if (!second.failure.empty() || second.exit_code > kAnswerIsNo)
    throw InputError(Defect::CannotRead,
                     fmt::format("prohull urdf {} failed: {}", file.string(), fmt::join(second.err, "\n")));
  tables.runs.add({as_cell(name), std::to_string(read_robot(file, options.file).robot.links.size()),
                   number(first.seconds, 1), number(second.seconds, 2)});
}

void measure(const path& path_of_robot, const RobotsOptions& options, const path& folder, RobotTables& tables) {
  const RobotFile file = read_robot(path_of_robot, options.file);
  const std::string name = path_of_robot.stem().string();
  LinkHullOptions how;
  how.budget.faces = {options.faces}, how.skip_missing = true;
  const std::vector<LinkHulls> made = link_hulls(file.robot, how);
  const std::vector<LinkCheck> shipped = check_links(file.robot);
  for (std::size_t i = 0; i < made.size(); ++i)
    if (made[i].status != LinkStatus::Empty) add_link(name, file.robot.links[i], made[i], shipped[i], tables);
  MotionOptions motion;
  motion.configurations = options.configurations;
  add_motion(name, check_motion(file.robot, bodies_of(file.robot, made, Geometry::Visual), motion), tables);
  add_runs(name, path_of_robot, options, folder, tables);
}

int run_robots(const RobotsOptions& options) {
  const WorkFolder folder;
  std::vector<path> robots = options.robots;
  for (const std::string& sample : options.samples) robots.push_back(sample_robot_in(folder.get(), sample));
  RobotTables tables;
  for (const path& robot : robots) measure(robot, options, folder.get(), tables);
  publish(options.out, "robots",
          fmt::format("Hulls of {} faces; volumes by the sealed part and by its convex hull. {}\n\n{}\nMedian volume: "
                      "{:.3f} of the part, {:.3f} of the convex hull. Not certified: {}.\n",
                      options.faces, machine(), tables.links.markdown(), median(tables.by_part),
                      median(tables.by_convex), tables.uncertified),
          tables.links.csv());
  publish(options.out, "robot_motion", "Random configurations, collisions of pairs.\n\n" + tables.motion.markdown(),
          tables.motion.csv());
  publish(options.out, "robot_runs", "`prohull urdf`, wall-clock seconds.\n\n" + tables.runs.markdown(),
          tables.runs.csv());
  return tables.uncertified + tables.missed == 0 ? kDone : kAnswerIsNo;
}

}  // namespace

void add_robots(CLI::App& app, Run& run) {
  const auto options = std::make_shared<RobotsOptions>();
  CLI::App& command = *app.add_subcommand(
      "robots", "Hulls of all links of robots, what the robots ship with, and false collisions in motion");
  command.add_option("--robot", options->robots, "URDF, SDF or MJCF file; may be given several times")
      ->check(CLI::ExistingFile);
  command.add_option("--package-path", options->file.package_paths, "Folder of packages; may be given several times");
  command.add_option("--sample", options->samples, "Bundled robot; may be given several times");
  add_faces_option(command, options->faces);
  command.add_option("--configurations", options->configurations, "Random configurations")->capture_default_str();
  add_out_option(command, options->out, "robots, robot_motion and robot_runs");
  command.callback([options, &run] { run = [options] { return run_robots(*options); }; });
}

}  // namespace prohull::bench
