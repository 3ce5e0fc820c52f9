#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "query/line.h"

namespace prohull {

/// Balls in single precision, to tell of many things at once which a query certainly misses: each thing is the convex
/// hull of points, and each ball holds one.
class Balls {
 public:
  /// Requires all things to lie in `frame`.
  explicit Balls(const Box& frame);

  void add(std::span<const Vec3> points);
  std::size_t size() const { return radius_.size(); }

  /// may_meet[i] becomes 0 only if the line, unmoved, certainly has no point in common with thing i; else 1.
  void mark(const DirectedLine& line, std::span<std::uint8_t> may_meet) const;
  void mark(const Box& box, std::span<std::uint8_t> may_meet) const;

  std::size_t memory_bytes() const { return 4 * radius_.capacity() * sizeof(float); }

 private:
  /// Where the frame is [-1, 1]^3 or a little less; rounded by at most 2^-51 for points of the frame, and by 2^-52 of
  /// its size for any other.
  Vec3 in_frame(const Vec3& p) const { return (p - center_) * scale_; }

  Vec3 center_;
  double scale_;  ///< a power of two; NaN where single precision will not do, and then everything is marked
  std::vector<float> x_, y_, z_, radius_;
};

}  // namespace prohull
