#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "prohull/detail/drift.h"
#include "robot/model.h"
#include "robot/motion/joint_limits.h"

namespace prohull::robot {

/// Positions of a joint: all that are within `half` of the middle.
struct JointReach {
  double middle = 0, half = 0;
};

/// The link that no joint holds, on which this one hangs.
std::size_t root_of(const Robot& robot, std::size_t link);

/// What moves two links against each other: the joints between them, and the positions that these can have: those at
/// which the joints that follow them are within their limits, too. Throws
/// InputError(InvalidOption) if the lower limit of such a joint is above its upper one, or is no number.
class JointChain {
 public:
  /// The points are all that matters of a link: what moves is in their convex hull.
  JointChain(const Robot& robot, std::size_t a, std::size_t b, std::vector<Vec3> points_of_a,
             std::vector<Vec3> points_of_b);

  /// The positions of the joints are in these ranges, one of each joint of the robot, whatever its limits are.
  JointChain(const Robot& robot, std::size_t a, std::size_t b, std::vector<Vec3> points_of_a,
             std::vector<Vec3> points_of_b, std::span<const JointRange> ranges);

  /// Why positions of the joints do not say where the links are, or have no bounds; empty if they do. Then nothing
  /// below may be called.
  const std::string& obstacle() const { return obstacle_; }

  /// The joints that move freely, and their ranges. A joint that mimics is not among them, but what it follows is.
  /// Joints that turn about more than once have one turn, [-pi, pi] if their limits allow it, where that shows all.
  std::span<const std::size_t> freedoms() const { return freedoms_; }
  std::span<const JointRange> ranges() const { return ranges_; }

  /// What happens while each freedom stays in a range.
  struct Motion {
    Pose pose;                  ///< of b in the frame of a, with all freedoms in the middle; rounded
    std::vector<double> parts;  ///< of each freedom
    /// Proven: from the distance at `pose`, that anywhere in the ranges differs by at most this. It is the sum of the
    /// parts and of what rounding does.
    double change = 0;
    /// Proven: from where they are at `pose`, points of a and of b come nearer by no more than what they drift.
    Drift of_a, of_b;
  };
  Motion motion(std::span<const JointRange> box) const;
  Motion motion(std::span<const JointReach> reaches) const;
  /// By how much each freedom can change the distance of two faces, about.
  std::vector<double> parts_at(const NearFaces& faces, std::span<const JointRange> box) const;

  /// What happens while the freedoms go along a line in the space of their positions, each within its reach, and are
  /// off that line by no more than `strays`.
  struct Travel {
    /// Proven: each point of b, in the frame of a, is within `bend` of the straight way between where the poses of the
    /// line's ends put it, as they are computed by `motion`.
    double bend = 0;
    /// Proven: weighted by how far along the line they are, the ends are turned against what lies between by this
    /// angle at most.
    double turn = 0;
  };
  Travel travel(std::span<const JointReach> reaches, std::span<const double> strays) const;

  /// What rounding alone does to a distance, at most.
  double rounding() const { return rounding_; }

 private:
  struct Hinge {
    const Joint* joint = nullptr;
    bool climbs = false;         // from child to parent, on the way from a to b
    std::size_t freedom = 0;     // kNone if nothing moves it
    std::vector<Mimic> follows;  // from the freedom to this joint
  };

  /// The axis of a joint, in the frame of a, with all freedoms in the middle.
  struct Axis {
    Vec3 point, direction;
    double half = 0;   // how far the joint moves from the middle
    double scale = 1;  // by how much more than its freedom
  };
  Pose set_axes(std::span<const JointReach> reaches, std::vector<Axis>& axes) const;
  Motion motion(std::span<const JointReach> reaches, std::span<const Vec3> of_a, std::span<const Vec3> of_b) const;
  double slack() const;
  void find_hinges(const Robot& robot, std::size_t a, std::size_t b);
  void add_hinge(const Robot& robot, std::size_t joint, bool climbs);
  void find_ranges(const Robot& robot);
  void find_rounding();
  bool is_periodic(std::size_t freedom) const;

  std::vector<Vec3> points_of_a_, points_of_b_;
  std::vector<Hinge> hinges_;
  std::vector<std::size_t> freedoms_;
  std::vector<JointRange> ranges_;
  std::string obstacle_;
  double extent_ = 0, rounding_ = 0;
};

}  // namespace prohull::robot
