#include "geometry/apart_filter.h"

#include <algorithm>
#include <cmath>

namespace prohull {
namespace {

/// Of the axis' largest coordinate and of the corners': more than rounding moves a gap between two projections. Each is
/// three products of (4 + 1) u and two sums of 2 * 3 u, with u = 2^-53; two of them and their difference make 48 u.
constexpr double kRounding = 0x1p-47;
/// More than what underflows; and below what overflows, of the product of the two.
constexpr double kUnderflow = 0x1p-1000, kLargest = 0x1p900;

double largest_of(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

Double2 largest_of(const Vec3Pair& v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); }

/// Two triangles, one in each lane.
struct TwoTriangles {
  TwoTriangles(const ApartFilter::Corners& s, const ApartFilter::Corners& t)
      : a(both(s[0], t[0])), b(both(s[1], t[1])), c(both(s[2], t[2])) {}
  Vec3Pair a, b, c;
};

/// Where the gap on an axis is certain: between [low, high] of the tetrahedron and the triangles.
Truth2 has_gap(const Vec3Pair& axis, const TwoTriangles& t, Double2 low, Double2 high, Double2 largest) {
  const Double2 rounding = kRounding * largest + kUnderflow;
  const Double2 a = dot(axis, t.a), b = dot(axis, t.b), c = dot(axis, t.c);
  return (largest < kLargest) & ((min(min(a, b), c) - high > rounding) | (low - max(max(a, b), c) > rounding));
}

}  // namespace

ApartFilter::ApartFilter(const std::array<Vec3, 4>& tetrahedron) : corners_(tetrahedron) {
  const auto& [a, b, c, d] = corners_;
  largest_ = std::max({largest_of(a), largest_of(b), largest_of(c), largest_of(d)});
  edges_ = {b - a, c - a, d - a, c - b, d - b, d - c};
  const std::array directions{cross(edges_[0], edges_[1]), cross(edges_[0], edges_[2]), cross(edges_[1], edges_[2]),
                              cross(edges_[3], edges_[4])};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3& n = directions[i];
    const auto [low, high] = std::minmax({dot(n, a), dot(n, b), dot(n, c), dot(n, d)});
    normals_[i] = {n, low, high, largest_of(n)};
  }
}

unsigned ApartFilter::certainly_apart(const Corners& first, const Corners& second) const {
  constexpr unsigned kBoth = 3;
  const TwoTriangles t(first, second);
  const Double2 of_corners = max(both(largest_), max(max(largest_of(t.a), largest_of(t.b)), largest_of(t.c)));
  unsigned apart = 0;
  for (const auto& [direction, low, high, largest] : normals_) {
    apart |= mask(has_gap(both(direction), t, both(low), both(high), of_corners * largest));
    if (apart == kBoth) return apart;
  }
  const auto test = [&](const Vec3Pair& axis) {
    const auto& [a, b, c, d] = corners_;
    const Double2 pa = dot(axis, both(a)), pb = dot(axis, both(b)), pc = dot(axis, both(c)), pd = dot(axis, both(d));
    apart |= mask(
        has_gap(axis, t, min(min(pa, pb), min(pc, pd)), max(max(pa, pb), max(pc, pd)), of_corners * largest_of(axis)));
    return apart == kBoth;
  };
  const std::array sides{t.b - t.a, t.c - t.b, t.a - t.c};
  if (test(cross(sides[0], sides[1]))) return apart;
  for (const Vec3& edge : edges_)
    for (const Vec3Pair& side : sides)
      if (test(cross(side, both(edge)))) return apart;
  return apart;
}

}  // namespace prohull
