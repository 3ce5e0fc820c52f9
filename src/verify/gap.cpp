#include "verify/gap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/bvh.h"
#include "geometry/triangle_distance.h"
#include "prohull/detail/progress_meter.h"
#include "verify/steps.h"

// A gap is kept if and only if no face of the hull is nearer to a face of the original than that. Boxes and planes rule
// out pairs that are certainly far apart, and are_apart decides the others.

namespace prohull::verify {
namespace {

constexpr double kEpsilon = 0x1p-53;

/// Never greater than the distance, but for rounding by less than 8 eps.
double distance(const Box& a, const Box& b) {
  constexpr double kSmall = 0x1p-500;  // whose squares underflow
  Vec3 d;
  for (int axis = 0; axis < 3; ++axis) d[axis] = std::max({b.min[axis] - a.max[axis], a.min[axis] - b.max[axis], 0.0});
  const double largest = std::max({d.x, d.y, d.z});
  return largest < kSmall ? largest : norm(d);
}

/// How far boxes are at least from a triangle: by its box and by its plane. Proven.
class AtLeast {
 public:
  explicit AtLeast(const Triangle& t)
      : corners_{t.a, t.b, t.c}, box_(box_of(t)), normal_(of_size_one(cross(t.b - t.a, t.c - t.a))) {}

  double operator()(const Box& box) const {
    return std::max(distance(box_, box) * (1 - 16 * kEpsilon), beyond_plane(box));
  }

 private:
  /// Times a power of two, so that its largest entry is in [1, 2), and its square does not underflow; 0 if there is
  /// none.
  static Vec3 of_size_one(const Vec3& n) {
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    if (!(largest > 0 && is_finite(n))) return {};
    const int exponent = -std::ilogb(largest);
    return {std::ldexp(n.x, exponent), std::ldexp(n.y, exponent), std::ldexp(n.z, exponent)};
  }

  // Along any axis, what separates the projections bounds the distance, whatever rounding made of the normal. A sum of
  // three products of a rounded difference has an error of 4 eps of the sum of their sizes, but for those that
  // underflow.
  double beyond_plane(const Box& box) const {
    const double length = norm(normal_);
    if (length == 0) return 0;
    double least = 0, most = 0, size = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double n = normal_[axis], low = box.min[axis] - corners_[0][axis], high = box.max[axis] - corners_[0][axis];
      least += std::min(n * low, n * high);
      most += std::max(n * low, n * high);
      size += std::abs(n) * std::max(std::abs(low), std::abs(high));
    }
    double triangle_least = 0, triangle_most = 0;
    for (const Vec3& p : {corners_[1], corners_[2]}) {
      const Vec3 d = p - corners_[0];
      triangle_least = std::min(triangle_least, dot(normal_, d));
      triangle_most = std::max(triangle_most, dot(normal_, d));
      size += std::abs(normal_.x * d.x) + std::abs(normal_.y * d.y) + std::abs(normal_.z * d.z);
    }
    const double apart = std::max(least - triangle_most, triangle_least - most);
    return (apart - 32 * kEpsilon * size - 0x1p-1000) / length * (1 - 32 * kEpsilon);
  }

  std::array<Vec3, 3> corners_;
  Box box_;
  Vec3 normal_;
};

class GapSearch {
 public:
  GapSearch(const TriangleMesh& original, double gap, Steps& steps)
      : original_(original), gap_(gap), steps_(steps), tree_(original) {}

  /// Throws OutOfSteps.
  bool keeps_gap(const Triangle& face) const {
    const AtLeast at_least(face);
    bool keeps = true;
    const auto may_be_near = [&](const Box& box) {
      if (!keeps) return false;
      steps_.take(1);
      return at_least(box) < gap_;
    };
    tree_.visit(may_be_near,
                [&](std::uint32_t f) { keeps = keeps && are_apart(face, original_.triangle(FaceId{f}), gap_); });
    return keeps;
  }

  struct Found {
    NearFace nearest;
    double proven_distance;  ///< no face of the original is nearer
  };

  /// The face of the original that is nearest, rounded, if it is nearer than `limit`. Throws OutOfSteps.
  Found nearest(FaceId id, const Triangle& face, double limit) const {
    Found found{{id, FaceId{}, {}, limit}, limit};
    tree_.least(
        AtLeast(face),
        [&](std::uint32_t f) {
          steps_.take(1);
          const Triangle t = original_.triangle(FaceId{f});
          const TriangleDistance d = triangle_distance(face, t);
          const double upper = d.lower == 0 && !are_apart(face, t, kTouching) ? 0 : d.upper;
          found.proven_distance = std::min(found.proven_distance, d.lower);
          if (upper < found.nearest.distance) found.nearest = {id, FaceId{f}, d.s, upper};
          return upper;
        },
        limit);
    return found;
  }

 private:
  static constexpr double kTouching = std::numeric_limits<double>::denorm_min();  ///< nearer than this: they meet

  const TriangleMesh& original_;
  const double gap_;
  Steps& steps_;
  const Bvh tree_;
};

}  // namespace

GapReport verify_gap(const TriangleMesh& hull, const TriangleMesh& original, double gap,
                     const EnclosureOptions& options) {
  ProgressCounter counter(options.progress, "verify", hull.face_count());
  Steps steps(counter.meter(), options.max_steps);
  const GapSearch search(original, gap, steps);
  constexpr double kAny = std::numeric_limits<double>::infinity();
  GapReport report;
  report.least_distance = report.proven_distance = kAny;
  bool is_measured = true;
  for (const FaceId f : hull.triangles.ids()) {
    counter.next();
    const Triangle face = hull.triangle(f);
    std::optional<bool> keeps;
    try {
      keeps = search.keeps_gap(face);
      auto [nearest, proven_distance] = search.nearest(f, face, *keeps ? report.least_distance : kAny);
      if (!*keeps) nearest.distance = std::min(nearest.distance, gap);
      report.least_distance = std::min(report.least_distance, nearest.distance);
      report.proven_distance = std::min(report.proven_distance, proven_distance);
      if (!*keeps) report.nearest.push_back(nearest);
    } catch (const OutOfSteps&) {
      is_measured = false;
    }
    report.faces_undecided += keeps ? 0 : 1;
    report.faces_too_near += keeps.value_or(true) ? 0 : 1;
  }
  if (!is_measured) report.least_distance = std::numeric_limits<double>::quiet_NaN(), report.proven_distance = 0;
  if (report.keeps_gap()) report.proven_distance = std::max(report.proven_distance, gap);
  std::ranges::stable_sort(report.nearest, {}, &NearFace::distance);
  report.nearest.resize(std::min(report.nearest.size(), options.max_offenders));
  return report;
}

}  // namespace prohull::verify
