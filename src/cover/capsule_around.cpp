#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "cover/extreme_points.h"
#include "cover/primitives.h"

namespace prohull::cover {
namespace {

/// Along an axis through `center`, as short as the radius allows.
Capsule capsule_along(const Vec3& center, const Vec3& axis, const std::vector<Vec3>& points) {
  double radius = 0;
  for (const Vec3& p : points) radius = std::max(radius, norm(p - center - axis * dot(p - center, axis)));
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : points) {
    const double height = dot(p - center, axis), off = norm(p - center - axis * height);
    const double cap = std::sqrt(std::max(0.0, radius * radius - off * off));
    low = std::min(low, height + cap), high = std::max(high, height - cap);
  }
  if (low > high) low = high = (low + high) / 2;
  return {center + axis * low, center + axis * high, radius};
}

/// Moves the ends of a capsule in random directions as long as it becomes smaller.
class CapsuleSearch {
 public:
  explicit CapsuleSearch(std::vector<Vec3> points) : points_(std::move(points)) {}

  Capsule improved(const Capsule& start) {
    std::minstd_rand random(1);
    const auto next = [&] {
      return static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max()) - 0.5;
    };
    Capsule best = start;
    constexpr double kFirstStep = 0.2, kLeastStep = 1e-4, kShrink = 0.8;
    constexpr int kFailures = 60;
    int failures = 0;
    for (double step = kFirstStep; step > kLeastStep;) {
      const Vec3 da{next(), next(), next()}, db{next(), next(), next()};
      const bool is_better = try_move(best, da * step, db * step) || try_move(best, da * -step, db * -step);
      failures = is_better ? 0 : failures + 1;
      if (failures < kFailures) continue;
      const Capsule shortened = along_axis_of(best);
      if (volume(shortened) < volume(best)) best = shortened;
      step *= kShrink;
      failures = 0;
    }
    return best;
  }

 private:
  /// Random moves hardly ever shorten it without turning it.
  Capsule along_axis_of(const Capsule& capsule) const {
    const Vec3 ab = capsule.b - capsule.a;
    const double length = norm(ab);
    return length > 0 ? capsule_along(capsule.a, ab / length, points_) : capsule;
  }

  /// Whether the capsule is smaller there; then it moves. The point that says no comes to the front, because it is
  /// likely to say no again: most trials end with the first points.
  bool try_move(Capsule& capsule, const Vec3& da, const Vec3& db) {
    const double least = volume(capsule);
    Capsule moved{capsule.a + da, capsule.b + db, 0};
    const Vec3 ab = moved.b - moved.a;
    const double squared_length = squared_norm(ab);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double d = distance_to_segment(points_[i] - moved.a, ab, squared_length);
      if (d <= moved.radius) continue;
      moved.radius = d;
      if (volume(moved) < least) continue;
      std::swap(points_[i], points_[i / 2]);
      return false;
    }
    if (!(volume(moved) < least)) return false;
    capsule = moved;
    return true;
  }

  std::vector<Vec3> points_;
};

}  // namespace

Capsule capsule_around(const TriangleMesh& mesh) {
  const ExtremePoints extreme(mesh);
  const std::vector<Vec3> points(extreme.hull.positions.begin(), extreme.hull.positions.end());
  const OrientedBox box = box_around(extreme.hull);
  const Ball ball = ball_around(extreme.hull);
  Capsule best{ball.center, ball.center, ball.radius};
  CapsuleSearch search(points);
  for (const Vec3& axis : box.axes) {
    const Capsule found = search.improved(capsule_along(box.center, axis, points));
    if (volume(found) < volume(best)) best = found;
  }
  best = search.improved(best);
  const Vec3 a = extreme.to_world(best.a), b = extreme.to_world(best.b);
  return {a, b, extreme.radius_around(a, b)};
}

}  // namespace prohull::cover
