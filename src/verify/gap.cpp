#include "verify/gap.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/bvh.h"
#include "geometry/triangle_distance.h"
#include "geometry/triangle_gap.h"
#include "parallel/progress_meter.h"

// A gap is kept if and only if no face of the hull is nearer to a face of the original than that. Boxes and planes rule
// out pairs that are certainly far apart, and are_apart decides the others.

namespace prohull::verify {
namespace {

constexpr double kEpsilon = 0x1p-53;

/// Rules out boxes that are farther than `gap` from a triangle, most of them, and never one that is nearer.
class MayBeNear {
 public:
  MayBeNear(const Triangle& t, double gap)
      : corners_{t.a, t.b, t.c}, box_(box_of(t)), gap_(gap), normal_(cross(t.b - t.a, t.c - t.a)) {
    if (!std::isfinite(squared_norm(normal_))) normal_ = {};
  }

  bool operator()(const Box& box) const { return squared_gap(box) <= limit() && !is_beyond_plane(box); }

 private:
  // Sums of squares of rounded differences have a relative error of 8 eps, but for those that underflow.
  double limit() const { return gap_ * gap_ * (1 + 32 * kEpsilon) + 0x1p-1000; }

  double squared_gap(const Box& box) const {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double d = std::max({box.min[axis] - box_.max[axis], box_.min[axis] - box.max[axis], 0.0});
      sum += d * d;
    }
    return sum;
  }

  // Along any axis, what separates the projections bounds the distance, whatever rounding made of the normal. A sum of
  // three products of a rounded difference has an error of 4 eps of the sum of their sizes.
  bool is_beyond_plane(const Box& box) const {
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
    return apart - 32 * kEpsilon * size > gap_ * norm(normal_) * (1 + 32 * kEpsilon) + 0x1p-1000;
  }

  std::array<Vec3, 3> corners_;
  Box box_;
  double gap_;
  Vec3 normal_;
};

double distance(const Box& a, const Box& b) {
  Vec3 d;
  for (int axis = 0; axis < 3; ++axis) d[axis] = std::max({b.min[axis] - a.max[axis], a.min[axis] - b.max[axis], 0.0});
  return norm(d);
}

class GapSearch {
 public:
  GapSearch(const TriangleMesh& original, double gap) : original_(original), gap_(gap) {
    std::vector<Box> boxes;
    boxes.reserve(original.face_count());
    for (const FaceId f : original.triangles.ids()) boxes.push_back(box_of(original.triangle(f)));
    tree_ = Bvh(std::move(boxes));
  }

  bool keeps_gap(const Triangle& face) const {
    const MayBeNear may_be_near(face, gap_);
    bool keeps = true;
    tree_.visit([&](const Box& box) { return keeps && may_be_near(box); },
                [&](std::uint32_t f) { keeps = keeps && are_apart(face, original_.triangle(FaceId{f}), gap_); });
    return keeps;
  }

  /// The face of the original that is nearest, rounded, if it is nearer than `limit`.
  NearFace nearest(FaceId id, const Triangle& face, double limit) const {
    NearFace found{id, FaceId{}, {}, limit};
    const Box box = box_of(face);
    tree_.least([&](const Box& other) { return distance(box, other); },
                [&](std::uint32_t f) {
                  const Triangle t = original_.triangle(FaceId{f});
                  const TriangleDistance d = triangle_distance(face, t);
                  const double upper = d.lower == 0 && !are_apart(face, t, kTouching) ? 0 : d.upper;
                  if (upper < found.distance) found = {id, FaceId{f}, d.s, upper};
                  return upper;
                },
                limit);
    return found;
  }

 private:
  static constexpr double kTouching = std::numeric_limits<double>::denorm_min();  ///< nearer than this: they meet

  const TriangleMesh& original_;
  const double gap_;
  Bvh tree_;
};

}  // namespace

GapReport verify_gap(const TriangleMesh& hull, const TriangleMesh& original, double gap,
                     const EnclosureOptions& options) {
  ProgressCounter counter(options.progress, "verify", hull.face_count());
  const GapSearch search(original, gap);
  GapReport report;
  report.least_distance = std::numeric_limits<double>::infinity();
  std::vector<NearFace> near;
  for (const FaceId f : hull.triangles.ids()) {
    counter.next();
    const Triangle face = hull.triangle(f);
    const bool keeps = search.keeps_gap(face);
    const NearFace found =
        search.nearest(f, face, keeps ? report.least_distance : std::numeric_limits<double>::infinity());
    report.least_distance = std::min(report.least_distance, found.distance);
    if (!keeps) near.push_back(found);
  }
  report.faces_too_near = near.size();
  std::ranges::stable_sort(near, {}, &NearFace::distance);
  near.resize(std::min(near.size(), options.max_offenders));
  report.nearest = std::move(near);
  return report;
}

}  // namespace prohull::verify
