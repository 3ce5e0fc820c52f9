#pragma once

#include <algorithm>
#include <cmath>

#include "collide/obb_tree.h"
#include "prohull/detail/drift.h"

namespace prohull {

/// Bounds of how far points of a mesh drift: any way, and along one direction. Along it, a joint counts by its
/// derivative, and what is of higher order by Taylor's formula: the second derivative by two joints is at most the
/// derivative by the one closer to the mesh if the other turns, and 0 otherwise.
class DriftBound {
 public:
  explicit DriftBound(const Drift& drift) : drift_(drift) {}

  /// What lies in a ball.
  struct OfBall {
    double any_way = 0;
    double bend = 0;  ///< along a direction, the part of higher order
  };
  OfBall of_ball(const Vec3& center, double radius) const {
    double sum = drift_.rounding, bend = 0, moved = 0;
    for (const JointMove& move : drift_.moves) {
      double derivative = 1;
      if (move.turns) {
        const double arm = norm(cross(center - move.point, move.direction)) + radius + drift_.blur;
        sum += std::min(move.reach, 2.0) * arm;  // a chord is no longer than a diameter
        derivative = arm + moved;
        bend += move.reach * (moved + move.reach * derivative / 2);
      } else {
        sum += move.reach;
      }
      moved += move.reach * derivative;
    }
    return {sum * (1 + kSmall), bend * (1 + kSmall)};
  }

  /// Along a direction, about of length 1, the part of first order.
  double straight(const Vec3& point, const Vec3& direction) const {
    return straight(point, direction, [](const Vec3&) { return 0.0; });
  }

  /// The same of what lies in a box.
  double straight(const ObbTree& tree, const ObbNode& box, const Vec3& direction) const {
    const double scale = 1 / tree.unit();
    return straight(center_of(tree, box), direction, [&](const Vec3& lever) {
      double spread = kBoxRounding;
      for (int i = 0; i < 3; ++i)
        spread += box.half[i] * std::abs(box.axes[i] * lever.x + box.axes[3 + i] * lever.y + box.axes[6 + i] * lever.z);
      return spread * scale;
    });
  }

  OfBall of_box(const ObbTree& tree, const ObbNode& box) const {
    const double radius = norm(Vec3{box.half[0], box.half[1], box.half[2]}) + kBoxRounding;
    return of_ball(center_of(tree, box), radius / tree.unit());
  }

 private:
  static constexpr double kSmall = 0x1p-40;        // above what a few operations lose
  static constexpr double kBoxRounding = 0x1p-18;  // of boxes in float32

  /// `spread(lever)` is how far points around this one may be from it along the lever.
  template <class Spread>
  double straight(const Vec3& point, const Vec3& direction, Spread spread) const {
    double sum = drift_.rounding;
    for (const JointMove& move : drift_.moves) {
      if (!move.turns) {
        sum += move.reach * std::abs(dot(move.direction, direction));
        continue;
      }
      const Vec3 lever = cross(move.direction, direction);
      sum += move.reach * (std::abs(dot(point - move.point, lever)) + spread(lever) + drift_.blur);
    }
    return sum * (1 + kSmall);
  }

  static Vec3 center_of(const ObbTree& tree, const ObbNode& box) {
    return tree.center() + Vec3{box.center[0], box.center[1], box.center[2]} * (1 / tree.unit());
  }

  const Drift& drift_;
};

}  // namespace prohull
