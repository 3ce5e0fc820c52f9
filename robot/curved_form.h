#pragma once

#include <optional>

#include "prohull/shapes.h"
#include "robot/link_triangles.h"
#include "robot/model.h"

namespace prohull::robot {

/// Whether the sum of two finite numbers is not rounded.
bool is_exact_sum(double a, double b);

/// A sphere, cylinder or capsule where a pose puts it: all points p for which R^T (p - t) lies in the form, computed
/// with real numbers from the stored doubles of R and t; of a sphere R is the identity. So it is convex and closed, and
/// `contains` can be exact. Lengths are 0, or between 1e-100 and 1e100.
class CurvedForm {
 public:
  /// None of any other form.
  static std::optional<CurvedForm> of(const Form& form, const Pose& pose = {});

  /// If it is a sphere, the same one.
  std::optional<Ball> ball() const;

  /// Exact.
  bool contains(const Vec3& p) const;

  struct Distance {
    double lower = 0, upper = 0;
  };
  /// Proven bounds of how far p is from the form, some rounding apart; 0 is the least.
  Distance distance(const Vec3& p) const;

  /// A mesh of flat faces, closed and outwards. Guaranteed, exactly: with Curved::Around it encloses the form, with
  /// Curved::Within the form encloses it. `segments` is the number of corners around the axis, at least 8.
  TriangleMesh mesh(Curved curved, std::size_t segments) const;

  /// No coordinate of a point of the form, or of its pose, is greater, but for rounding.
  double largest_coordinate() const;

  bool operator==(const CurvedForm&) const = default;

 private:
  enum class Kind { Sphere, Cylinder, Capsule };
  CurvedForm(Kind kind, double radius, double length, const Pose& pose)
      : kind_(kind), radius_(radius), half_(length / 2), pose_(pose) {}

  template <class Number>
  Number excess(int bound, const Vec3& p) const;
  bool keeps(int bound, const Vec3& p) const;
  double skew() const;
  double margin() const;
  bool has_exact_caps() const;

  Kind kind_;
  double radius_, half_;  // half the length
  Pose pose_;
};

}  // namespace prohull::robot
