#pragma once

#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/simd.h"
#include "prohull/geometry.h"

namespace prohull {

/// The half-space normal . x >= offset.
struct HalfSpace {
  Vec3 normal;
  double offset;
};

/// A list of half-spaces that lies in memory two by two, one in each lane.
class HalfSpaces {
 public:
  struct Pair {
    Vec3Pair normal;
    Double2 offset;
  };

  HalfSpaces() = default;
  HalfSpaces(std::initializer_list<HalfSpace> all) {
    for (const HalfSpace& one : all) push_back(one);
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  HalfSpace operator[](std::size_t i) const {
    const auto& [normal, offset] = pairs_[i / 2];
    return {normal[static_cast<int>(i % 2)], offset[i % 2]};
  }
  void clear() { pairs_.clear(), size_ = 0; }
  void push_back(const HalfSpace& one) {
    if (size_++ % 2 == 0)
      pairs_.push_back({both(one.normal), both(one.offset)});
    else
      pairs_.back() = {both(pairs_.back().normal[0], one.normal), Double2{pairs_.back().offset[0], one.offset}};
  }
  /// The pairs are to be set.
  void resize(std::size_t size) { pairs_.resize((size + 1) / 2), size_ = size; }

  /// The last of an odd number comes twice.
  const std::vector<Pair>& pairs() const { return pairs_; }
  std::vector<Pair>& pairs() { return pairs_; }

 private:
  std::vector<Pair> pairs_;
  std::size_t size_ = 0;
};

enum class LinearProgramStatus {
  Optimal,     ///< one optimal vertex
  Infeasible,  ///< no point satisfies all constraints (nearer than kFarAway)
  Ambiguous,  ///< optimal along a line or plane (all normals nearly in one plane), or farther than kFarAway, or stalled
};

struct LinearProgramResult {
  LinearProgramStatus status;
  Vec3 x;
};

/// Points with a coordinate beyond are out of reach; callers scale their problem to about 1.
constexpr double kFarAway = 64;

/// min objective . x subject to all constraints, by the dual simplex method: from the optimal corner of the box
/// |x_i| <= kFarAway, the most violated constraint enters, until none is violated by more than rounding.
LinearProgramResult solve_linear_program(const Vec3& objective, const HalfSpaces& constraints);

/// The point nearest to `target` that satisfies all constraints (up to rounding), by the dual active-set method of
/// Goldfarb and Idnani (1983) for the identity as quadratic form; nothing if there is none, or it stalled.
std::optional<Vec3> nearest_feasible_point(const Vec3& target, const HalfSpaces& constraints);

/// The optimum if the program has one for certain, none of its coordinates beyond `reach`; otherwise, as where coplanar
/// constraints leave it unbounded, the feasible point nearest to the origin, under the same condition.
std::optional<Vec3> optimum_or_nearest(const Vec3& objective, const HalfSpaces& constraints,
                                       double reach = std::numeric_limits<double>::infinity());

}  // namespace prohull
