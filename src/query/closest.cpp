#include "query/closest.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/closest_point.h"
#include "query/line.h"

namespace prohull {
namespace {

using line_filter::largest_entry;

/// A face seen from a point, at a scale at which products of four lengths neither overflow nor underflow to what
/// matters. Powers of 2 scale without rounding.
struct SeenFace {
  static constexpr double kLeastReach = 0x1p-200, kMostReach = 0x1p200;

  SeenFace(const Vec3& p, const Triangle& t) {
    see(p, t, 1, 1);
    if (reach == 0 || (reach > kLeastReach && reach < kMostReach)) return;
    // Differences overflow, and are quartered before, only where nothing near the least numbers matters.
    see(p, t, reach < 0x1p1000 ? 1 : 0.25, std::ldexp(1, std::clamp(-std::ilogb(reach), -1000, 1000)));
  }

  /// From corner i to corner j.
  const Vec3& side(int i, int j) const { return sides[static_cast<std::size_t>(i + j - 1)]; }

  std::array<Vec3, 3> away;   ///< the point - corner i
  std::array<Vec3, 3> sides;  ///< from a to b, from a to c, from b to c
  double reach;               ///< largest entry of `away`
  double scale;

 private:
  void see(const Vec3& p, const Triangle& t, double before, double after) {
    const Vec3 q = p * before, a = t.a * before, b = t.b * before, c = t.c * before;
    away = {(q - a) * after, (q - b) * after, (q - c) * after};
    sides = {(b - a) * after, (c - a) * after, (c - b) * after};
    reach = std::max({largest_entry(away[0]), largest_entry(away[1]), largest_entry(away[2])});
    scale = before * after;
  }
};

/// No point of the box around the face is nearer than this. The sum has a relative error of 5 eps, and underflow makes
/// it at most 2^-1070 too great.
double distance_of_box(const SeenFace& seen) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = seen.away[0][axis], b = seen.away[1][axis], c = seen.away[2][axis];
    const double gap = std::max({std::min({a, b, c}), -std::max({a, b, c}), 0.0});
    sum += gap * gap;
  }
  return std::max(std::sqrt(sum) * (1 - 8 * line_filter::kEpsilon) - 0x1p-500, 0.0);
}

/// How far the plane of normal n at the nearest corner is, on the side of n: no point of the face is nearer than that,
/// whatever n is.
double separation(const Vec3& n, const SeenFace& seen) {
  const double length = norm(n);
  if (!(length > 0x1p-500)) return 0;
  return std::min({dot(n, seen.away[0]), dot(n, seen.away[1]), dot(n, seen.away[2])}) / length;
}

/// Of distances and separations, with R the reach and eps = 2^-53.
///
/// Let W be the greatest distance of a corner: W <= sqrt(3) R, and a side of the face is at most 2 W long.
/// distance: the foot is from + v (to - from) [+ w (third - from)], a point of the face, but for 1 - v, which is
/// rounded and moves it by 2 eps W. Rounding moves point - from by eps W, a side by 2 eps W, its product with a
/// fraction by 2 eps W, each of two differences by eps W. That is 13 eps W, and norm() adds 3 eps W: 16 eps W < 28 eps
/// R. separation: n is taken as it is. Rounding moves dot(n, point - corner) by at most 4 eps |n| W, and |n| and the
/// quotient by a relative 4 eps: 8 eps W < 14 eps R.
double error_bound(const SeenFace& seen) { return 32 * line_filter::kEpsilon * seen.reach; }

/// Scaled; the foot is seen from its corner `from`.
struct Measured {
  Vec3 from_corner;
  double distance, lower, upper;
};

/// `away` may vanish by underflow where the point is not at the corner.
Measured measured_to_corner(const SeenFace& seen, const Vec3& away, bool is_there) {
  if (is_there) return {};
  // Of the distance only the difference and norm() are rounded; 2^-500 stands for squares that underflow, 2^-1072 for
  // differences.
  const double distance = norm(away), upper = std::min(distance * (1 + 16 * line_filter::kEpsilon) + 0x1p-500,
                                                       2 * largest_entry(away) + 0x1p-1072);
  return {{}, std::min(distance, upper), separation(away, seen) - error_bound(seen), upper};
}

Measured measured_inside(const SeenFace& seen, const Foot& foot) {
  const bool on_edge = foot.on == Foot::On::Edge;
  const Vec3& side = on_edge ? seen.side(foot.from, foot.to) : seen.sides[0];
  Vec3 from_corner = side * foot.v;
  if (!on_edge) from_corner += seen.sides[1] * foot.w;
  const Vec3 away = seen.away[static_cast<std::size_t>(foot.from)] - from_corner;
  // Of a point close to the face the rounding of `away` shows: in a plane it does not, and along an edge it can be
  // taken out.
  Vec3 n = away;
  if (const double length = squared_norm(side); on_edge && length > 0) n = n - side * (dot(n, side) / length);
  const Vec3 normal = cross(seen.sides[0], seen.sides[1]);
  const double apart = std::max({separation(n, seen), separation(normal, seen), separation(-normal, seen)});
  const double distance = norm(away), error = error_bound(seen);
  return {from_corner, distance, apart - error, distance + error};
}

const Vec3& corner(const Triangle& t, int i) { return i == 0 ? t.a : i == 1 ? t.b : t.c; }

}  // namespace

std::optional<ClosestPoint> distance_to(FaceId face, const Triangle& triangle, const Vec3& point, double limit) {
  const SeenFace seen(point, triangle);
  const double box_distance = distance_of_box(seen);
  if (box_distance > limit * seen.scale) return std::nullopt;
  const Foot foot = foot_on_triangle(seen.away[0], seen.away[1], seen.away[2], seen.sides[0], seen.sides[1]);
  const Vec3& from = corner(triangle, foot.from);
  Measured m = foot.on == Foot::On::Corner
                   ? measured_to_corner(seen, seen.away[static_cast<std::size_t>(foot.from)], from == point)
                   : measured_inside(seen, foot);
  m.lower = std::min(std::max(m.lower, box_distance), m.distance);
  if (seen.scale != 1) {  // beyond the normal numbers scaling does round
    constexpr auto kLeast = std::numeric_limits<double>::min(), kMost = std::numeric_limits<double>::max();
    m.lower = m.lower / seen.scale < kLeast ? 0 : std::min(m.lower / seen.scale, kMost);
    m.upper = m.upper == 0 ? 0 : m.upper / seen.scale + std::numeric_limits<double>::denorm_min();
    m.distance = m.distance / seen.scale;
    m.from_corner = m.from_corner / seen.scale;
  }
  return ClosestPoint{face, from + m.from_corner, m.distance, m.lower, m.upper};
}

void ClosestCollector::offer(FaceId face, const Triangle& triangle) {
  const auto found = distance_to(face, triangle, point_, limit_);
  if (!found) return;
  lower_ = std::min(lower_, found->lower);
  if (found->upper > limit_ || (best_ && found->upper == limit_ && best_->face < face)) return;
  best_ = found;
  limit_ = found->upper;
}

void ClosestCollector::offer_all() {
  for (const FaceId f : mesh_.triangles.ids()) offer(f, mesh_.triangle(f));
}

std::optional<ClosestPoint> ClosestCollector::best() const {
  if (!best_) return std::nullopt;
  ClosestPoint best = *best_;
  best.lower = std::min(lower_, best.distance);
  return best;
}

}  // namespace prohull
