#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>

#include "collide/obb_tree.h"
#include "collide/placed_mesh.h"
#include "geometry/simd.h"

namespace prohull {

/// Where the boxes of one tree are as the other tree sees them, and how well that is known.
///
/// Distances that are compared below are wrong by at most the slack. Let u = 2^-24, and S the sum of both radii and the
/// distance between the centers of the meshes; the unit is such that S does not exceed 4. The rotation has errors of u
/// in each entry; products of axes, sums of three products twice, have errors of at most 18 u; the vector between the
/// centers 10 u S, and its products with axes 24 u S to 80 u S; the radii, sums of three or four products, 70 u S.
/// Together less than 2^8 u S. To this come the rounding of the placed points, and what the matrices lack to be
/// rotations.
class BoxPair {
 public:
  /// Boxes are apart if they are farther from each other than `margin`.
  BoxPair(const ObbTree& a, const Pose& pose_a, const ObbTree& b, const Pose& pose_b, double margin = 0) {
    const Vec3 between =
        (rotated(pose_b, b.center()) - rotated(pose_a, a.center())) + (pose_b.translation - pose_a.translation);
    const double distance = norm(between), radii = a.radius() + b.radius();
    const double defect = 4 * (rotation_defect(pose_a) + rotation_defect(pose_b)) + 0x1p-48;
    const double rounding = rounding_bound(pose_a, a.reach()) + rounding_bound(pose_b, b.reach()) + margin;
    const double size = radii + distance;
    gap_ = distance - radii - size * defect - rounding;
    unit_ = std::min({a.unit(), b.unit(), std::ldexp(1.0, -std::max(-500, std::ilogb(std::max(size, 0x1p-500))))});
    scale_a_ = static_cast<float>(unit_ / a.unit()), scale_b_ = static_cast<float>(unit_ / b.unit());
    slack_ = both4(static_cast<float>(unit_ * (size * (0x1p-16 + defect) + rounding) * (1 + 0x1p-20) + 0x1p-100));
    relative_error_ = defect + 0x1p-18;
    const Vec3 t = transposed_rotated(pose_a, between) * unit_;
    for (int k = 0; k < 3; ++k) translation_[k] = static_cast<float>(t[k]);
    for (unsigned j = 0; j < 3; ++j) {
      const Vec3 column = transposed_rotated(
          pose_a, {pose_b.rotation[0][int(j)], pose_b.rotation[1][int(j)], pose_b.rotation[2][int(j)]});
      for (int k = 0; k < 3; ++k) {
        columns_[j][k] = static_cast<float>(column[k]);
        entries_[k][j] = both4(static_cast<float>(column[k]));
      }
    }
  }

  /// Whether the balls around the two meshes are apart.
  bool are_far_apart() const { return gap_ > 0; }

  /// Whether the two boxes may have a point in common; if not, no two triangles in them touch.
  bool may_meet(const ObbNode& a, const ObbNode& b) const {
    const View view(*this, a, b);
    if (mask(view.gaps_along_a() > slack_) & 7) return false;
    if (mask(view.gaps_along_b() > slack_) & 7) return false;
    return !view.separated_by_edges(slack_);
  }

  /// A direction of the input, of any length, as distance_bound takes it.
  Float4 direction(const Pose& pose_a, const Vec3& v) const {
    const Vec3 own = transposed_rotated(pose_a, v);
    const double length = norm(own);
    if (!(length > 0)) return Float4{};
    return Float4{static_cast<float>(own.x / length), static_cast<float>(own.y / length),
                  static_cast<float>(own.z / length), 0};
  }

  /// The shortest way from the box a to a box around b with the axes of a, of length 1; or the other way round.
  Float4 direction_between(const ObbNode& a, const ObbNode& b) const {
    const View view(*this, a, b);
    const Float4 gaps = view.gaps_along_a(), gaps_b = view.gaps_along_b();
    float best_a = 0, best_b = 0;
    for (int i = 0; i < 3; ++i) best_a = std::max(best_a, gaps[i]), best_b = std::max(best_b, gaps_b[i]);
    if (best_a <= 0 && best_b <= 0) return Float4{};
    Float4 v{};
    const Float4 ax = load(a.axes), ay = load(a.axes + 3), az = load(a.axes + 6);
    if (best_a >= best_b) {
      for (int i = 0; i < 3; ++i)
        if (gaps[i] > 0) v += Float4{ax[i], ay[i], az[i], 0} * both4(std::copysign(gaps[i], view.d[i]));
    } else {
      const Float4 d_b = both4(view.d[0]) * view.m[0] + both4(view.d[1]) * view.m[1] + both4(view.d[2]) * view.m[2];
      Float4 in_a{};  // along the axes of a
      for (int j = 0; j < 3; ++j)
        if (gaps_b[j] > 0)
          in_a += Float4{view.m[0][j], view.m[1][j], view.m[2][j], 0} * both4(std::copysign(gaps_b[j], d_b[j]));
      for (int i = 0; i < 3; ++i) v += Float4{ax[i], ay[i], az[i], 0} * both4(in_a[i]);
    }
    const Float4 square = v * v;
    const float length = std::sqrt(square[0] + square[1] + square[2]);
    return length > 0 ? v * both4(1 / length) : Float4{};
  }

  /// A lower bound of the distance between points in the boxes, in the input's unit. It is good if `direction` is that
  /// of the shortest way from a to b; it holds for any.
  double distance_bound(const ObbNode& a, const ObbNode& b, Float4 direction) const {
    const View view(*this, a, b);
    const auto length = [&](Float4 gaps) {
      double sum = 0;
      for (int i = 0; i < 3; ++i) {
        const double gap = std::max(0.0f, gaps[i] - slack_[i]);
        sum += gap * gap;
      }
      return sum;
    };
    const Float4 ax = load(a.axes), ay = load(a.axes + 3), az = load(a.axes + 6);
    const float along =
        std::max(view.gap_along_centers(),
                 view.gap_along(ax * both4(direction[0]) + ay * both4(direction[1]) + az * both4(direction[2])));
    const double gap = std::max(0.0f, along - slack_[0]);
    const double squared = std::max({length(view.gaps_along_a()), length(view.gaps_along_b()), gap * gap});
    return std::sqrt(squared) / unit_ * (1 - relative_error_);
  }

  /// A lower bound of how far apart the boxes are along a direction, which need not be that of any way.
  double gap_along(const ObbNode& a, const ObbNode& b, Float4 direction) const {
    const Float4 ax = load(a.axes), ay = load(a.axes + 3), az = load(a.axes + 6);
    const float gap =
        View(*this, a, b).gap_along(ax * both4(direction[0]) + ay * both4(direction[1]) + az * both4(direction[2])) -
        slack_[0];
    return gap / unit_ * (1 - std::copysign(relative_error_, gap));
  }

  bool is_larger(const ObbNode& a, const ObbNode& b) const {
    return std::max({a.half[0], a.half[1], a.half[2]}) * scale_a_ >
           std::max({b.half[0], b.half[1], b.half[2]}) * scale_b_;
  }

  /// A measure of how far apart the boxes' centers are.
  float nearness(const ObbNode& a, const ObbNode& b) const {
    const Float4 v = between_centers(a, b);
    const Float4 square = v * v;
    return square[0] + square[1] + square[2];
  }

 private:
  static Float4 both4(float x) { return Float4{x, x, x, x}; }
  static Float4 load(const float* from) {
    Float4 v;
    std::memcpy(&v, from, sizeof v);
    return v;
  }
  static Float4 abs4(Float4 x) {
    return std::bit_cast<Float4>(std::bit_cast<Truth4>(x) & std::numeric_limits<std::int32_t>::max());
  }

  /// In the coordinates of a's tree.
  Float4 between_centers(const ObbNode& a, const ObbNode& b) const {
    const Float4 ca{a.center[0], a.center[1], a.center[2], 0};
    return columns_[0] * both4(b.center[0] * scale_b_) + columns_[1] * both4(b.center[1] * scale_b_) +
           columns_[2] * both4(b.center[2] * scale_b_) + (translation_ - ca * both4(scale_a_));
  }

  /// Two boxes, each seen along the axes of the other. Lanes 0 to 2 are axes; lane 3 holds anything finite.
  struct View {
    View(const BoxPair& pair, const ObbNode& a, const ObbNode& b)
        : ha(load(a.half) * both4(pair.scale_a_)), hb(load(b.half) * both4(pair.scale_b_)) {
      const Float4 bx = load(b.axes), by = load(b.axes + 3), bz = load(b.axes + 6);
      const auto& r = pair.entries_;
      const Float4 wx = r[0][0] * bx + r[0][1] * by + r[0][2] * bz, wy = r[1][0] * bx + r[1][1] * by + r[1][2] * bz,
                   wz = r[2][0] * bx + r[2][1] * by + r[2][2] * bz;
      const Float4 ax = load(a.axes), ay = load(a.axes + 3), az = load(a.axes + 6);
      for (int i = 0; i < 3; ++i) m[i] = both4(ax[i]) * wx + both4(ay[i]) * wy + both4(az[i]) * wz, n[i] = abs4(m[i]);
      const Float4 v = pair.between_centers(a, b);
      d = ax * both4(v[0]) + ay * both4(v[1]) + az * both4(v[2]);
    }

    Float4 gaps_along_a() const {
      const Float4 low = __builtin_shufflevector(n[0], n[1], 0, 4, 1, 5),
                   high = __builtin_shufflevector(n[0], n[1], 2, 6, 3, 7);
      const Float4 c0 = __builtin_shufflevector(low, n[2], 0, 1, 4, 4),
                   c1 = __builtin_shufflevector(low, n[2], 2, 3, 5, 5),
                   c2 = __builtin_shufflevector(high, n[2], 0, 1, 6, 6);
      return abs4(d) - (ha + c0 * both4(hb[0]) + c1 * both4(hb[1]) + c2 * both4(hb[2]));
    }
    Float4 gaps_along_b() const {
      return abs4(both4(d[0]) * m[0] + both4(d[1]) * m[1] + both4(d[2]) * m[2]) -
             (hb + n[0] * both4(ha[0]) + n[1] * both4(ha[1]) + n[2] * both4(ha[2]));
    }
    /// Along the vector between the centers.
    float gap_along_centers() const {
      const Float4 square = d * d,
                   reach = abs4(d) * ha + abs4(both4(d[0]) * m[0] + both4(d[1]) * m[1] + both4(d[2]) * m[2]) * hb;
      const float length = std::sqrt(square[0] + square[1] + square[2]);
      return length > 0 ? length - (reach[0] + reach[1] + reach[2]) / length : 0;
    }
    /// Along a unit vector from a to b, in the axes of a.
    float gap_along(Float4 along_a) const {
      const Float4 along_b = both4(along_a[0]) * m[0] + both4(along_a[1]) * m[1] + both4(along_a[2]) * m[2];
      const Float4 sum = along_a * d - (abs4(along_a) * ha + abs4(along_b) * hb);
      return sum[0] + sum[1] + sum[2];
    }
    /// Along the products of an axis of a and the axes of b. Where these are nearly parallel, all numbers are small,
    /// and nothing is separated.
    bool separated_by_edges(Float4 slack) const {
      const Float4 hb1 = __builtin_shufflevector(hb, hb, 1, 2, 0, 3), hb2 = __builtin_shufflevector(hb, hb, 2, 0, 1, 3);
      for (int i = 0; i < 3; ++i) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        const Float4 n1 = __builtin_shufflevector(n[i], n[i], 1, 2, 0, 3),
                     n2 = __builtin_shufflevector(n[i], n[i], 2, 0, 1, 3);
        const Float4 distance = abs4(both4(d[i2]) * m[i1] - both4(d[i1]) * m[i2]);
        const Float4 radii = both4(ha[i1]) * n[i2] + both4(ha[i2]) * n[i1] + hb1 * n2 + hb2 * n1;
        if (mask(distance - radii > slack) & 7) return true;
      }
      return false;
    }

    Float4 ha, hb;      // half sizes
    Float4 m[3], n[3];  // m[i][j]: the product of axis i of a and axis j of b; n: |m|
    Float4 d;           // the vector between the centers along the axes of a
  };

  Float4 columns_[3], entries_[3][3], translation_{}, slack_;
  float scale_a_, scale_b_;
  double unit_, gap_ = 0, relative_error_;
};

}  // namespace prohull
