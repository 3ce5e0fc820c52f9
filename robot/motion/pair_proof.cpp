#include "robot/motion/pair_proof.h"

#include <algorithm>
#include <functional>
#include <queue>

#include "prohull/detail/progress_meter.h"
#include "robot/motion/kinematics.h"

namespace prohull::robot {
namespace {

/// Ranges of all freedoms, and what is known there.
struct PoseCell {
  std::vector<JointRange> box;
  double distance = 0;                 // in the middle, of faces that may meet in the cell
  double share = 1;                    // of all positions
  std::size_t number = 0;              // in the order in which they were made
  std::size_t widest = 0;              // the freedom that can change the distance most
  bool may_be_smaller = false;         // otherwise rounding decides, and it stays open
  std::optional<NearParts> near = {};  // in the middle, or in that of a larger cell
};

struct IsLater {
  bool operator()(const PoseCell& x, const PoseCell& y) const {
    return std::pair(x.distance, x.number) > std::pair(y.distance, y.number);
  }
};

/// Where the cells are used up, there is one step downhill for so many of them.
constexpr std::size_t kCellsForAStep = 8;

/// Cells in which so many pairs of leaves are looked at count as two.
constexpr std::size_t kLeafPairsOfACell = 256;

class PairSearch {
 public:
  PairSearch(const Robot& robot, const LinkPair& pair, const ProofBody& a, const ProofBody& b,
             const ProofOptions& options)
      : robot_(robot),
        a_(a),
        b_(b),
        chain_(robot, pair.first, pair.second, a.corners, b.corners),
        most_cells_(options.cells),
        record_(options.keep_trees, chain_.freedoms().size()) {
    result_.a = pair.first, result_.b = pair.second;
    for (std::size_t j = 0; j < robot.joints.size(); ++j)
      if (robot.joints[j].mimic && std::ranges::count(chain_.freedoms(), leader_of(robot, j).joint) > 0)
        followers_.push_back(j);
  }

  PairProof run(ProgressMeter& meter) {
    result_.why = chain_.obstacle();
    if (!result_.why.empty()) return result_;
    const auto ranges = chain_.ranges();
    look_at({.box = {ranges.begin(), ranges.end()}});
    while (result_.verdict == PairVerdict::Open && !open_.empty()) {
      const PoseCell cell = open_.top();
      if (work_ + 2 > most_cells_) {
        look_downhill(meter);
        return result_.verdict == PairVerdict::Open ? stopped("the number of cells is used up") : result_;
      }
      if (!cell.may_be_smaller) return stopped("rounding hides whether they touch");
      open_.pop();
      meter.go_on();
      halve(cell);
    }
    if (result_.verdict != PairVerdict::Open) return result_;
    if (touches_) return stopped(kTouchesMesh);
    set_never();
    return result_;
  }

 private:
  PairProof stopped(std::string why) {
    result_.why = std::move(why);
    return result_;
  }

  void set_never() {
    result_.verdict = PairVerdict::Never, result_.proven_free = 1;
    result_.tree = record_.tree();
    if (result_.tree.empty()) return;
    result_.freedoms.assign(chain_.freedoms().begin(), chain_.freedoms().end());
    result_.ranges.assign(chain_.ranges().begin(), chain_.ranges().end());
  }

  void halve(const PoseCell& cell) {
    record_.halve(cell.number, cell.widest, result_.cells);
    const JointRange range = cell.box[cell.widest];
    for (const JointRange& half : {JointRange{range.lower, range.middle()}, JointRange{range.middle(), range.upper}}) {
      PoseCell part = cell;
      part.box[cell.widest] = half, part.share /= 2;
      look_at(std::move(part));
      if (result_.verdict != PairVerdict::Open) return;
    }
  }

  void look_at(PoseCell cell) {
    cell.number = result_.cells++, ++work_;
    const JointChain::Motion motion = chain_.motion(cell.box);
    cell.distance = distance_of_balls(a_, b_, motion.pose, chain_.rounding());
    if (cell.distance > motion.change + chain_.rounding() || stay_apart(cell, motion)) {
      result_.proven_free += cell.share;
      return;
    }
    const Closest closest = closest_parts(a_, b_, motion.pose, just_above(chain_.rounding()));
    cell.distance = norm(cell.near->faces.way);
    if (closest.separation.collide() && look_within(cell, motion, closest)) return;
    const std::vector<double> parts = chain_.parts_at(cell.near->faces, cell.box);
    const auto widest = std::ranges::max_element(parts);
    cell.widest = static_cast<std::size_t>(widest - parts.begin());
    cell.may_be_smaller = widest != parts.end() && *widest > chain_.rounding();
    open_.push(std::move(cell));
  }

  bool stay_apart(PoseCell& cell, const JointChain::Motion& motion) {
    std::size_t leaf_pairs = 0;
    const auto before = cell.near;
    const bool is_free = robot::stay_apart(a_, b_, motion, 0, cell.near, leaf_pairs);
    work_ += leaf_pairs / kLeafPairsOfACell;
    if (is_free && record_.is_kept() && !may_be_checked(motion, before)) record_.give_up();
    return is_free;
  }

  /// A checker rounds in another way.
  bool may_be_checked(const JointChain::Motion& motion, std::optional<NearParts> near) const {
    std::size_t leaf_pairs = 0;
    return robot::stay_apart(a_, b_, motion, chain_.rounding(), near, leaf_pairs);
  }

  /// Where meshes around the bodies meet. Returns whether nothing more is to be found in the cell.
  bool look_within(PoseCell& cell, const JointChain::Motion& motion, const Closest& around) {
    const Closest closest = is_curved() ? closest_within(a_, b_, motion.pose, just_above(motion.change)) : around;
    if (closest.separation.collide() && is_within_limits(cell)) {
      meets_at(cell, motion.pose, around);
      return true;
    }
    cell.distance = closest.separation.lower;
    const bool touches = is_curved() && cell.distance > motion.change;
    touches_ |= touches;
    return touches;
  }

  bool is_curved() const { return !a_.within.empty() || !b_.within.empty(); }

  /// A place where the links are close without meeting can use up all cells, as those of small distance come first.
  /// Positions at which they meet are then found from the cells that are left, the largest first.
  void look_downhill(ProgressMeter& meter) {
    std::vector<PoseCell> left;
    for (; !open_.empty(); open_.pop()) left.push_back(open_.top());
    std::ranges::stable_sort(left, std::greater(), &PoseCell::share);
    steps_left_ = most_cells_ / kCellsForAStep;
    for (const PoseCell& cell : left) {
      if (may_step()) descend(cell, meter);
    }
  }

  bool may_step() const { return result_.verdict == PairVerdict::Open && steps_left_ > 0; }

  /// From the middle of the cell, along one joint at a time.
  void descend(PoseCell at, ProgressMeter& meter) {
    constexpr int kHalvings = 8;  // of a step
    std::vector<double> steps;
    for (JointRange& range : at.box) {
      steps.push_back((range.upper - range.lower) / 2);
      range = {range.middle(), range.middle()};
    }
    for (int i = 0; i < kHalvings; ++i) {
      while (steps_down(at, steps)) meter.go_on();
      for (double& step : steps) step /= 2;
    }
  }

  /// Takes the first step that makes the distance less, if there is one.
  bool steps_down(PoseCell& at, std::span<const double> steps) {
    for (std::size_t f = 0; f < steps.size(); ++f)
      for (const double step : {steps[f], -steps[f]}) {
        if (!may_step()) return false;
        --steps_left_;
        PoseCell next = at;
        const JointRange& range = chain_.ranges()[f];
        const double position = std::clamp(at.box[f].middle() + step, range.lower, range.upper);
        next.box[f] = {position, position};
        if (!is_closer(next, at.distance)) continue;
        at = std::move(next);
        return true;
      }
    return false;
  }

  /// Whether the distance in the cell, which is set, is less. Says so if the links meet there.
  bool is_closer(PoseCell& cell, double distance) {
    const Pose pose = chain_.motion(cell.box).pose;
    const Closest closest = closest_within(a_, b_, pose, distance);
    if (closest.separation.collide() && is_within_limits(cell)) meets_at(cell, pose, closest_parts(a_, b_, pose));
    cell.distance = closest.separation.lower;
    return cell.distance < distance;
  }

  /// The positions of all joints where the freedoms are in the middle of the cell.
  std::vector<double> positions_in(const PoseCell& cell) const {
    std::vector<double> positions = rest_positions(robot_);
    for (std::size_t f = 0; f < cell.box.size(); ++f) positions[chain_.freedoms()[f]] = cell.box[f].middle();
    follow(robot_, positions);
    return positions;
  }

  /// The ranges of the freedoms are rounded outwards where others follow.
  bool is_within_limits(const PoseCell& cell) const {
    const std::vector<double> positions = positions_in(cell);
    return std::ranges::all_of(followers_, [&](std::size_t j) {
      return !moves(robot_.joints[j]) || own_limits(robot_.joints[j]).contains(positions[j]);
    });
  }

  void meets_at(const PoseCell& cell, const Pose& pose, const Closest& closest) {
    result_.verdict = cell.box.empty() ? PairVerdict::Always : PairVerdict::Meets;
    result_.positions = positions_in(cell);
    result_.faces = first_faces(a_, b_, pose, closest);
  }

  const Robot& robot_;
  const ProofBody &a_, &b_;
  const JointChain chain_;
  std::vector<std::size_t> followers_;  // joints that follow the freedoms
  const std::size_t most_cells_;
  std::priority_queue<PoseCell, std::vector<PoseCell>, IsLater> open_;
  std::size_t work_ = 0;  // in cells
  std::size_t steps_left_ = 0;
  bool touches_ = false;  // somewhere it is the mesh around a curved shape that meets, and nowhere near the shape
  CellRecord record_;
  PairProof result_;
};

}  // namespace

std::string_view name_of(PairVerdict verdict) {
  constexpr std::string_view kNames[]{"never", "always", "meets", "open", "unknown", "adjacent", "no-geometry"};
  return kNames[static_cast<std::size_t>(verdict)];
}

std::vector<PairProof> prove_pairs(const Robot& robot, std::span<const TriangleMesh> links,
                                   std::span<const LinkPair> pairs, const ProofOptions& options) {
  std::vector<std::optional<ProofBody>> bodies(links.size());
  for (const auto& [a, b] : pairs)
    for (const std::size_t link : {a, b})
      if (!bodies[link]) bodies[link].emplace(links[link]);
  return prove_pairs(robot, bodies, pairs, options);
}

std::vector<PairProof> prove_pairs(const Robot& robot, std::span<const std::optional<ProofBody>> links,
                                   std::span<const LinkPair> pairs, const ProofOptions& options) {
  std::vector<PairProof> proofs(pairs.size());
  ProgressMeter meter(options.progress, "prove");
  in_parallel(pairs.size(), options.threads, meter, [&](std::size_t i) {
    const auto& [a, b] = pairs[i];
    proofs[i] = PairSearch(robot, pairs[i], *links[a], *links[b], options).run(meter);
  });
  return proofs;
}

}  // namespace prohull::robot
