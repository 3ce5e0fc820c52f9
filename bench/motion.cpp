#include <fmt/format.h>

#include <vector>

#include "command.h"
#include "machine.h"
#include "robot/motion/bodies.h"
#include "robot/motion/joint_paths.h"
#include "robot/motion/pair_proof.h"
#include "sample_robot_files.h"
#include "table.h"

namespace prohull::bench {
namespace {

using namespace prohull::robot;
using std::filesystem::path;

// What is proven about pairs of links that no joint connects, on their hulls.

struct MotionBenchOptions {
  std::vector<path> robots;
  robot::FileOptions file;
  std::vector<std::string> samples;
  std::size_t faces = 500;
  ProofOptions proof;
  path out;
};

struct Decided {
  std::size_t pairs = 0, decided = 0;
};

std::vector<LinkPair> pairs_of(const Robot& robot, const Bodies& bodies) {
  const JointPaths paths(robot);
  std::vector<LinkPair> pairs;
  for (std::size_t a = 0; a < bodies.hull.size(); ++a)
    for (std::size_t b = a + 1; b < bodies.hull.size(); ++b)
      if (bodies.hull[a].face_count() > 0 && bodies.hull[b].face_count() > 0 && !paths.are_adjacent(a, b))
        pairs.emplace_back(a, b);
  return pairs;
}

void measure(const path& path_of_robot, const MotionBenchOptions& options, Table& table, Decided& all) {
  const RobotFile file = read_robot(path_of_robot, options.file);
  const Robot& robot = file.robot;
  LinkHullOptions how;
  how.budget.faces = {options.faces}, how.skip_missing = true;
  const Bodies bodies = bodies_of(robot, link_hulls(robot, how), Geometry::Visual);
  for (const LinkPair& pair : pairs_of(robot, bodies)) {
    PairProof proof;
    const double seconds =
        seconds_of([&] { proof = prove_pairs(robot, bodies.hull, std::span(&pair, 1), options.proof).front(); });
    ++all.pairs, all.decided += proof.verdict != PairVerdict::Open;
    table.add({as_cell(path_of_robot.stem().string()), as_cell(robot.links[pair.first].name),
               as_cell(robot.links[pair.second].name), std::string(name_of(proof.verdict)),
               number(100 * proof.proven_free, 2), std::to_string(proof.cells), number(seconds, 3)});
  }
}

int run_motion(const MotionBenchOptions& options) {
  const WorkFolder folder;
  std::vector<path> robots = options.robots;
  for (const std::string& sample : options.samples) robots.push_back(sample_robot_in(folder.get(), sample));
  Table table{{"robot", "link", "other", "verdict", "proven_free_pct", "cells", "cpu_seconds"}};
  Decided all;
  for (const path& robot : robots) measure(robot, options, table, all);
  publish(options.out, "motion_pairs",
          fmt::format("Pairs of links that no joint connects, hulls of {} faces, at most {} cells of a pair, one pair "
                      "after the other. {}\n\n{}\nDecided: {} of {}.\n",
                      options.faces, options.proof.cells, machine(), table.markdown(), all.decided, all.pairs),
          table.csv());
  return kDone;
}

}  // namespace

void add_motion(CLI::App& app, Run& run) {
  const auto options = std::make_shared<MotionBenchOptions>();
  CLI::App& command =
      *app.add_subcommand("motion", "What is proven about pairs of links: they never meet, or they meet, or neither");
  command.add_option("--robot", options->robots, "URDF, SDF or MJCF file; may be given several times")
      ->check(CLI::ExistingFile);
  command.add_option("--package-path", options->file.package_paths, "Folder of packages; may be given several times");
  command.add_option("--sample", options->samples, "Bundled robot; may be given several times");
  add_faces_option(command, options->faces);
  command.add_option("--prove", options->proof.cells, "Largest number of cells of a pair")->capture_default_str();
  add_out_option(command, options->out, "motion_pairs");
  command.callback([options, &run] { run = [options] { return run_motion(*options); }; });
}

}  // namespace prohull::bench
