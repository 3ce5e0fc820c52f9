#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "query/wide_bvh.h"

namespace prohull {

/// A line as the boxes of a WideBvh see it, conservatively: float32 planes meet float32 origins.
///
/// t = (plane - origin) / direction is bounded from below at the near plane and from above at the far one by rounding
/// the origin up or down. Difference, direction, inverse and product then have a relative error of at most 4 eps +
/// O(eps^2), eps = 2^-24, and the right sign; so far values by an inverse times kWiden, another eps or two, are safe.
/// No product underflows at the far plane of a box that is not behind the origin, as that is rounded by 2^-60 at least.
/// Axes along which this does not hold, where the direction is neither 0 nor of a middling size, are left out: their
/// origins are NaN, and NaN is never chosen.
struct WideLine {
  static constexpr float kWiden = 1 + 16 * 0x1p-24f, kUnderflow = 0x1p-100f;
  /// No less than any t up to this that boxes may give.
  static float end(double t) { return static_cast<float>(t) * kWiden + kUnderflow; }

  WideLine(const WideBvh& tree, const DirectedLine& line)
      : origin(tree.in_frame(line.origin)), direction(line.direction * tree.scale()) {
    constexpr int kSign = std::numeric_limits<int>::min();
    const auto o = Float4{float(origin.x), float(origin.y), float(origin.z), 0},
               d = Float4{float(direction.x), float(direction.y), float(direction.z), 1};
    const Truth4 sign = std::bit_cast<Truth4>(d) & kSign;
    const auto size_o = std::bit_cast<Float4>(std::bit_cast<Truth4>(o) & ~kSign),
               size_d = std::bit_cast<Float4>(std::bit_cast<Truth4>(d) & ~kSign);
    // Away from the near plane, which is that of the greater coordinate if the line goes backwards.
    const auto away = std::bit_cast<Float4>(std::bit_cast<Truth4>(size_o * 0x1p-23f + 0x1p-60f) | sign);
    const Truth4 is_zero = {-(line.direction.x == 0), -(line.direction.y == 0), -(line.direction.z == 0), 0};
    const Truth4 usable = (((size_d > 0x1p-60f) & (size_d < 0x1p60f)) | is_zero) & (size_o < 0x1p100f);
    const auto from = std::bit_cast<Float4>(std::bit_cast<Truth4>(o) | ~usable);  // NaN
    near_origin = from + away, far_origin = from - away, inverse = 1 / d;
    backwards = sign;
  }

  Vec3 origin, direction;  ///< in the frame
  Float4 near_origin, far_origin, inverse;
  Truth4 backwards;  ///< not 0 where the near plane is that of the greater coordinate
};

struct Range {
  double low, high;
};

/// The same line as the faces of leaves see it (Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", 2013).
///
/// With k the axis along which the direction D is greatest, and i, j those after it, the line is projected along itself
/// to a point, and a corner p to (u, v) = (p_i - D_i / D_k p_k + u0, p_j - D_j / D_k p_k + v0), seen from that point.
/// For corners a, b the sign of u_a v_b - v_a u_b is that of dot(D, (a - o) cross (b - o)) times that of D_k.
///
/// A leaf does that in its quanta: u = q_i + slope q_k + c, where q is at most 2^16 and c is u0 and the leaf's low
/// corner, computed in double and rounded. In quanta, q_i and slope q_k are off by kCornerError each; the slope, its
/// product and the sum of both are rounded by at most 2^-9, 2^-9 and 2^-8, c by 2^-24 |c|, and the last sum by 2^-24
/// (|c| + 2^17): together by less than d = 2 kCornerError + 0.25 + 2^-23 |c| + error / quantum, where `error` is
/// that of c in the frame: its coordinates, slopes, products and sums have errors of at most 11 eps (1 + |o|), eps =
/// 2^-53.
///
/// Let m be no less than any |u|, |v| of the three corners, as computed. A product u v is then within 2 m d + d^2, the
/// difference of two within twice that. Rounding all three adds 2^-22 m^2, which is less than 2 m d, as m is at most
/// |c| + 2^17.2. So the value is within 8 d m + 8 d^2, also as that is evaluated. NaN and infinity, of lines along
/// which this does not hold, decide nothing.
struct WideShear {
  explicit WideShear(const WideLine& line);

  /// Between which t the line crosses a face of which the values of the edges ab, bc, ca are certainly of one sign.
  ///
  /// The depth w of the crossing, in quanta along k, is the mean of the depths of the corners, weighted by the edges
  /// that face them. With true values E_i = E'_i + e_i, sums S and S', and corners off by c_i, w - w' = (sum of e_i
  /// (q_i - w') + sum of E_i c_i) / S: no more than 3 error range / (S' - 3 error) + kCornerError.
  Range range_of(const WideBvh::Leaf& leaf, int face, const std::array<double, 3>& edges, double edge_error) const {
    const double a = leaf.corner[0][k][face], b = leaf.corner[1][k][face], c = leaf.corner[2][k][face];
    const double sum = edges[0] + edges[1] + edges[2], depth = (edges[0] * c + edges[1] * a + edges[2] * b) / sum;
    const double range = std::max({a, b, c}) - std::min({a, b, c}), slack = std::abs(sum) - 3 * edge_error;
    const double depth_error =
        slack > 0 ? 3 * edge_error * range / slack + WideBvh::kCornerError : std::numeric_limits<double>::infinity();
    const double t = (leaf.low[static_cast<std::size_t>(k)] + depth / leaf.per_quantum - origin_k) / direction_k;
    const double t_error = (depth_error / leaf.per_quantum + error) / std::abs(direction_k);
    return {t - t_error, t + t_error};
  }

  int i, j, k;
  double slope_u, slope_v, u0, v0, error;
  double origin_k, direction_k;
  bool k_forwards;  ///< D_k > 0
};

}  // namespace prohull
