#include "robot/motion/joint_chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "prohull/detail/refuse.h"
#include "robot/motion/kinematics.h"
#include "robot/motion/sampling.h"
#include "robot/transform.h"

namespace prohull::robot {
namespace {

// A joint that turns by an angle t moves a point of one link against the other by at most t times the distance of the
// point from the joint's axis, and by at most twice that distance. This distance is the lever arm, and which of the two
// links is taken as the one that moves is free, joint by joint. Let the joints move one after the other, each from the
// middle of its range to any other position. The arm of a about an axis depends on the joints between a and the axis
// alone. If the first joints, seen from a, count by their arms of a and move the last of them first, and the others
// count by their arms of b and move the first of them first, then each arm is the one in the middle of all ranges. The
// distance of the links changes by no more than the sum over the joints.

constexpr double kSmall = 0x1p-44;  // above what a few operations on doubles lose, relative to the largest number

Vec3 turned(const Pose& pose, const Vec3& v) { return placed({pose.rotation, {}}, v); }

/// The joints above a link, the closest first.
std::vector<std::size_t> joints_above(const Robot& robot, std::size_t link) {
  std::vector<std::size_t> above;
  for (std::size_t j = robot.joints.size(); j-- > 0;) {  // those of a parent come before those of its children
    if (robot.joints[j].child != link) continue;
    above.push_back(j);
    if (!continues_row(robot, j)) link = robot.joints[j].parent;
  }
  return above;
}

/// How far the matrix is from a rotation, in norm: |R^T R - I| is at most three times its largest entry.
double defect_of(const Pose& pose) {
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double entry = i == j ? -1 : 0;
      for (const Vec3& row : pose.rotation) entry += row[i] * row[j];
      largest = std::max(largest, std::abs(entry));
    }
  return 3 * largest;
}

double largest_norm(std::span<const Vec3> points) {
  double largest = 0;
  for (const Vec3& p : points) largest = std::max(largest, norm(p));
  return largest;
}

/// The largest distance of the points from a line, the direction of which has length 1.
double largest_distance(std::span<const Vec3> points, const Vec3& on_line, const Vec3& direction) {
  double largest = 0;
  for (const Vec3& p : points) {
    const Vec3 across = cross(p - on_line, direction);
    largest = std::max(largest, dot(across, across));
  }
  return std::sqrt(largest);
}

std::vector<JointReach> reaches_of(std::span<const JointRange> box) {
  std::vector<JointReach> reaches;
  for (const JointRange& range : box) {
    const double middle = range.middle();
    reaches.push_back({middle, std::max(range.upper - middle, middle - range.lower)});
  }
  return reaches;
}

}  // namespace

std::size_t root_of(const Robot& robot, std::size_t link) {
  const std::vector<std::size_t> above = joints_above(robot, link);
  return above.empty() ? link : robot.joints[above.back()].parent;
}

JointChain::JointChain(const Robot& robot, std::size_t a, std::size_t b, std::vector<Vec3> points_of_a,
                       std::vector<Vec3> points_of_b)
    : points_of_a_(std::move(points_of_a)), points_of_b_(std::move(points_of_b)) {
  find_hinges(robot, a, b);
  if (obstacle_.empty()) find_ranges(robot);
  if (obstacle_.empty()) find_rounding();
}

JointChain::JointChain(const Robot& robot, std::size_t a, std::size_t b, std::vector<Vec3> points_of_a,
                       std::vector<Vec3> points_of_b, std::span<const JointRange> ranges)
    : points_of_a_(std::move(points_of_a)), points_of_b_(std::move(points_of_b)) {
  find_hinges(robot, a, b);
  for (const std::size_t j : freedoms_) ranges_.push_back(ranges[j]);
  if (obstacle_.empty()) find_rounding();
}

void JointChain::find_hinges(const Robot& robot, std::size_t a, std::size_t b) {
  if (root_of(robot, a) != root_of(robot, b)) {
    obstacle_ = "no joints connect them";
    return;
  }
  std::vector<std::size_t> above_a = joints_above(robot, a), above_b = joints_above(robot, b);
  while (!above_a.empty() && !above_b.empty() && above_a.back() == above_b.back())
    above_a.pop_back(), above_b.pop_back();
  for (const std::size_t j : above_a) add_hinge(robot, j, true);
  std::ranges::reverse(above_b);
  for (const std::size_t j : above_b) add_hinge(robot, j, false);
}

void JointChain::add_hinge(const Robot& robot, std::size_t joint, bool climbs) {
  Hinge hinge{.joint = &robot.joints[joint], .climbs = climbs, .freedom = kNone, .follows = {}};
  const auto is_free = [](const Joint& j) { return turns(j) || slides(j); };
  if (!is_free(*hinge.joint)) {
    if (hinge.joint->type != JointType::Fixed)
      obstacle_ = fmt::format("joint '{}' is neither one that turns nor one that slides", hinge.joint->name);
    hinges_.push_back(std::move(hinge));
    return;
  }
  std::size_t master = joint;
  while (const auto& mimic = robot.joints[master].mimic) {
    hinge.follows.push_back(*mimic);
    master = mimic->joint;
    if (hinge.follows.size() > robot.joints.size() || !is_free(robot.joints[master])) {
      obstacle_ = fmt::format("joint '{}' follows one whose positions are not known", hinge.joint->name);
      return;
    }
  }
  std::ranges::reverse(hinge.follows);
  const auto found = std::ranges::find(freedoms_, master);
  hinge.freedom = static_cast<std::size_t>(found - freedoms_.begin());
  if (found == freedoms_.end()) freedoms_.push_back(master);
  hinges_.push_back(std::move(hinge));
}

/// Whether positions that differ by a turn are the same for all that the freedom moves.
bool JointChain::is_periodic(std::size_t freedom) const {
  return std::ranges::all_of(hinges_, [&](const Hinge& hinge) {
    return hinge.freedom != freedom ||
           (turns(*hinge.joint) && std::ranges::all_of(hinge.follows, [](const Mimic& mimic) {
              return mimic.multiplier == std::round(mimic.multiplier);
            }));
  });
}

void JointChain::find_ranges(const Robot& robot) {
  const std::vector<JointRange> allowed = allowed_ranges(robot);
  for (std::size_t f = 0; f < freedoms_.size(); ++f) {
    const Joint& joint = robot.joints[freedoms_[f]];
    if (!(joint.lower <= joint.upper))
      refuse(fmt::format("joint '{}' has a lower limit above its upper one, or one that is no number", joint.name));
    JointRange range = allowed[freedoms_[f]];
    if (range.is_empty()) {
      obstacle_ = fmt::format(
          "there is no position of joint '{}' at which the joints that follow it are within their limits", joint.name);
      return;
    }
    if (turns(joint) && is_periodic(f)) range = one_turn(range);
    if (!(std::max(std::abs(range.lower), std::abs(range.upper)) <= kFarthestLimit)) {
      obstacle_ = fmt::format("joint '{}' has no limits", joint.name);
      return;
    }
    ranges_.push_back(range);
  }
}

// No point of either link, and no axis, is farther than the extent from the frame of any link between them. A joint's
// pose in doubles differs from that of a rotation, in norm, by what its origin differs, and by a few operations. A
// wrong pose moves all beyond it by its error times the extent.
void JointChain::find_rounding() {
  constexpr double kLargestPosition = 1e6 * (1 + kSmall);  // of paths, with their rounding
  extent_ = largest_norm(points_of_a_) + largest_norm(points_of_b_);
  double error = kSmall;
  for (const Hinge& hinge : hinges_) {
    const Joint& joint = *hinge.joint;
    extent_ += norm(joint.origin.translation) + 2 * norm(joint.anchor);
    error += 2 * defect_of(joint.origin) + kSmall;
    if (hinge.freedom == kNone) continue;
    double farthest = std::max(std::abs(ranges_[hinge.freedom].lower), std::abs(ranges_[hinge.freedom].upper));
    for (const Mimic& mimic : hinge.follows) farthest = std::abs(mimic.multiplier) * farthest + std::abs(mimic.offset);
    if (!(farthest <= kLargestPosition)) {
      obstacle_ = fmt::format("joint '{}' goes beyond 1e6", joint.name);
      return;
    }
    if (slides(joint)) extent_ += farthest;
  }
  rounding_ = error * extent_;
}

JointChain::Motion JointChain::motion(std::span<const JointRange> box) const { return motion(reaches_of(box)); }

std::vector<double> JointChain::parts_at(const NearFaces& faces, std::span<const JointRange> box) const {
  const std::vector<JointReach> reaches = reaches_of(box);
  const Motion motion = this->motion(reaches, {&faces.point_a, 1}, std::span(&faces.point_b, 1));
  const double length = norm(faces.way);
  if (!(length > 0)) return motion.parts;
  const Vec3 way_a = faces.way * (1 / length), way_b = turned(inverse(motion.pose), way_a);
  std::vector<double> parts(freedoms_.size());
  const auto add = [&](const Drift& drift, const Vec3& point, const Vec3& way) {
    double moved = 0;
    for (const JointMove& move : drift.moves) {
      const Vec3 from = point - move.point;
      const double arm = move.turns ? norm(cross(from, move.direction)) : 1;
      parts[move.number] +=
          move.turns ? move.reach * (std::abs(dot(from, cross(move.direction, way))) + moved + move.reach * arm / 2)
                     : move.reach * std::abs(dot(move.direction, way));
      moved += move.reach * arm;
    }
  };
  add(motion.of_a, faces.point_a, way_a);
  add(motion.of_b, faces.point_b, way_b);
  for (std::size_t f = 0; f < parts.size(); ++f) parts[f] = std::min(parts[f], motion.parts[f]);
  return parts;
}

/// Returns the pose of b in the frame of a.
Pose JointChain::set_axes(std::span<const JointReach> reaches, std::vector<Axis>& axes) const {
  axes.assign(hinges_.size(), {});
  Pose pose;
  for (std::size_t h = 0; h < hinges_.size(); ++h) {
    const Hinge& hinge = hinges_[h];
    double position = 0;
    if (hinge.freedom != kNone) {
      double half = reaches[hinge.freedom].half;
      position = reaches[hinge.freedom].middle;
      for (const Mimic& mimic : hinge.follows) {
        const double scaled = mimic.multiplier * position;
        half = std::abs(mimic.multiplier) * half + 0x1p-50 * (std::abs(scaled) + std::abs(mimic.offset));
        position = scaled + mimic.offset;
        axes[h].scale *= std::abs(mimic.multiplier);
      }
      axes[h].half = half * (1 + kSmall);
    }
    const Pose step = joint_pose(*hinge.joint, position);
    const auto set_axis = [&] {
      axes[h].point = placed(pose, hinge.joint->anchor);
      axes[h].direction = turned(pose, hinge.joint->axis);
    };
    if (hinge.climbs) set_axis();
    pose = composed(pose, hinge.climbs ? inverse(step) : step);
    if (!hinge.climbs) set_axis();
  }
  return pose;
}

double JointChain::slack() const { return 2 * rounding_ + kSmall * extent_; }

// The position of a point of b is a function of the joints' positions. Its derivative by a joint is the lever arm, for
// a joint that slides 1. Its second derivative by two joints is at most the derivative by the one closer to b if the
// other turns, and 0 otherwise. So Taylor's formula bounds how far the function is from a linear one around the middle
// of the line, by `rest`. With it, the function is within 2 rest of the straight way, and what strays adds its
// derivative. Arms anywhere within the reaches are no longer than in the middle and what joints closer to b move.
JointChain::Travel JointChain::travel(std::span<const JointReach> reaches, std::span<const double> strays) const {
  std::vector<Axis> axes;
  const Pose back = inverse(set_axes(reaches, axes));
  Travel travel;
  double rest = 0, moved = 0, angles = 0;
  for (std::size_t h = hinges_.size(); h-- > 0;) {
    if (hinges_[h].freedom == kNone) continue;
    const Axis& axis = axes[h];
    const bool is_turning = turns(*hinges_[h].joint);
    const double stray = axis.scale * strays[hinges_[h].freedom];
    double arm = 1;
    if (is_turning)
      arm = moved + slack() + largest_distance(points_of_b_, placed(back, axis.point), turned(back, axis.direction));
    rest += is_turning ? axis.half * (moved + axis.half * arm / 2) : 0;
    travel.bend += stray * arm;
    moved += axis.half * arm;
    if (is_turning) angles += axis.half + stray;
  }
  travel.bend = (travel.bend + 2 * rest) * (1 + kSmall) + slack();
  travel.turn = angles * (1 + kSmall);
  return travel;
}

JointChain::Motion JointChain::motion(std::span<const JointReach> reaches) const {
  return motion(reaches, points_of_a_, points_of_b_);
}

/// The points are in the frames of a and of b.
JointChain::Motion JointChain::motion(std::span<const JointReach> reaches, std::span<const Vec3> of_a,
                                      std::span<const Vec3> of_b) const {
  std::vector<Axis> axes;
  Motion motion;
  motion.pose = set_axes(reaches, axes);
  const Pose back = inverse(motion.pose);
  std::vector<double> by_a(hinges_.size()), by_b(hinges_.size());  // what each joint changes, by the arms of a and b
  std::vector<JointMove> moves_a(hinges_.size()), moves_b(hinges_.size());
  for (std::size_t h = 0; h < hinges_.size(); ++h) {
    const Axis& axis = axes[h];
    if (hinges_[h].freedom == kNone) continue;
    by_a[h] = by_b[h] = axis.half;
    const bool is_turning = turns(*hinges_[h].joint);
    moves_a[h] = {axis.point, axis.direction, axis.half, is_turning, hinges_[h].freedom};
    moves_b[h] = {placed(back, axis.point), turned(back, axis.direction), axis.half, is_turning, hinges_[h].freedom};
    if (!is_turning) continue;
    const double angle = std::min(axis.half, 2.0);
    by_a[h] = angle * (largest_distance(of_a, moves_a[h].point, moves_a[h].direction) + slack());
    by_b[h] = angle * (largest_distance(of_b, moves_b[h].point, moves_b[h].direction) + slack());
  }
  double change = std::accumulate(by_b.begin(), by_b.end(), 0.0);
  motion.change = change;
  std::size_t count_by_a = 0;  // how many joints count by their arms of a
  for (std::size_t h = 0; h < hinges_.size(); ++h) {
    change += by_a[h] - by_b[h];
    if (change < motion.change) motion.change = change, count_by_a = h + 1;
  }
  motion.parts.resize(freedoms_.size());
  motion.change = rounding_;
  for (std::size_t h = 0; h < hinges_.size(); ++h) {
    if (hinges_[h].freedom == kNone) continue;
    const bool counts_by_a = h < count_by_a;
    const double part = (counts_by_a ? by_a[h] : by_b[h]) * (1 + kSmall);
    motion.parts[hinges_[h].freedom] += part;
    motion.change += part;
    (counts_by_a ? motion.of_a : motion.of_b).moves.push_back(counts_by_a ? moves_a[h] : moves_b[h]);
  }
  std::ranges::reverse(motion.of_b.moves);
  motion.of_a.blur = motion.of_b.blur = slack();
  motion.of_b.rounding = rounding_;
  return motion;
}

}  // namespace prohull::robot
