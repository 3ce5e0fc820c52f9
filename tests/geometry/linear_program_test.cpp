#include "geometry/linear_program.h"

#include <glpk.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <random>

#include "construct/shape_guards.h"
#include "construct/star.h"
#include "effort.h"
#include "prohull/sample.h"
#include "random.h"

namespace prohull {
namespace {

using Status = LinearProgramStatus;

struct Program {
  Vec3 objective;
  std::vector<HalfSpace> constraints;

  HalfSpaces half_spaces() const {
    HalfSpaces all;
    for (const HalfSpace& one : constraints) all.push_back(one);
    return all;
  }
};

double value(const Program& program, const Vec3& x) { return dot(program.objective, x); }

enum class Within { Box, Space };

/// The least value by GLPK in rational arithmetic, minus infinity if unbounded, nothing if infeasible. Constraints are
/// relaxed by `slack` (tightened if it is negative). GLPK takes numbers for the simplest fractions within 1e-9 of them:
/// all are made integers, by a power of two.
std::optional<double> exact_value(const Program& program, Within within, double slack) {
  constexpr double kUnit = 0x1p200;
  glp_term_out(GLP_OFF);
  const std::unique_ptr<glp_prob, decltype(&glp_delete_prob)> lp(glp_create_prob(), &glp_delete_prob);
  glp_set_obj_dir(lp.get(), GLP_MIN);
  glp_add_cols(lp.get(), 3);
  for (int i = 0; i < 3; ++i) {
    glp_set_col_bnds(lp.get(), i + 1, within == Within::Box ? GLP_DB : GLP_FR, -kFarAway, kFarAway);
    glp_set_obj_coef(lp.get(), i + 1, kUnit * program.objective[i]);
  }
  if (!program.constraints.empty()) glp_add_rows(lp.get(), static_cast<int>(program.constraints.size()));
  for (std::size_t i = 0; i < program.constraints.size(); ++i) {
    const auto& [normal, offset] = program.constraints[i];
    const std::array<int, 4> columns{0, 1, 2, 3};
    const std::array<double, 4> values{0, kUnit * normal.x, kUnit * normal.y, kUnit * normal.z};
    glp_set_row_bnds(lp.get(), static_cast<int>(i) + 1, GLP_LO, kUnit * (offset - slack), 0);
    glp_set_mat_row(lp.get(), static_cast<int>(i) + 1, 3, columns.data(), values.data());
  }
  glp_smcp parameters;
  glp_init_smcp(&parameters);
  parameters.msg_lev = GLP_MSG_OFF;
  glp_std_basis(lp.get());
  EXPECT_EQ(glp_exact(lp.get(), &parameters), 0);
  if (glp_get_status(lp.get()) == GLP_UNBND) return -std::numeric_limits<double>::infinity();
  if (glp_get_status(lp.get()) != GLP_OPT) return std::nullopt;
  return glp_get_obj_val(lp.get()) / kUnit;
}

double worst_violation(const Program& program, const Vec3& x) {
  double worst = 0;
  for (const auto& [normal, offset] : program.constraints) worst = std::max(worst, offset - dot(normal, x));
  return worst;
}

double reach(const Vec3& x) { return std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}); }

auto tight_constraints(const Program& program, const Vec3& x) {
  return std::ranges::count_if(program.constraints,
                               [&](const HalfSpace& h) { return std::abs(dot(h.normal, x) - h.offset) < 1e-9; });
}

// The solver stops at violations of 1e-12, as it computes them; we compute them a little differently.
constexpr double kViolation = 4e-12;
// Beside that, rounding in a basis of up to three nearly dependent normals.
constexpr double kRounding = 1e-9;

/// The answer must be that of a program whose constraints are moved by no more than the tolerance: the exact values of
/// the relaxed and of the tightened program bracket it. Returns the status for counting.
Status check(const Program& program) {
  const auto [status, x] = solve_linear_program(program.objective, program.half_spaces());
  const auto tightened = exact_value(program, Within::Box, -kViolation);
  if (status == Status::Infeasible) {
    EXPECT_FALSE(tightened) << "a solution with room to spare was missed";
    return status;
  }
  EXPECT_LE(worst_violation(program, x), kViolation);
  const double found = value(program, x), rounding = kRounding * (1 + std::abs(found));
  if (tightened) {
    EXPECT_LE(found, *tightened + rounding);
  }
  if (status == Status::Optimal) {
    EXPECT_LE(reach(x), kFarAway);
    EXPECT_GE(tight_constraints(program, x), 3);
    const auto relaxed = exact_value(program, Within::Space, kViolation);
    EXPECT_TRUE(relaxed) << "there is no solution";
    if (relaxed) {
      EXPECT_GE(found, *relaxed - rounding);
    }
  } else {
    // x satisfies the constraints, and no point in the box is better: were there a single best one inside, it would be
    // x.
    EXPECT_GE(reach(x), kFarAway - kRounding);
  }
  return status;
}

class RandomPrograms {
 public:
  explicit RandomPrograms(unsigned seed) : random_(seed) {}

  double unit() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  int up_to(int most) { return std::uniform_int_distribution<int>(0, most)(random_); }
  Vec3 vector() { return {unit(), unit(), unit()}; }
  Vec3 direction() {
    while (true)
      if (const Vec3 v = vector(); norm(v) > 0.1 && norm(v) <= 1) return v / norm(v);
  }

  /// As of a star: normals within some angle of `axis`, planes near the origin.
  Program around(const Vec3& axis, double spread, int count) {
    Program program;
    for (int i = 0; i < count; ++i) add(program, axis + vector() * spread, 0.3 * unit());
    return program;
  }

  void add(Program& program, const Vec3& normal, double offset) {
    const Vec3 n = normal / norm(normal);
    program.constraints.push_back({n, offset});
    program.objective += n * (0.5 + 0.5 * unit());
  }

 private:
  std::mt19937 random_;
};

struct Counts {
  int optimal = 0, infeasible = 0, ambiguous = 0;
  void count(Status status) {
    ++(status == Status::Optimal ? optimal : status == Status::Infeasible ? infeasible : ambiguous);
  }
};

template <class Make>
Counts check_many(int count, Make&& make) {
  RandomPrograms random(test_seed());
  Counts counts;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) counts.count(check(make(random)));
  return counts;
}

TEST(LinearProgram, AgreesWithAnExactSolverOnStars) {
  const Counts counts =
      check_many(rounds(2000), [](RandomPrograms& r) { return r.around(r.direction(), 0.9, 5 + r.up_to(15)); });
  EXPECT_GT(counts.optimal, rounds(1000));
}

TEST(LinearProgram, AgreesOnConstraintsFromAllSides) {
  const Counts counts = check_many(rounds(2000), [](RandomPrograms& r) { return r.around({}, 1, 4 + r.up_to(10)); });
  EXPECT_GT(counts.infeasible, rounds(100));
  EXPECT_GT(counts.optimal, rounds(100));
}

TEST(LinearProgram, AgreesOnObjectivesThatAreNotInTheConeOfTheNormals) {
  const Counts counts = check_many(rounds(1000), [](RandomPrograms& r) {
    Program program = r.around(r.direction(), 0.7, 3 + r.up_to(8));
    program.objective = r.direction();
    return program;
  });
  EXPECT_GT(counts.ambiguous, rounds(200)) << "most of them run away to the box";
}

TEST(LinearProgram, AgreesOnParallelAndRedundantConstraints) {
  const Counts counts = check_many(rounds(1000), [](RandomPrograms& r) {
    Program program = r.around(r.direction(), 0.8, 4 + r.up_to(4));
    for (std::size_t i = 0, n = program.constraints.size(); i < n; ++i) {
      const auto [normal, offset] = program.constraints[i];
      for (int copies = r.up_to(2); copies > 0; --copies) r.add(program, normal, offset - 0.25 * r.up_to(2));
    }
    if (r.up_to(9) == 0) r.add(program, -program.constraints[0].normal, 0.25 * r.unit());
    return program;
  });
  EXPECT_GT(counts.optimal, rounds(500));
}

TEST(LinearProgram, AgreesWhereManyPlanesMeetInOnePoint) {
  const Counts counts = check_many(rounds(1000), [](RandomPrograms& r) {
    Program program = r.around(r.direction(), 0.8, 6 + r.up_to(10));
    const Vec3 apex = r.vector();
    for (auto& [normal, offset] : program.constraints) offset = dot(normal, apex);
    return program;
  });
  EXPECT_GT(counts.optimal, rounds(800));
  EXPECT_EQ(counts.infeasible, 0);
}

// Coordinates on a coarse grid: exact ties everywhere.
TEST(LinearProgram, AgreesOnTies) {
  const Counts counts = check_many(rounds(2000), [](RandomPrograms& r) {
    Program program;
    const auto grid = [&] { return r.up_to(4) - 2.0; };
    for (int i = 4 + r.up_to(8); i > 0; --i) {
      const Vec3 normal{grid(), grid(), grid()};
      if (normal == Vec3{}) continue;
      program.constraints.push_back({normal / 4, 0.5 * grid() - 1});
      program.objective += normal;
    }
    return program;
  });
  EXPECT_GT(counts.optimal, rounds(300));
}

TEST(LinearProgram, IsAmbiguousWhereAllNormalsLieInOnePlane) {
  const Counts counts = check_many(rounds(1000), [](RandomPrograms& r) {
    Program program;
    const int axis = r.up_to(2);
    const Vec3 main = r.direction();
    for (int i = 3 + r.up_to(6); i > 0; --i) {
      Vec3 normal = main + r.vector() * 0.5;
      normal[axis] = 0;
      if (norm(normal) > 0.1) r.add(program, normal, 0.3 * r.unit());
    }
    return program;
  });
  EXPECT_EQ(counts.optimal, 0);
  EXPECT_GT(counts.ambiguous, rounds(500));
}

TEST(LinearProgram, AgreesOnNearlyParallelNormals) {
  for (const double spread : {1e-2, 1e-4, 1e-6, 1e-9, 1e-12})
    check_many(rounds(400), [&](RandomPrograms& r) {
      SCOPED_TRACE(spread);
      Program program;
      const Vec3 axis = r.direction(), near = r.vector();
      for (int i = 4 + r.up_to(10); i > 0; --i) {
        const Vec3 normal = axis + r.vector() * spread;
        r.add(program, normal, dot(normal, near) / norm(normal) + 0.1 * spread * r.unit());
      }
      return program;
    });
}

TEST(LinearProgram, KnownAnswers) {
  const HalfSpaces octant{{{1, 0, 0}, 1}, {{0, 1, 0}, 2}, {{0, 0, 1}, 3}};
  const auto corner = solve_linear_program({1, 1, 1}, octant);
  EXPECT_EQ(corner.status, Status::Optimal);
  EXPECT_EQ(corner.x, (Vec3{1, 2, 3}));
  EXPECT_EQ(solve_linear_program({1, 1, 1}, {}).status, Status::Ambiguous);
  EXPECT_EQ(solve_linear_program({1, 0, 0}, {octant[0]}).status, Status::Ambiguous);
  auto gap = octant;
  gap.push_back({{-1, 0, 0}, -0.5});
  EXPECT_EQ(solve_linear_program({1, 1, 1}, gap).status, Status::Infeasible) << "1 <= x <= 0.5";
  auto far = octant;
  far.push_back({{1, 0, 0}, 2 * kFarAway});
  EXPECT_EQ(solve_linear_program({1, 1, 1}, far).status, Status::Ambiguous) << "out of reach";
}

/// The program of P&T 3.1.2 for the edge's star, as the construction sets it up.
Program program_of(const Star& star) {
  Program program;
  for (std::size_t i = 0; i < star.planes.size(); ++i) {
    if (star.double_areas[i] == 0) continue;
    program.constraints.push_back({star.planes[i].normal, star.planes[i].offset + 1e-10});
    program.objective += star.planes[i].normal * star.double_areas[i];
  }
  return program;
}

void check_recorded(std::string_view sample, std::size_t faces) {
  SCOPED_TRACE(sample);
  HalfEdgeMesh mesh(make_sample(sample, faces));
  std::mt19937 random(test_seed());
  Star star;
  Counts counts;
  int collapses = 0;
  for (int i = 0; i < rounds(1500) && !testing::Test::HasFailure(); ++i) {
    const EdgeId edge{
        std::uniform_int_distribution<std::uint32_t>(0, static_cast<std::uint32_t>(mesh.edge_id_count()) - 1)(random)};
    if (!mesh.has(edge)) continue;
    gather_star(mesh, edge, star);
    if (!satisfies_link_condition(star) || star.valence() > 12) continue;
    measure_star(mesh, star);
    const Program program = program_of(star);
    counts.count(check(program));
    const auto best = solve_linear_program(program.objective, program.half_spaces());
    if (best.status == Status::Optimal && !refused_shape(star, best.x, {})) {
      mesh.collapse(star.edge, star.to_input(best.x));
      ++collapses;
    }
  }
  EXPECT_GT(counts.optimal, 0);
  EXPECT_GT(collapses, 0) << "none was taken from a hull";
}

TEST(LinearProgram, AgreesOnStarsOfHullsUnderConstruction) {
  check_recorded("asteroid", 2000);
  check_recorded("bracket", 2000);
  check_recorded("pony", 2000);
}

/// The nearest feasible point by trying every set of up to three tight constraints; nothing if there is none.
std::optional<Vec3> nearest_by_trying_all(const Vec3& target, const Program& program) {
  constexpr double kIndependent = 1e-6, kFeasible = 1e-9;
  const auto& all = program.constraints;
  std::optional<Vec3> best;
  const auto offer = [&](const Vec3& x) {
    if (worst_violation(program, x) < kFeasible && (!best || norm(x - target) < norm(*best - target))) best = x;
  };
  const auto slack = [&](const HalfSpace& h) { return h.offset - dot(h.normal, target); };
  offer(target);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Vec3& a = all[i].normal;
    offer(target + a * (slack(all[i]) / squared_norm(a)));
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 &b = all[j].normal, ab = cross(a, b);
      if (norm(ab) < kIndependent) continue;
      offer(target + (cross(b, ab) * slack(all[i]) + cross(ab, a) * slack(all[j])) / squared_norm(ab));
      for (std::size_t k = 0; k < j; ++k) {
        const Vec3& c = all[k].normal;
        const double det = dot(ab, c);
        if (std::abs(det) < kIndependent) continue;
        offer(target + (cross(b, c) * slack(all[i]) + cross(c, a) * slack(all[j]) + ab * slack(all[k])) / det);
      }
    }
  }
  return best;
}

template <class Make>
void check_nearest(int count, int least_found, Make&& make) {
  RandomPrograms random(test_seed());
  int found = 0;
  for (int i = 0; i < count; ++i) {
    const Program program = make(random);
    const Vec3 target = random.vector();
    const auto truth = nearest_by_trying_all(target, program),
               x = nearest_feasible_point(target, program.half_spaces());
    if (!x) {
      ASSERT_FALSE(exact_value(program, Within::Box, -1e-9)) << "program " << i;
      continue;
    }
    ASSERT_TRUE(truth) << "program " << i;
    if (reach(*truth) > kFarAway) continue;  // rounding grows with the distance
    ++found;
    ASSERT_LE(worst_violation(program, *x), kViolation) << "program " << i;
    ASSERT_NEAR(norm(*x - target), norm(*truth - target), 1e-8 * (1 + norm(*truth))) << "program " << i;
  }
  EXPECT_GE(found, least_found);
}

TEST(NearestFeasiblePoint, IsTheNearestOfAllSetsOfTightConstraints) {
  check_nearest(rounds(3000), rounds(1500),
                [](RandomPrograms& r) { return r.around(r.direction(), 0.9, 3 + r.up_to(9)); });
  check_nearest(rounds(3000), rounds(300), [](RandomPrograms& r) { return r.around({}, 1, 3 + r.up_to(6)); });
}

TEST(NearestFeasiblePoint, OfFlatStarsAndCreases) {
  check_nearest(rounds(2000), rounds(1500), [](RandomPrograms& r) {
    Program program;
    const std::array<Vec3, 2> normals{r.direction(), r.direction()};
    const std::array<double, 2> offsets{r.unit(), r.unit()};
    for (int i = 4 + r.up_to(6), sides = r.up_to(1); i > 0; --i) {
      const int plane = sides == 0 ? 0 : r.up_to(1);
      if (norm(cross(normals[0], normals[1])) < 0.1 && plane == 1) continue;
      r.add(program, normals[plane], offsets[plane]);
    }
    return program;
  });
}

TEST(NearestFeasiblePoint, IsTheTargetWhereThatIsFeasible) {
  EXPECT_EQ(nearest_feasible_point({1, 2, 3}, {}), (Vec3{1, 2, 3}));
  EXPECT_EQ(nearest_feasible_point({1, 2, 3}, {{{0, 0, 1}, 3}}), (Vec3{1, 2, 3}));
  EXPECT_EQ(nearest_feasible_point({1, 2, 3}, {{{0, 0, 1}, 4}}), (Vec3{1, 2, 4}));
  EXPECT_EQ(nearest_feasible_point({}, {{{0, 0, 1}, 1}, {{0, 0, -1}, 1}}), std::nullopt) << "z >= 1 and z <= -1";
}

}  // namespace
}  // namespace prohull
