#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cover/extreme_points.h"
#include "cover/farthest.h"
#include "cover/primitives.h"

namespace prohull::cover {
namespace {

/// The least ball with these points on its surface, at most 4; nothing if they do not have one.
std::optional<Ball> ball_through(std::span<const Vec3> points) {
  // The centre is points[0] + sum_i t_i e_i with 2 e_i . (centre - points[0]) = e_i . e_i.
  const std::size_t n = points.size() - 1;
  double m[3][4];
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 e = points[i + 1] - points[0];
    for (std::size_t j = 0; j < n; ++j) m[i][j] = 2 * dot(e, points[j + 1] - points[0]);
    m[i][n] = dot(e, e);
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(m[i][k]) > std::abs(m[best][k])) best = i;
    if (!(std::abs(m[best][k]) > 1e-14)) return std::nullopt;
    for (std::size_t j = 0; j <= n; ++j) std::swap(m[k][j], m[best][j]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j <= n; ++j) m[i][j] -= factor * m[k][j];
    }
  }
  Vec3 offset;
  for (std::size_t i = 0; i < n; ++i) offset += (points[i + 1] - points[0]) * (m[i][n] / m[i][i]);
  return Ball{points[0] + offset, norm(offset)};
}

bool holds(const Ball& ball, std::span<const Vec3> points) {
  return std::ranges::all_of(points, [&](const Vec3& p) { return norm(p - ball.center) <= ball.radius + 1e-12; });
}

/// Of the balls through up to 4 of at most 5 points, the least that holds all. Reduces the points to those on it.
std::optional<Ball> least_ball(std::vector<Vec3>& points) {
  std::optional<Ball> best;
  std::vector<Vec3> on_best;
  for (unsigned subset = 1; subset < 1U << points.size(); ++subset) {
    if (std::popcount(subset) > 4) continue;
    std::vector<Vec3> some;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (subset >> i & 1) some.push_back(points[i]);
    const auto ball = ball_through(some);
    if (ball && (!best || ball->radius < best->radius) && holds(*ball, points)) best = ball, on_best = std::move(some);
  }
  points = std::move(on_best);
  return best;
}

/// Adds the farthest point to those on the ball, again and again, as the simplex method does (Gaertner 1999).
Vec3 center_of_least_ball(const std::vector<Vec3>& points) {
  std::vector<Vec3> support{points[0]};
  Ball ball{points[0], 0};
  constexpr int kMaxRounds = 200;
  for (int round = 0; round < kMaxRounds; ++round) {
    const Vec3 far =
        *std::ranges::max_element(points, {}, [&](const Vec3& p) { return squared_norm(p - ball.center); });
    if (norm(far - ball.center) <= ball.radius * (1 + 1e-12)) break;
    support.push_back(far);
    const auto next = least_ball(support);
    if (!next || !(next->radius > ball.radius)) break;  // rounding
    ball = *next;
  }
  return ball.center;
}

}  // namespace

Ball ball_around(const TriangleMesh& mesh) {
  const ExtremePoints extreme(mesh);
  const std::vector<Vec3> points(extreme.hull.positions.begin(), extreme.hull.positions.end());
  Vec3 center = center_of_least_ball(points);
  if (!(farthest(center, points) < farthest({}, points))) center = {};
  const Vec3 in_world = extreme.to_world(center);
  return {in_world, extreme.radius_around(in_world, in_world)};
}

}  // namespace prohull::cover
