#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "prohull/union_verification.h"
#include "verify/exposed_surface.h"

namespace prohull {
namespace {

struct Disk {
  double x, y, radius;
};

/// A part of a circle, by angles from 0 to 2 pi.
using Arc = std::pair<double, double>;

constexpr double kFullTurn = 2 * std::numbers::pi;

/// Adds the part of the circle around `disk` that lies in `other`; false if that is all of it.
bool add_covered_arc(const Disk& disk, const Disk& other, bool comes_first, std::vector<Arc>& covered) {
  const double x = other.x - disk.x, y = other.y - disk.y, reach = disk.radius + other.radius;
  if (std::abs(x) >= reach || std::abs(y) >= reach) return true;  // most pairs
  const double distance = std::hypot(x, y);
  if (distance >= reach) return true;
  if (distance <= std::abs(other.radius - disk.radius))  // of equal ones the first has the circle
    return other.radius < disk.radius || (other.radius == disk.radius && distance == 0 && comes_first);
  const double cosine =
      (distance * distance + disk.radius * disk.radius - other.radius * other.radius) / (2 * distance * disk.radius);
  const double half = std::acos(std::clamp(cosine, -1.0, 1.0));
  double begin = std::atan2(y, x) - half;
  if (begin < 0) begin += kFullTurn;
  const double end = begin + 2 * half;
  covered.emplace_back(begin, std::min(end, kFullTurn));
  if (end > kFullTurn) covered.emplace_back(0, end - kFullTurn);
  return true;
}

/// The integral of (x dy - y dx) / 2 along an arc.
double area_along(const Disk& disk, const Arc& arc) {
  const auto [from, to] = arc;
  return disk.radius / 2 *
         (disk.radius * (to - from) + disk.x * (std::sin(to) - std::sin(from)) -
          disk.y * (std::cos(to) - std::cos(from)));
}

/// Green's theorem along the arcs that lie in no other disk.
double union_area(const std::vector<Disk>& disks) {
  double area = 0;
  std::vector<Arc> covered;
  for (const Disk& disk : disks) {
    covered.clear();
    const bool is_exposed = std::ranges::all_of(disks, [&](const Disk& other) {
      return &other == &disk || add_covered_arc(disk, other, &disk < &other, covered);
    });
    if (!is_exposed) continue;
    covered.emplace_back(kFullTurn, kFullTurn);
    std::ranges::sort(covered);
    double reached = 0;
    for (const auto& [from, to] : covered) {
      if (from > reached) area += area_along(disk, {reached, from});
      reached = std::max(reached, to);
    }
  }
  return area;
}

/// Integrates the areas of cuts along z by Simpson's rule, with smaller steps where they change the sum.
class BallVolume {
 public:
  explicit BallVolume(std::span<const Ball> balls) : balls_(balls) {
    for (const Ball& ball : balls)
      for (const double sign : {-1.0, 1.0})
        box_.extend(ball.center + sign * Vec3{ball.radius, ball.radius, ball.radius});
  }

  double value() {
    constexpr int kPanels = 32;
    std::vector<Cut> cuts;
    for (int i = 0; i <= 2 * kPanels; ++i)
      cuts.push_back(cut_at(box_.min.z + (box_.max.z - box_.min.z) * (i / (2.0 * kPanels))));
    double rough = 0;
    for (int i = 0; i < kPanels; ++i) rough += simpson(cuts[2 * i], cuts[2 * i + 1], cuts[2 * i + 2]);
    double sum = 0;
    for (int i = 0; i < kPanels; ++i)
      sum += integral(cuts[2 * i], cuts[2 * i + 1], cuts[2 * i + 2], kAccuracy * rough / kPanels, kDepth);
    return sum;
  }

 private:
  static constexpr double kAccuracy = 1e-6;
  static constexpr int kDepth = 20;

  struct Cut {
    double z, area;
  };

  Cut cut_at(double z) const {
    std::vector<Disk> disks;
    const Vec3 center = box_.center();
    for (const Ball& ball : balls_) {
      const double height = z - ball.center.z, square = ball.radius * ball.radius - height * height;
      if (square > 0) disks.push_back({ball.center.x - center.x, ball.center.y - center.y, std::sqrt(square)});
    }
    return {z, union_area(disks)};
  }

  static double simpson(const Cut& a, const Cut& middle, const Cut& b) {
    return (b.z - a.z) / 6 * (a.area + 4 * middle.area + b.area);
  }

  double integral(const Cut& a, const Cut& middle, const Cut& b, double error, int depth) const {
    const Cut left = cut_at(a.z * 0.5 + middle.z * 0.5), right = cut_at(middle.z * 0.5 + b.z * 0.5);
    const double rough = simpson(a, middle, b), fine = simpson(a, left, middle) + simpson(middle, right, b);
    if (depth == 0 || std::abs(fine - rough) <= error) return fine;
    return integral(a, left, middle, error / 2, depth - 1) + integral(middle, right, b, error / 2, depth - 1);
  }

  std::span<const Ball> balls_;
  Box box_;
};

}  // namespace

double union_volume(std::span<const TriangleMesh> pieces) {
  return pieces.empty() ? 0 : verify::exposed_volume(pieces);
}

double union_volume(std::span<const Ball> balls) { return balls.empty() ? 0 : BallVolume(balls).value(); }

}  // namespace prohull
