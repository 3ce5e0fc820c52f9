#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <vector>

#include "command.h"
#include "machine.h"
#include "motion_attack.h"
#include "robot/motion/bodies.h"
#include "robot/motion/joint_chain.h"
#include "robot/motion/joint_paths.h"
#include "robot/motion/pair_proof.h"
#include "robot/motion/path_proof.h"
#include "robot/motion/sampling.h"
#include "sample_robot_files.h"
#include "table.h"

namespace prohull::bench {
namespace {

using namespace prohull::robot;
using std::filesystem::path;

// What is proven about pairs of links that no joint connects, and about paths, on hulls of the links.

struct MotionBenchOptions {
  std::vector<path> robots;
  robot::FileOptions file;
  std::vector<std::string> samples;
  double beside = 0;
  std::size_t faces = 500;
  ProofOptions proof;
  std::size_t paths = 50;
  PathProofOptions path_proof{.threads = 1};
  AttackOptions attack;
  path out;
};

struct Decided {
  std::size_t all = 0, decided = 0;
};

/// What is decided of pairs and of paths, each with a row of its own.
struct Found {
  Table pairs{{"robot", "link", "other", "verdict", "proven_free_pct", "cells", "cpu_seconds"}};
  Table paths{{"robot", "path", "verdict", "cells", "cpu_seconds"}};
  Table robots{{"robot", "pairs", "decided", "free", "median of cells", "median of seconds"}};
  Table attacks{{"robot", "never", "poses", "climbs", "contradictions", "least_mm", "witnesses", "confirmed",
                 "surfaces_meet", "fcl_agrees"}};
  Attack attack;
  Decided decided_pairs, decided_paths;
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

void add_attack(const std::string& name, const Attack& attack, Table& table) {
  const auto cell = [](std::size_t n) { return std::to_string(n); };
  table.add({name, cell(attack.never), cell(attack.poses), cell(attack.climbs), cell(attack.contradictions),
             number(1000 * attack.least, 3), cell(attack.witnesses), cell(attack.confirmed), cell(attack.by_surfaces),
             cell(attack.by_fcl)});
}

void measure_pairs(const std::string& name, const Robot& robot, const Bodies& bodies, const MotionBenchOptions& options,
                   Found& found) {
  std::vector<PairProof> proofs;
  for (const LinkPair& pair : pairs_of(robot, bodies)) {
    PairProof proof;
    const double seconds =
        seconds_of([&] { proof = prove_pairs(robot, bodies.hull, std::span(&pair, 1), options.proof).front(); });
    ++found.decided_pairs.all, found.decided_pairs.decided += proof.verdict != PairVerdict::Open;
    found.pairs.add({name, as_cell(robot.links[pair.first].name), as_cell(robot.links[pair.second].name),
                     std::string(name_of(proof.verdict)), number(100 * proof.proven_free, 2),
                     std::to_string(proof.cells), number(seconds, 3)});
    proofs.push_back(std::move(proof));
  }
  const Attack attacked = attack(robot, bodies, proofs, options.attack);
  add_attack(name, attacked, found.attacks);
  found.attack += attacked;
}

/// From one position of all joints straight to another one.
JointPath path_between(const Robot& robot, std::span<const double> from, std::span<const double> to) {
  PathRows rows{.joints = {}, .positions = std::vector<std::vector<double>>(2)};
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const Joint& joint = robot.joints[j];
    if (joint.mimic || !moves(joint)) continue;
    rows.joints.push_back(joint.name);
    rows.positions[0].push_back(from[j]), rows.positions[1].push_back(to[j]);
  }
  return JointPath(robot, std::move(rows));
}

/// Those that do not meet at rest, as a user's SRDF leaves them.
std::vector<BodyPair> free_at_rest(const Robot& robot, const std::vector<PathBody>& bodies) {
  const std::vector<BodyPair> pairs = pairs_on_path(robot, bodies);
  const std::vector<double> rest = rest_positions(robot);
  const JointPath path = path_between(robot, rest, rest);
  const std::vector<PathProof> proofs = prove_paths(robot, {&path, 1}, bodies, pairs);
  std::vector<BodyPair> free;
  for (const PathPairProof& pair : proofs.front().pairs)
    if (pair.verdict == PathVerdict::Free) free.emplace_back(pair.a, pair.b);
  return free;
}

void measure_paths(const std::string& name, const Robot& robot, const Bodies& bodies, const MotionBenchOptions& options,
                   Found& found) {
  std::vector<PathBody> moved;
  for (std::size_t link = 0; link < bodies.hull.size(); ++link)
    if (bodies.hull[link].face_count() > 0) moved.push_back(path_body(robot.links[link].name, link, bodies.hull[link]));
  const std::vector<BodyPair> pairs = free_at_rest(robot, moved);
  Decided decided;
  std::size_t free = 0;
  std::vector<double> cells, times;
  for (std::size_t i = 0; i < options.paths && !pairs.empty(); ++i) {
    const JointPath path =
        path_between(robot, random_positions(robot, 1, 2 * i), random_positions(robot, 1, 2 * i + 1));
    PathProof proof;
    const double seconds = seconds_of([&] {
      proof = prove_paths(robot, {&path, 1}, moved, pairs, options.path_proof).front();
    });
    ++decided.all, decided.decided += proof.verdict() != PathVerdict::Open;
    free += proof.verdict() == PathVerdict::Free;
    cells.push_back(static_cast<double>(proof.cells())), times.push_back(seconds);
    found.paths.add({name, std::to_string(i), std::string(name_of(proof.verdict())), std::to_string(proof.cells()),
                     number(seconds, 4)});
  }
  found.decided_paths.all += decided.all, found.decided_paths.decided += decided.decided;
  found.robots.add({name, std::to_string(pairs.size()), fmt::format("{} of {}", decided.decided, decided.all),
                    std::to_string(free), number(median(cells), 0), number(median(times), 4)});
}

/// The robot, and a copy of it beside it on one root: such as two arms on a table. Their names end in 1 and 2.
Robot two_of(const Robot& one, double apart) {
  Robot both{.name = one.name + "_twice", .links = {{.name = "table"}}};
  for (std::size_t copy = 0; copy < 2; ++copy) {
    const std::size_t first_link = both.links.size(), first_joint = both.joints.size() + 1;
    const std::string number = std::to_string(copy + 1);
    both.joints.push_back({.name = "mount" + number, .parent = 0, .child = first_link + root_of(one, 0)});
    both.joints.back().origin.translation.x = static_cast<double>(copy) * apart;
    for (Link link : one.links) link.name += number, both.links.push_back(std::move(link));
    for (Joint joint : one.joints) {
      joint.name += number, joint.parent += first_link, joint.child += first_link;
      if (joint.mimic) joint.mimic->joint += first_joint;
      both.joints.push_back(std::move(joint));
    }
  }
  return both;
}

void measure(const path& path_of_robot, const MotionBenchOptions& options, Found& found) {
  Robot robot = read_robot(path_of_robot, options.file).robot;
  if (options.beside > 0) robot = two_of(robot, options.beside);
  LinkHullOptions how;
  how.budget.faces = {options.faces}, how.skip_missing = true;
  const Bodies bodies = bodies_of(robot, link_hulls(robot, how), Geometry::Visual);
  const std::string name = as_cell(path_of_robot.stem().string() + (options.beside > 0 ? "_twice" : ""));
  measure_pairs(name, robot, bodies, options, found);
  measure_paths(name, robot, bodies, options, found);
}

int run_motion(const MotionBenchOptions& options) {
  const WorkFolder folder;
  std::vector<path> robots = options.robots;
  for (const std::string& sample : options.samples) robots.push_back(sample_robot_in(folder.get(), sample));
  Found found;
  for (const path& robot : robots) measure(robot, options, found);
  publish(options.out, "motion_pairs",
          fmt::format("Pairs of links that no joint connects, hulls of {} faces, at most {} cells of a pair, one pair "
                      "after the other. {}\n\n{}\nDecided: {} of {}.\n",
                      options.faces, options.proof.cells, machine(), found.pairs.markdown(),
                      found.decided_pairs.decided, found.decided_pairs.all),
          found.pairs.csv());
  publish(
      options.out, "motion_paths",
      fmt::format("Paths from a random position of all joints straight to another one, hulls of {} faces, pairs "
                  "that do not meet at rest, at most {} cells of a pair, on one thread. {}\n\n{}\nDecided: {} of {}.\n",
                  options.faces, options.path_proof.cells, machine(), found.robots.markdown(),
                  found.decided_paths.decided, found.decided_paths.all),
      found.paths.csv());
  publish(options.out, "motion_attack",
          fmt::format("Random poses of pairs that are proven never to meet, and climbs from random positions to ever "
                      "smaller distances, hulls of {} faces; and the positions at which pairs meet, by collide and by "
                      "FCL, which knows surfaces only. {}\n\n{}\nContradictions: {}.\n",
                      options.faces, machine(), found.attacks.markdown(), found.attack.contradictions),
          found.attacks.csv());
  const bool is_wrong = found.attack.contradictions > 0 || found.attack.confirmed < found.attack.witnesses;
  return is_wrong ? kAnswerIsNo : kDone;
}

}  // namespace

void add_motion(CLI::App& app, Run& run) {
  const auto options = std::make_shared<MotionBenchOptions>();
  CLI::App& command = *app.add_subcommand(
      "motion", "What is proven about pairs of links, and about paths: they never meet, or they meet, or neither");
  command.add_option("--robot", options->robots, "URDF, SDF or MJCF file; may be given several times")
      ->check(CLI::ExistingFile);
  command.add_option("--package-path", options->file.package_paths, "Folder of packages; may be given several times");
  command.add_option("--sample", options->samples, "Bundled robot; may be given several times");
  command.add_option("--beside", options->beside, "Measure each robot and a copy of it so many metres beside it");
  add_faces_option(command, options->faces);
  command.add_option("--prove", options->proof.cells, "Largest number of cells of a pair")->capture_default_str();
  command.add_option("--paths", options->paths, "Random paths of each robot")->capture_default_str();
  command.add_option("--cells", options->path_proof.cells, "Largest number of cells of a pair on a path")
      ->capture_default_str();
  command.add_option("--poses", options->attack.poses, "Random poses of pairs that never meet")->capture_default_str();
  command.add_option("--climbs", options->attack.climbs, "Searches of poses in which such pairs are close")
      ->capture_default_str();
  add_out_option(command, options->out, "motion_pairs, motion_paths and motion_attack");
  command.callback([options, &run] { run = [options] { return run_motion(*options); }; });
}

}  // namespace prohull::bench
