#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "command.h"
#include "figure.h"
#include "prohull/error.h"
#include "robot/motion/bodies.h"
#include "robot/motion/joint_paths.h"
#include "robot/motion/kinematics.h"
#include "robot/motion/pair_proof.h"
#include "sample_robot_files.h"
#include "table.h"

namespace prohull::bench {
namespace {

using namespace prohull::robot;

// A slice through the positions of a robot's joints: two of them move within their limits, and the others are at rest.

struct SliceOptions {
  std::string sample = "arm";
  std::array<std::string, 2> joints{"joint2", "joint4"};
  std::size_t faces = 500;
  int halvings = 16;
  std::filesystem::path out;
};

enum class Finding { Free, Meets, Open };
constexpr std::array<const char*, 3> kFindings{"free", "meets", "open"};

/// A cell that was not halved. All of it is free, or two links meet in its middle, or neither is known.
struct SliceCell {
  std::array<JointRange, 2> box;
  Finding finding = Finding::Open;
};

using ProofBodies = std::vector<std::optional<ProofBody>>;

class Slice {
 public:
  Slice(Robot robot, const ProofBodies& bodies, const SliceOptions& options)
      : robot_(std::move(robot)), bodies_(bodies), most_halvings_(options.halvings) {
    const std::vector<double> rest = rest_positions(robot_);
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      Joint& joint = robot_.joints[j];
      if (joint.name == options.joints[0]) joints_[0] = &joint;
      if (joint.name == options.joints[1]) joints_[1] = &joint;
      if (std::ranges::count(options.joints, joint.name) == 0) hold(joint, {rest[j], rest[j]});
    }
    for (std::size_t side = 0; side < 2; ++side)
      if (joints_[side] == nullptr || !has_limits(*joints_[side]))
        throw InputError(Defect::InvalidOption,
                         fmt::format("the robot has no joint '{}' with limits", options.joints[side]));
  }

  std::vector<SliceCell> cells() {
    const JointPaths paths(robot_);
    std::vector<LinkPair> pairs;
    for (std::size_t a = 0; a < bodies_.size(); ++a)
      for (std::size_t b = a + 1; b < bodies_.size(); ++b)
        if (bodies_[a] && bodies_[b] && !paths.are_adjacent(a, b)) pairs.emplace_back(a, b);
    const auto limits = [](const Joint* joint) { return JointRange{joint->lower, joint->upper}; };
    look_at({limits(joints_[0]), limits(joints_[1])}, pairs, 0);
    return std::move(cells_);
  }

 private:
  static bool has_limits(const Joint& joint) {
    return moves(joint) && joint.type != JointType::Continuous && std::isfinite(joint.upper - joint.lower);
  }

  static void hold(Joint& joint, const JointRange& range) {
    if (joint.type == JointType::Continuous) joint.type = JointType::Revolute;
    joint.lower = range.lower, joint.upper = range.upper;
  }

  /// Pairs that are free in a cell are free in its halves.
  void look_at(const std::array<JointRange, 2>& box, const std::vector<LinkPair>& pairs, int halvings) {
    for (std::size_t side = 0; side < 2; ++side) hold(*joints_[side], box[side]);
    std::vector<LinkPair> left;
    Finding finding = Finding::Free;
    for (const PairProof& proof : prove_pairs(robot_, bodies_, pairs, {.cells = 1, .threads = 1})) {
      if (proof.verdict == PairVerdict::Never) continue;
      left.emplace_back(proof.a, proof.b);
      if (finding != Finding::Meets) finding = proof.verdict == PairVerdict::Open ? Finding::Open : Finding::Meets;
    }
    if (left.empty() || halvings == most_halvings_) return cells_.push_back({box, finding});
    const std::size_t side = static_cast<std::size_t>(halvings % 2);
    std::array<JointRange, 2> lower = box, upper = box;
    lower[side].upper = upper[side].lower = box[side].middle();
    look_at(lower, left, halvings + 1);
    look_at(upper, left, halvings + 1);
  }

  Robot robot_;
  const ProofBodies& bodies_;
  const int most_halvings_;
  std::array<Joint*, 2> joints_{};
  std::vector<SliceCell> cells_;
};

Table table_of(const std::vector<SliceCell>& cells, const SliceOptions& options) {
  Table table{{options.joints[0] + "_lower", options.joints[0] + "_upper", options.joints[1] + "_lower",
               options.joints[1] + "_upper", "finding"}};
  for (const SliceCell& cell : cells) {
    const auto& [x, y] = cell.box;
    table.add({number(x.lower, 6), number(x.upper, 6), number(y.lower, 6), number(y.upper, 6),
               kFindings[static_cast<std::size_t>(cell.finding)]});
  }
  return table;
}

/// Of the area of the slice.
std::array<double, 3> shares_of(const std::vector<SliceCell>& cells) {
  std::array<double, 3> areas{};
  double all = 0;
  for (const SliceCell& cell : cells) {
    const double area = (cell.box[0].upper - cell.box[0].lower) * (cell.box[1].upper - cell.box[1].lower);
    areas[static_cast<std::size_t>(cell.finding)] += area, all += area;
  }
  for (double& area : areas) area /= all;
  return areas;
}

int run_slice(const SliceOptions& options) {
  const WorkFolder folder;
  const RobotFile file = read_robot(sample_robot_in(folder.get(), options.sample), {});
  LinkHullOptions how;
  how.budget.faces = {options.faces};
  const Bodies bodies = bodies_of(file.robot, link_hulls(file.robot, how), Geometry::Visual);
  ProofBodies proven(bodies.hull.size());
  for (std::size_t link = 0; link < proven.size(); ++link)
    if (bodies.hull[link].face_count() > 0) proven[link].emplace(bodies.hull[link]);
  const std::vector<SliceCell> cells = Slice(file.robot, proven, options).cells();
  const auto [free, meets, open] = shares_of(cells);
  publish(options.out, "joint_slice",
          fmt::format("Positions of {} and {} of the sample {}, hulls of {} faces, in {} cells: proven free {:.2f} %, "
                      "links meet in the middle of the cell {:.2f} %, open {:.2f} %.\n",
                      options.joints[0], options.joints[1], options.sample, options.faces, cells.size(), 100 * free,
                      100 * meets, 100 * open),
          table_of(cells, options).csv());
  if (!options.out.empty()) draw_figure(options.out / "joint_slice.csv");
  return kDone;
}

}  // namespace

void add_joint_slice(CLI::App& app, Run& run) {
  const auto options = std::make_shared<SliceOptions>();
  CLI::App& command = *app.add_subcommand(
      "joint-slice",
      "Where two joints of a robot are proven free, where links meet, and what stays open; with a picture");
  command.add_option("--sample", options->sample, "Bundled robot")->capture_default_str();
  command.add_option("--joints", options->joints, "The two joints that move; the others are at rest")->delimiter(',');
  add_faces_option(command, options->faces);
  command.add_option("--halvings", options->halvings, "How often a cell is halved at most")
      ->check(CLI::Range(0, 20))
      ->capture_default_str();
  add_out_option(command, options->out, "joint_slice");
  command.callback([options, &run] { run = [options] { return run_slice(*options); }; });
}

}  // namespace prohull::bench
