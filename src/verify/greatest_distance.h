#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "geometry/heap_with_ties.h"
#include "prohull/distance.h"

namespace prohull::verify {

/// The corner from which the longest side of a triangle goes to the next corner. Halves at its middle stay as round as
/// the triangle was.
inline int longest_side(const std::array<Vec3, 3>& corners) {
  int longest = 0;
  double length = -1;
  for (int i = 0; i < 3; ++i)
    if (const double l = squared_norm(corners[(i + 1) % 3] - corners[i]); l > length) length = l, longest = i;
  return longest;
}

/// When a search ends.
struct SearchLimits {
  double relative_gap = 0, absolute_gap = 0;  ///< between the bounds
  std::size_t max_parts = 0;
  double decides =
      0;  ///< the search goes on until it is known on which side of this the greatest distance is, if it can
  std::size_t patience = 0;  ///< once so many parts were seen, nothing is improved that is below `decides`
};

/// Bounds the greatest distance of points: the part whose bound is greatest is cut, again and again. The rule says what
/// parts are, such as parts of faces, and from what distances count:
///
///   Part                 a part of the points
///   cut(part, search)    adds parts to the search that have all points of the part, and calls search.reaches for
///                        points that it finds
///
/// A search is as wide as its limits allow; the bound `upper` holds whenever it ends.
template <class Rule>
class GreatestDistance {
 public:
  using Part = typename Rule::Part;

  GreatestDistance(const Rule& rule, const SearchLimits& limits) : rule_(rule), limits_(limits) {}

  /// There is a point so far away.
  void reaches(const Vec3& p, double distance) {
    if (distance > bounds_.lower) bounds_.lower = distance, bounds_.farthest = p;
  }
  /// So many faces were looked at for a point. Around a vertex of many faces these are thousands: the search then ends
  /// after fewer parts.
  void took(std::size_t faces) {
    constexpr std::size_t kUsual = 100;  // and less, but for needles
    seen_ += faces / kUsual;
  }
  double lower() const { return bounds_.lower; }
  bool is_enough(double upper) const {
    if (upper <= limits_.decides && seen_ > limits_.patience) return true;
    const bool is_known = bounds_.lower > limits_.decides || upper <= limits_.decides;
    return is_known && upper <= (1 + limits_.relative_gap) * bounds_.lower + limits_.absolute_gap;
  }

  /// No point of the part that counts is farther away than `upper`.
  void add(const Part& part, double upper) {
    ++seen_;
    if (is_enough(upper)) return leave(upper);
    if (free_.empty()) free_.push_back(parts_.size()), parts_.emplace_back();
    parts_[free_.back()] = part;
    open_.push({upper, free_.back()});
    free_.pop_back();
  }

  /// The same of a part that is not to be cut.
  void leave(double upper) { settled_ = std::max(settled_, upper); }

  /// Of all parts that were added; calls `next` before it cuts one.
  template <class Next>
  DistanceBounds run(Next next) {
    while (!open_.empty() && !is_enough(open_.top().upper) && seen_ < limits_.max_parts) {
      next();
      const Part part = parts_[open_.top().part];
      free_.push_back(open_.top().part);
      open_.pop();
      rule_.cut(part, *this);
    }
    bounds_.upper = std::max({open_.empty() ? 0 : open_.top().upper, settled_, bounds_.lower});
    return bounds_;
  }

 private:
  struct Open {
    double upper;
    std::size_t part;
    bool operator<(const Open& other) const { return upper < other.upper; }
  };

  const Rule& rule_;
  const SearchLimits limits_;
  std::vector<Part> parts_;
  std::vector<std::size_t> free_;  ///< places in `parts_` of parts that were cut
  HeapWithTies<Open> open_;
  double settled_ = 0;  ///< the greatest bound of parts that are not cut
  std::size_t seen_ = 0;
  DistanceBounds bounds_;
};

}  // namespace prohull::verify
