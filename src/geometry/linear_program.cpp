#include "geometry/linear_program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/simd.h"

namespace prohull {
namespace {

constexpr int kMaxIterations = 100;
// Constraints are satisfied when not violated by more than this, relative to |normal| <= about 1 and |x| <= kFarAway.
constexpr double kFeasible = 1e-12;

constexpr std::ptrdiff_t kBox = -1;

// Three tight constraints with independent normals. column(i) . normal_j = (i == j), so that a step along column(i)
// leaves the other two tight.
struct Basis {
  std::array<Vec3Pair, 2> columns_and_x;  ///< lane by lane: three columns, then x
  std::array<Double2, 2> multipliers;     ///< objective = sum of multiplier_i normal_i, all >= 0: dual feasible
  std::array<std::ptrdiff_t, 3> constraint;

  void set(int i, const Vec3& column, double multiplier) {
    set(i, column);
    multipliers[i / 2][i % 2] = multiplier;
  }
  void set(int i, const Vec3& point) {
    Vec3Pair& two = columns_and_x[i / 2];
    two.x[i % 2] = point.x, two.y[i % 2] = point.y, two.z[i % 2] = point.z;
  }
  void set_x(const Vec3& x) { set(3, x); }
  Vec3 x() const { return columns_and_x[1][1]; }
};

Basis box_corner(const Vec3& objective) {
  Basis basis;
  basis.multipliers[1] = both(0);  // there is no fourth
  Vec3 x;
  for (int i = 0; i < 3; ++i) {
    const double sign = objective[i] < 0 ? -1 : 1;
    Vec3 column;
    column[i] = sign;
    basis.set(i, column, std::abs(objective[i]));
    basis.constraint[i] = kBox;
    x[i] = -sign * kFarAway;
  }
  basis.set_x(x);
  return basis;
}

// The first of those violated most, or -1. Without branches, which nothing could predict.
std::ptrdiff_t most_violated(const Vec3& x, const HalfSpaces& constraints) {
  const Vec3Pair at = both(x);
  Double2 least = both(-kFeasible);
  Truth2 worst = {-1, -1}, i = {0, 1};
  for (const auto& [normal, offset] : constraints.pairs()) {
    const Double2 slack = dot(normal, at) - offset;
    const Truth2 is_less = slack < least;
    least = min(slack, least);
    worst = (i & is_less) | (worst & ~is_less);
    i += 2;
  }
  // Of the last, if it came twice, lane 1 only ties with lane 0.
  const bool is_second = int(least[1] < least[0]) | (int(least[1] == least[0]) & int(worst[1] < worst[0]));
  return static_cast<std::ptrdiff_t>(is_second ? worst[1] : worst[0]);
}

// Lets constraint `entering` into the basis for the one whose multiplier reaches zero first; false if none does, that
// is, if the basis and the entering constraint exclude each other.
bool pivot(Basis& basis, std::ptrdiff_t entering, const HalfSpace& constraint) {
  constexpr double kPivot = 1e-13;
  const Vec3Pair normal = both(constraint.normal);
  // Of the columns, and how far x is beyond the constraint.
  const std::array<Double2, 2> alpha{dot(normal, basis.columns_and_x[0]),
                                     dot(normal, basis.columns_and_x[1]) - Double2{0, constraint.offset}};
  const auto ratios = [&](int k) {
    return select(alpha[k] > kPivot, basis.multipliers[k] / alpha[k], both(std::numeric_limits<double>::infinity()));
  };
  const Double2 first_ratios = ratios(0);
  const double third_ratio = ratios(1)[0];
  int leaving = first_ratios[1] < first_ratios[0];
  double least_ratio = leaving ? first_ratios[1] : first_ratios[0];
  if (third_ratio < least_ratio) least_ratio = third_ratio, leaving = 2;
  if (least_ratio == std::numeric_limits<double>::infinity()) return false;

  const Vec3 column = basis.columns_and_x[leaving / 2][leaving % 2] / alpha[leaving / 2][leaving % 2];
  const Vec3Pair step = both(column);
  static constexpr Truth2 kLeaving[3][2] = {{{-1, 0}, {0, 0}}, {{0, -1}, {0, 0}}, {{0, 0}, {-1, 0}}};
  for (int k = 0; k < 2; ++k) {
    const Truth2 leaves = kLeaving[leaving][k];
    Vec3Pair& to = basis.columns_and_x[k];
    to.x = select(leaves, step.x, to.x - step.x * alpha[k]);
    to.y = select(leaves, step.y, to.y - step.y * alpha[k]);
    to.z = select(leaves, step.z, to.z - step.z * alpha[k]);
    const Double2 multiplier = basis.multipliers[k] - least_ratio * alpha[k];
    basis.multipliers[k] = select(leaves, both(least_ratio), max(multiplier, both(0)));
  }
  basis.constraint[leaving] = entering;
  return true;
}

// Its sides that have left the basis bound x no longer.
bool is_in_box(const Basis& basis) {
  const Vec3 x = basis.x();
  return std::ranges::count(basis.constraint, kBox) == 0 && std::abs(x.x) <= kFarAway && std::abs(x.y) <= kFarAway &&
         std::abs(x.z) <= kFarAway;
}

// Whether x, moved from vertex to vertex, still is where the three constraints of the basis are tight.
bool has_drifted(const Basis& basis, const HalfSpaces& constraints) {
  return std::ranges::any_of(basis.constraint, [&](std::ptrdiff_t i) {
    const auto [normal, offset] = constraints[static_cast<std::size_t>(i)];
    return std::abs(dot(normal, basis.x()) - offset) > kFeasible;
  });
}

// Computes the basis anew from its constraints, as after a passage through one of nearly dependent normals.
void refresh(Basis& basis, const Vec3& objective, const HalfSpaces& constraints) {
  const auto at = [&](int i) {
    return constraints[static_cast<std::size_t>(basis.constraint[static_cast<std::size_t>(i % 3)])];
  };
  const double determinant = dot(at(0).normal, cross(at(1).normal, at(2).normal));
  if (determinant == 0) return;
  Vec3 x;
  for (int i = 0; i < 3; ++i) {
    const Vec3 column = cross(at(i + 1).normal, at(i + 2).normal) / determinant;
    basis.set(i, column, std::max(0.0, dot(objective, column)));
    x += column * at(i).offset;
  }
  basis.set_x(x);
}

}  // namespace

LinearProgramResult solve_linear_program(const Vec3& objective, const HalfSpaces& constraints) {
  Basis basis = box_corner(objective);
  bool is_fresh = false;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const std::ptrdiff_t entering = most_violated(basis.x(), constraints);
    if (entering < 0) {
      if (!is_in_box(basis)) return {LinearProgramStatus::Ambiguous, basis.x()};
      if (is_fresh || !has_drifted(basis, constraints)) return {LinearProgramStatus::Optimal, basis.x()};
      refresh(basis, objective, constraints);
      is_fresh = true;
      continue;
    }
    is_fresh = false;
    if (!pivot(basis, entering, constraints[static_cast<std::size_t>(entering)]))
      return {LinearProgramStatus::Infeasible, basis.x()};
  }
  return {LinearProgramStatus::Ambiguous, basis.x()};
}

namespace {

// Tight constraints, their normals made orthonormal by Gram-Schmidt, and the non-negative combination of the normals
// that leads from the target to x.
struct ActiveSet {
  int size = 0;
  std::array<std::size_t, 3> constraint;
  std::array<double, 3> multiplier;
};

// Solves sum_j (normal_i . normal_j) r_j = normal_i . n for the active normals: r expresses the part of n in their
// span.
bool express(const ActiveSet& active, const HalfSpaces& constraints, const Vec3& n, std::array<double, 3>& r) {
  double m[3][4];
  for (int i = 0; i < active.size; ++i) {
    const Vec3 ni = constraints[active.constraint[i]].normal;
    for (int j = 0; j < active.size; ++j) m[i][j] = dot(ni, constraints[active.constraint[j]].normal);
    m[i][active.size] = dot(ni, n);
  }
  for (int k = 0; k < active.size; ++k) {
    int best = k;
    for (int i = k + 1; i < active.size; ++i)
      if (std::abs(m[i][k]) > std::abs(m[best][k])) best = i;
    if (m[best][k] == 0) return false;
    for (int j = 0; j <= active.size; ++j) std::swap(m[k][j], m[best][j]);
    for (int i = 0; i < active.size; ++i) {
      if (i == k) continue;
      const double factor = m[i][k] / m[k][k];
      for (int j = k; j <= active.size; ++j) m[i][j] -= factor * m[k][j];
    }
  }
  for (int i = 0; i < active.size; ++i) r[i] = m[i][active.size] / m[i][i];
  return true;
}

void drop(ActiveSet& active, int i) {
  --active.size;
  for (int j = i; j < active.size; ++j) {
    active.constraint[j] = active.constraint[j + 1];
    active.multiplier[j] = active.multiplier[j + 1];
  }
}

}  // namespace

std::optional<Vec3> nearest_feasible_point(const Vec3& target, const HalfSpaces& constraints) {
  constexpr double kDependent = 1e-9;  // of the squared length of a normal that leaves the span of the active ones
  Vec3 x = target;
  ActiveSet active;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const std::ptrdiff_t entering = most_violated(x, constraints);
    if (entering < 0) return x;
    const HalfSpace constraint = constraints[static_cast<std::size_t>(entering)];
    double multiplier = 0;
    while (true) {
      std::array<double, 3> r{};
      if (!express(active, constraints, constraint.normal, r)) return std::nullopt;
      Vec3 direction = constraint.normal;
      for (int i = 0; i < active.size; ++i) direction = direction + constraints[active.constraint[i]].normal * -r[i];
      int blocking = -1;
      double dual_step = INFINITY;
      for (int i = 0; i < active.size; ++i)
        if (r[i] > 0 && active.multiplier[i] / r[i] < dual_step) dual_step = active.multiplier[i] / r[i], blocking = i;
      const double slope = dot(direction, constraint.normal);
      const bool moves = active.size < 3 && slope > kDependent * squared_norm(constraint.normal);
      const double primal_step = moves ? (constraint.offset - dot(constraint.normal, x)) / slope : INFINITY;
      const double step = std::min(dual_step, primal_step);
      if (step == INFINITY) return std::nullopt;  // infeasible
      if (moves) x += direction * step;
      for (int i = 0; i < active.size; ++i) active.multiplier[i] -= step * r[i];
      multiplier += step;
      if (primal_step <= dual_step) break;
      drop(active, blocking);
    }
    active.constraint[active.size] = static_cast<std::size_t>(entering);
    active.multiplier[active.size] = multiplier;
    ++active.size;
  }
  return std::nullopt;
}

std::optional<Vec3> optimum_or_nearest(const Vec3& objective, const HalfSpaces& constraints, double reach) {
  const auto is_within = [reach](const Vec3& p) {
    return std::abs(p.x) <= reach && std::abs(p.y) <= reach && std::abs(p.z) <= reach;
  };
  const LinearProgramResult best = solve_linear_program(objective, constraints);
  if (best.status == LinearProgramStatus::Infeasible) return std::nullopt;
  if (best.status == LinearProgramStatus::Optimal && is_within(best.x)) return best.x;
  const auto nearest = nearest_feasible_point({}, constraints);
  return nearest && is_within(*nearest) ? nearest : std::nullopt;
}

}  // namespace prohull
