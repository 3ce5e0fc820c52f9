#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "prohull/geometry.h"

namespace prohull {

/// The half-space normal . x >= offset.
struct HalfSpace {
  Vec3 normal;
  double offset;
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
LinearProgramResult solve_linear_program(const Vec3& objective, const std::vector<HalfSpace>& constraints);

/// The point nearest to `target` that satisfies all constraints (up to rounding), by the dual active-set method of
/// Goldfarb and Idnani (1983) for the identity as quadratic form; nothing if there is none, or it stalled.
std::optional<Vec3> nearest_feasible_point(const Vec3& target, const std::vector<HalfSpace>& constraints);

/// The optimum if the program has one for certain, none of its coordinates beyond `reach`; otherwise, as where coplanar
/// constraints leave it unbounded, the feasible point nearest to the origin, under the same condition.
std::optional<Vec3> optimum_or_nearest(const Vec3& objective, const std::vector<HalfSpace>& constraints,
                                       double reach = std::numeric_limits<double>::infinity());

}  // namespace prohull
