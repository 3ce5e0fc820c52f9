#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "robot/model.h"
#include "robot/motion/joint_chain.h"

namespace prohull::robot {

/// Rows of numbers as a file or a program has them: positions of joints, and what else is known of each moment.
struct PathRows {
  std::vector<std::string> joints;                      ///< names
  std::vector<double> times = {};                       ///< of each row, in seconds; empty: rows are 1 apart
  std::vector<std::vector<double>> positions = {};      ///< of each row, of each joint: radians or metres
  std::vector<std::vector<double>> velocities = {};     ///< of each row: none, or one of each joint; may be empty
  std::vector<std::vector<double>> accelerations = {};  ///< likewise; only where there are velocities
  std::string file = {};                                ///< stands in messages
  std::string row = "row";                              ///< what messages call a row: "line"
  std::vector<std::size_t> numbers = {};                ///< by which they call each; empty: from 0
};

/// A path of joint positions over time. Between two rows, all joints go straight from the one to the other; where both
/// rows have velocities, by cubics that keep them; and where both have accelerations too, by quintics: as the joint
/// trajectory controller of ros2_control does. Joints that turn do not take the shorter way round.
///
/// A *place* on the path counts rows: 0 is the first one, 1.5 halfway in time between the second and the third.
class JointPath {
 public:
  /// Throws InputError(Malformed) that names the file and the row: no rows or no joints; joints that the robot does not
  /// have, that occur twice or are neither ones that turn nor that slide; rows of another length; numbers that are not
  /// finite, or beyond 1e6 on the way from row to row; times that do not increase.
  JointPath(const Robot& robot, PathRows rows);

  const std::vector<std::size_t>& joints() const { return joints_; }  ///< in Robot::joints
  /// In joints(); none of a joint that the path does not name.
  std::optional<std::size_t> number_of(std::size_t joint) const;
  const PathRows& rows() const { return rows_; }
  double length() const { return static_cast<double>(rows_.positions.size() - 1); }  ///< the last place
  double time_at(double place) const;
  /// How far the place of which time_at is the time, rounded, is at most from one that lies behind the same row.
  double rounding_of_times(double place) const;

  /// Whether joints()[k] is ever elsewhere than in the first row.
  bool is_moved(std::size_t k) const;

  /// The positions of all joints of the robot, but for those that mimic. Others than joints() are at their
  /// rest_positions.
  std::vector<double> positions_at(double place) const;

  /// The position of joints()[k] halfway between two places that have no row between them or are rows themselves, and
  /// how far it is from there at most between the two. Rounding is part of `half`, also that of time_at the two.
  JointReach reach(std::size_t k, double begin, double end) const;

  /// A place between a row and the next at which joints()[k] is outside of the limits by more than rounding. None if
  /// it hardly is, by less than four times as much, or if it goes straight, so that it is no farther outside than in
  /// the rows.
  std::optional<double> place_outside(std::size_t k, std::size_t row, const JointRange& limits) const;
  /// How far joints()[k] is at most from the straight line, over places, between its positions_at two places. Rounding
  /// is part of it.
  double stray(std::size_t k, double begin, double end) const;

  /// All positions that each joint of the robot has on the path.
  std::vector<JointRange> ranges() const;

 private:
  void check_names(const Robot& robot);
  void check_rows() const;
  void add_curves(std::size_t segment);
  JointRange range(std::size_t k, std::size_t first, std::size_t last) const;
  [[noreturn]] void refuse(std::size_t row, const std::string& why) const;

  PathRows rows_;
  std::vector<std::size_t> joints_;
  std::vector<double> rest_;
  std::vector<std::vector<double>> curves_;    // of segment * joints + k: Bezier control points
  std::vector<std::vector<JointRange>> tree_;  // of segments, as a binary tree in an array; of each joint
};

/// Halfway between two places: a row, if there are rows between them.
double middle_place(double begin, double end);

/// Reads CSV or JSON; the content tells which.
///
///     CSV    a line of names: `time`, which may be left out, then joints; NAME.velocity and NAME.acceleration of all
///            joints may follow. One row a line. Commas, semicolons or tabs between the columns.
///     JSON   a JointTrajectory of ROS: {"joint_names": [...], "points": [{"positions": [...], "velocities": [...],
///            "accelerations": [...], "time_from_start": 1.5}, ...]}, where a time may also be {"sec": 1, "nanosec":
///            5e8}, also as the "joint_trajectory" or "trajectory" of an object; or {"joints": [...], "positions":
///            [[...], ...]}, with "times", "velocities" and "accelerations" if there are any.
///
/// Throws InputError(Malformed) with the file and the line or point.
PathRows read_path_rows(std::string_view text, const std::string& file);

/// A joint outside of its limits.
struct BeyondLimits {
  double place = 0;       ///< a row, or between two
  std::size_t joint = 0;  ///< in Robot::joints
  double position = 0;

  std::size_t row() const { return static_cast<std::size_t>(place); }  ///< the last one that is not behind it
  bool is_in_row() const { return place == static_cast<double>(row()); }
};
/// One that is in the first row or between the first two rows where there is one; between rows, by more than rounding,
/// and so are joints that the path does not name, which follow others or rest.
std::optional<BeyondLimits> first_beyond_limits(const Robot& robot, const JointPath& path);

/// The robot in which no joint has a motion that the path does not say: joints that the path names do not mimic others,
/// and ball, planar and floating joints are fixed, at rest.
Robot moved_by(const Robot& robot, const JointPath& path);

}  // namespace prohull::robot
