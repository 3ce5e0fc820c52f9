#include "robot/motion/joint_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "prohull/detail/text.h"
#include "prohull/error.h"
#include "robot/motion/kinematics.h"

namespace prohull::robot {
namespace {

constexpr double kLargest = 1e6;  // as JointChain takes it

using Curve = std::vector<double>;

/// Control points of the straight line, cubic or quintic in Bernstein form, which keeps what is known at both rows. `h`
/// is the time between them.
Curve curve_of(const PathRows& rows, std::size_t first, std::size_t k, double h) {
  const auto at = [&](const std::vector<std::vector<double>>& values, std::size_t row) { return values[row][k]; };
  const auto have = [&](const std::vector<std::vector<double>>& values) {
    return !values.empty() && !values[first].empty() && !values[first + 1].empty();
  };
  const double p0 = at(rows.positions, first), p1 = at(rows.positions, first + 1);
  if (!have(rows.velocities)) return {p0, p1};
  const double v0 = at(rows.velocities, first) * h, v1 = at(rows.velocities, first + 1) * h;
  if (!have(rows.accelerations)) return {p0, p0 + v0 / 3, p1 - v1 / 3, p1};
  const double a0 = at(rows.accelerations, first) * h * h, a1 = at(rows.accelerations, first + 1) * h * h;
  return {p0, p0 + v0 / 5, p0 + 2 * v0 / 5 + a0 / 20, p1 - 2 * v1 / 5 + a1 / 20, p1 - v1 / 5, p1};
}

double largest(const Curve& curve) {
  double found = 0;
  for (const double c : curve) found = std::max(found, std::abs(c));
  return found;
}

/// The blossom of the curve: de Casteljau's algorithm with the fraction `v` in the first `count` steps, then `u`. Each
/// step rounds by less than 2^-50 of the largest control point, and there are at most five.
double blossom(const Curve& curve, double u, double v, std::size_t count) {
  std::array<double, 6> points{};
  std::ranges::copy(curve, points.begin());
  const std::size_t degree = curve.size() - 1;
  for (std::size_t step = 0; step < degree; ++step) {
    const double t = step < count ? v : u;
    for (std::size_t i = 0; i < degree - step; ++i) points[i] = (1 - t) * points[i] + t * points[i + 1];
  }
  return points[0];
}

/// What rounding may do to a point, or a control point, of the curve. The control points are sums of three terms, none
/// of which is more than ten times as large as the largest of them, and each of which is wrong by less than 2^-50 of
/// itself.
double rounding_of(const Curve& curve) { return 0x1p-44 * largest(curve); }

/// Between two fractions; the control points of the part are values of the blossom, and enclose it.
JointRange range_of(const Curve& curve, double u, double v) {
  JointRange range{blossom(curve, u, v, 0), blossom(curve, u, v, 0)};
  for (std::size_t count = 1; count < curve.size(); ++count) {
    const double c = blossom(curve, u, v, count);
    range.lower = std::min(range.lower, c), range.upper = std::max(range.upper, c);
  }
  const double rounding = rounding_of(curve);
  return {range.lower - rounding, range.upper + rounding};
}

/// A fraction between two at which the curve is outside of the limits by more than rounding. One at which it hardly is
/// may not be found: otherwise parts that hardly are would be halved without end.
std::optional<double> fraction_outside(const Curve& curve, const JointRange& limits, double u, double v) {
  const double rounding = rounding_of(curve);
  const auto keep = [&](const JointRange& range, double slack) {
    return limits.lower - slack <= range.lower && range.upper <= limits.upper + slack;
  };
  if (keep(range_of(curve, u, v), 4 * rounding)) return {};  // one of them is in range_of
  const double middle = std::midpoint(u, v), position = blossom(curve, middle, middle, 0);
  if (!keep({position, position}, 2 * rounding)) return middle;
  if (!(u < middle && middle < v)) return {};
  const std::optional<double> before = fraction_outside(curve, limits, u, middle);
  return before ? before : fraction_outside(curve, limits, middle, v);
}

JointRange joined(const JointRange& a, const JointRange& b) {
  return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

/// Positions of a leader at which the joint is within its limits.
struct Bound {
  std::size_t joint = 0;
  Leader leader;
};

/// The bounds of the joints on the path come first, in its order; then those of joints that follow or rest.
std::vector<Bound> bounds_of(const Robot& moved, const JointPath& path) {
  std::vector<Bound> bounds;
  for (const std::size_t joint : path.joints()) bounds.push_back({joint, leader_of(moved, joint)});
  for (std::size_t j = 0; j < moved.joints.size(); ++j)
    if (moves(moved.joints[j]) && !path.number_of(j)) bounds.push_back({j, leader_of(moved, j)});
  return bounds;
}

std::string names_of(const Robot& robot) {
  std::vector<std::string> names;
  for (const Joint& joint : robot.joints)
    if (moves(joint)) names.push_back(joint.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

double middle_place(double begin, double end) {
  const double row = std::floor(std::midpoint(begin, end));
  return begin < row && row < end ? row : std::midpoint(begin, end);
}

JointPath::JointPath(const Robot& robot, PathRows rows) : rows_(std::move(rows)), rest_(rest_positions(robot)) {
  check_names(robot);
  check_rows();
  const std::size_t segments = rows_.positions.size() - 1;
  for (std::size_t segment = 0; segment < segments; ++segment) add_curves(segment);
  tree_.resize(2 * std::max<std::size_t>(segments, 1), std::vector<JointRange>(joints_.size()));
  for (std::size_t i = 2 * segments; i-- > 1;)
    for (std::size_t k = 0; k < joints_.size(); ++k)
      tree_[i][k] = i >= segments ? range_of(curves_[(i - segments) * joints_.size() + k], 0, 1)
                                  : joined(tree_[2 * i][k], tree_[2 * i + 1][k]);
}

void JointPath::refuse(std::size_t row, const std::string& why) const {
  throw InputError(Defect::Malformed, fmt::format("{}: {} {}: {}", rows_.file, rows_.row,
                                                  rows_.numbers.empty() ? row : rows_.numbers[row], why));
}

void JointPath::check_names(const Robot& robot) {
  const auto refuse_name = [&](const std::string& why) {
    throw InputError(Defect::Malformed, fmt::format("{}: {}", rows_.file, why));
  };
  if (rows_.joints.empty()) refuse_name("there are no joints");
  if (rows_.positions.empty()) refuse_name("there are no rows of positions");
  for (const std::string& name : rows_.joints) {
    const auto found = std::ranges::find(robot.joints, name, &Joint::name);
    if (found == robot.joints.end() || name.empty())
      refuse_name(fmt::format("the robot has no joint '{}'; it has {}", name, names_of(robot)));
    if (!moves(*found)) refuse_name(fmt::format("joint '{}' is neither one that turns nor one that slides", name));
    const auto joint = static_cast<std::size_t>(found - robot.joints.begin());
    if (std::ranges::find(joints_, joint) != joints_.end()) refuse_name(fmt::format("joint '{}' occurs twice", name));
    joints_.push_back(joint);
  }
}

void JointPath::check_rows() const {
  const auto check = [&](const char* what, const std::vector<std::vector<double>>& values, bool may_be_missing) {
    if (!values.empty() && values.size() != rows_.positions.size())
      refuse(std::min(values.size(), rows_.positions.size()),
             fmt::format("{} are not of as many rows as positions", what));
    for (std::size_t row = 0; row < values.size(); ++row) {
      if (may_be_missing && values[row].empty()) continue;
      if (values[row].size() != joints_.size())
        refuse(row, fmt::format("{}: {} for {}", what, values[row].size(), counted(joints_.size(), "joint")));
      for (std::size_t k = 0; k < joints_.size(); ++k)
        if (!(std::abs(values[row][k]) <= kLargest))
          refuse(row, fmt::format("{} of joint '{}': {} is no number from -1e6 to 1e6", what, rows_.joints[k],
                                  values[row][k]));
    }
  };
  check("positions", rows_.positions, false);
  check("velocities", rows_.velocities, true);
  check("accelerations", rows_.accelerations, true);
  const auto has = [](const std::vector<std::vector<double>>& values, std::size_t row) {
    return !values.empty() && !values[row].empty();
  };
  for (std::size_t row = 0; row < rows_.positions.size(); ++row)
    if (has(rows_.accelerations, row) && !has(rows_.velocities, row))
      refuse(row, "there are accelerations, but no velocities");
  if (rows_.times.empty()) return;
  if (rows_.times.size() != rows_.positions.size())
    refuse(std::min(rows_.times.size(), rows_.positions.size()), "times are not of as many rows as positions");
  for (std::size_t row = 0; row < rows_.times.size(); ++row) {
    if (!(std::abs(rows_.times[row]) <= 1e12))
      refuse(row, fmt::format("time {} is no number from -1e12 to 1e12", rows_.times[row]));
    if (row > 0 && !(rows_.times[row] > rows_.times[row - 1]))
      refuse(row, fmt::format("time {} does not come after {}", rows_.times[row], rows_.times[row - 1]));
  }
}

void JointPath::add_curves(std::size_t segment) {
  const double h = rows_.times.empty() ? 1 : rows_.times[segment + 1] - rows_.times[segment];
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    Curve curve = curve_of(rows_, segment, k, h);
    if (!(largest(curve) <= kLargest))
      refuse(segment,
             fmt::format("with its velocity, joint '{}' goes beyond 1e6 on the way to the next", rows_.joints[k]));
    curves_.push_back(std::move(curve));
  }
}

std::optional<std::size_t> JointPath::number_of(std::size_t joint) const {
  const auto found = std::ranges::find(joints_, joint);
  if (found == joints_.end()) return {};
  return static_cast<std::size_t>(found - joints_.begin());
}

double JointPath::time_at(double place) const {
  if (rows_.times.empty()) return place;
  const auto row = std::min(static_cast<std::size_t>(place), rows_.times.size() - 1);
  if (row + 1 == rows_.times.size()) return rows_.times[row];
  return std::lerp(rows_.times[row], rows_.times[row + 1], place - static_cast<double>(row));
}

double JointPath::rounding_of_times(double place) const {
  const auto segment = static_cast<std::size_t>(place);
  if (segment + 1 >= rows_.times.size()) return 0;
  const double from = rows_.times[segment], to = rows_.times[segment + 1];
  return 0x1p-50 * std::max(std::abs(from), std::abs(to)) / (to - from);
}

std::vector<double> JointPath::positions_at(double place) const {
  std::vector<double> positions = rest_;
  for (std::size_t k = 0; k < joints_.size(); ++k) positions[joints_[k]] = reach(k, place, place).middle;
  return positions;
}

JointReach JointPath::reach(std::size_t k, double begin, double end) const {
  const double middle = middle_place(begin, end);
  const auto row = std::min(static_cast<std::size_t>(middle), rows_.positions.size() - 1);
  const bool is_row = middle == static_cast<double>(row);
  const auto curve = [&](std::size_t segment) -> const Curve& { return curves_[segment * joints_.size() + k]; };
  const auto fraction = [](double place, std::size_t segment) { return place - static_cast<double>(segment); };
  JointReach reach{is_row ? rows_.positions[row][k] : blossom(curve(row), fraction(middle, row), 0, 0), 0};
  if (begin == end) return reach;
  const auto first = static_cast<std::size_t>(begin), last = static_cast<std::size_t>(std::ceil(end));
  const double rounding = last == first + 1 ? rounding_of_times(begin) : 0;
  const JointRange range = last == first + 1 ? range_of(curve(first), std::max(fraction(begin, first) - rounding, 0.0),
                                                        std::min(fraction(end, first) + rounding, 1.0))
                                             : this->range(k, first, last);
  reach.half = std::max({range.upper - reach.middle, reach.middle - range.lower, 0.0}) * (1 + 0x1p-50);
  return reach;
}

std::optional<double> JointPath::place_outside(std::size_t k, std::size_t row, const JointRange& limits) const {
  if (row + 1 >= rows_.positions.size()) return {};
  const Curve& curve = curves_[row * joints_.size() + k];
  if (curve.size() == 2) return {};  // straight: its rows tell
  const auto fraction = fraction_outside(curve, limits, 0, 1);
  return fraction ? std::optional(static_cast<double>(row) + *fraction) : std::nullopt;
}

// The control points of a part of a curve, less those of the line, enclose the difference.
double JointPath::stray(std::size_t k, double begin, double end) const {
  const double from = reach(k, begin, begin).middle, to = reach(k, end, end).middle;
  double stray = 0;
  for (auto segment = static_cast<std::size_t>(begin); static_cast<double>(segment) < end; ++segment) {
    const auto row = static_cast<double>(segment);
    const Curve& curve = curves_[segment * joints_.size() + k];
    const double u = std::max(begin - row, 0.0), v = std::min(end - row, 1.0);
    for (std::size_t count = 0; count < curve.size(); ++count) {
      const double fraction = std::lerp(u, v, static_cast<double>(count) / static_cast<double>(curve.size() - 1));
      const double on_line = std::lerp(from, to, (row - begin + fraction) / (end - begin));  // `begin` may be large
      stray = std::max(stray, std::abs(blossom(curve, u, v, count) - on_line) + 2 * rounding_of(curve));
    }
  }
  return stray + 0x1p-44 * std::max(std::abs(from), std::abs(to));
}

// The range of segments in a binary tree whose leaves begin at their number, from both ends upwards.
JointRange JointPath::range(std::size_t k, std::size_t first, std::size_t last) const {
  const std::size_t leaves = tree_.size() / 2;
  JointRange range = tree_[leaves + first][k];
  for (std::size_t i = leaves + first, end = leaves + last; i < end; i /= 2, end /= 2) {
    if (i % 2 == 1) range = joined(range, tree_[i++][k]);
    if (end % 2 == 1) range = joined(range, tree_[--end][k]);
  }
  return range;
}

bool JointPath::is_moved(std::size_t k) const {
  const auto any = [&](const std::vector<std::vector<double>>& rows, double rest) {
    return std::ranges::any_of(rows, [&](const std::vector<double>& row) { return !row.empty() && row[k] != rest; });
  };
  return any(rows_.positions, rows_.positions[0][k]) || any(rows_.velocities, 0) || any(rows_.accelerations, 0);
}

std::vector<JointRange> JointPath::ranges() const {
  std::vector<JointRange> ranges;
  for (const double rest : rest_) ranges.push_back({rest, rest});
  const std::size_t segments = rows_.positions.size() - 1;
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const double first = rows_.positions[0][k];
    ranges[joints_[k]] = segments == 0 ? JointRange{first, first} : range(k, 0, segments);
  }
  return ranges;
}

std::optional<BeyondLimits> first_beyond_limits(const Robot& robot, const JointPath& path) {
  const Robot moved = moved_by(robot, path);
  const std::vector<Bound> bounds = bounds_of(moved, path);
  const auto found = [&](double place, std::size_t joint) {
    std::vector<double> positions = path.positions_at(place);
    follow(moved, positions);
    return BeyondLimits{place, joint, positions[joint]};
  };
  const std::vector<double> rest = path.positions_at(0);
  for (const Bound& bound : bounds)
    if (!path.number_of(bound.leader.joint) && !bound.leader.range.contains(rest[bound.leader.joint]))
      return found(0, bound.joint);
  const std::vector<std::vector<double>>& rows = path.rows().positions;
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (const bool is_behind : {false, true})
      for (const Bound& bound : bounds) {
        const auto k = path.number_of(bound.leader.joint);
        if (!k) continue;
        std::optional<double> place;
        if (is_behind)
          place = path.place_outside(*k, row, bound.leader.range);
        else if (!bound.leader.range.contains(rows[row][*k]))
          place = static_cast<double>(row);
        if (place) return found(*place, bound.joint);
      }
  return {};
}

Robot moved_by(const Robot& robot, const JointPath& path) {
  Robot moved = robot;
  for (Joint& joint : moved.joints)
    if (!moves(joint)) joint.type = JointType::Fixed;
  for (const std::size_t joint : path.joints()) moved.joints[joint].mimic.reset();
  return moved;
}

}  // namespace prohull::robot
