#include "prohull/tolerances.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/face_tolerances.h"
#include "geometry/triangle_key.h"
#include "prohull/detail/progress_meter.h"
#include "verify/nearest_face.h"

namespace prohull {
namespace {

using verify::NearestFace;

void check(const TriangleMesh& hull, const TriangleMesh& mesh, const PerFace<double>& tolerances) {
  verify::require_distances(hull);
  verify::require_distances(mesh);
  require_tolerances(tolerances, mesh.face_count());
}

std::size_t count_missing(const TriangleMesh& hull, const TriangleMesh& mesh, const PerFace<double>& tolerances) {
  std::vector<TriangleKey> there;
  for (const FaceId f : hull.triangles.ids()) there.push_back(oriented_key(hull.triangle(f)));
  std::ranges::sort(there);
  std::size_t missing = 0;
  for (const FaceId f : mesh.triangles.ids())
    missing += tolerances[f] == 0 && !std::ranges::binary_search(there, oriented_key(mesh.triangle(f)));
  return missing;
}

using Polygon = std::vector<Vec3>;

/// The parts of a convex polygon on both sides of a plane. Both have the same points on it.
struct Sides {
  Polygon front, behind;
};
Sides cut(const Polygon& polygon, const Vec3& on_plane, const Vec3& normal) {
  Sides sides;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = dot(p - on_plane, normal), at_q = dot(q - on_plane, normal);
    if (at_p >= 0) sides.front.push_back(p);
    if (at_p <= 0) sides.behind.push_back(p);
    if (!((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))) continue;
    const Vec3 crossing = p + (q - p) * (at_p / (at_p - at_q));
    sides.front.push_back(crossing), sides.behind.push_back(crossing);
  }
  return sides;
}

struct Way {
  Vec3 from, to;
};
Way longest_way(const Polygon& polygon) {
  Way longest{polygon.front(), polygon.front()};
  for (const Vec3& p : polygon)
    for (const Vec3& q : polygon)
      if (norm(q - p) > norm(longest.to - longest.from)) longest = {p, q};
  return longest;
}

/// Whether all points of a face are within a distance of others: proven if true. Parts that lie over one of these, and
/// are within the distance of it, are cut out of the face. So parts of a plane need no more parts than faces.
class WithinSearch {
 public:
  /// `per_cut`: how far a cut may round a point.
  WithinSearch(const NearestFace& faces, const TriangleMesh& mesh, double per_cut)
      : faces_(faces), mesh_(mesh), per_cut_(per_cut) {}

  bool holds(const Triangle& t, double distance) {
    constexpr std::size_t kMostParts = 10'000;
    open_.assign(1, {{t.a, t.b, t.c}, distance});
    for (std::size_t parts = 0; !open_.empty(); ++parts) {
      const Part part = std::move(open_.back());
      open_.pop_back();
      if (parts == kMostParts || !is_done(part)) return false;
    }
    return true;
  }

 private:
  struct Part {
    Polygon corners;
    double within;  ///< what is left of the distance by the rounding of cuts
  };

  /// Whether the part is covered, or what is left of it is open; not if it is too far away.
  bool is_done(const Part& part) {
    Vec3 middle;
    for (const Vec3& p : part.corners) middle = middle + p * (1.0 / double(part.corners.size()));
    const auto found = faces_.nearest(middle, NearestFace::kNone, looked_at_);
    if (found.distance > part.within) return false;
    if (is_covered(part, found.face)) return true;
    for (const Vec3& p : part.corners)
      if (is_covered(part, faces_.nearest(p, NearestFace::kNone, looked_at_).face)) return true;
    constexpr double kLarge = 16;  // distances
    const Way longest = longest_way(part.corners);
    const bool is_large = norm(longest.to - longest.from) > kLarge * part.within;
    if (!is_large || !take_away(part, found.face)) halve(part, longest);
    return true;
  }

  /// The distance from a face is a convex function.
  bool is_covered(const Part& part, std::uint32_t face) const {
    return std::ranges::all_of(part.corners, [&](const Vec3& p) { return faces_.distance(p, face) <= part.within; });
  }

  /// What lies beyond the edges of the face is left, if what lies over it is covered.
  bool take_away(const Part& part, std::uint32_t number) {
    const Triangle face = mesh_.triangle(FaceId{number});
    const Vec3 normal = cross(face.b - face.a, face.c - face.a);
    const std::array corners{face.a, face.b, face.c};
    std::vector<Part> beyond;
    Part over = part;
    for (std::size_t k = 0; k < 3 && over.corners.size() > 2; ++k) {
      Sides sides = cut(over.corners, corners[k], cross(corners[(k + 1) % 3] - corners[k], normal));
      over = {std::move(sides.behind), over.within - per_cut_};
      if (sides.front.size() > 2) beyond.push_back({std::move(sides.front), over.within});
    }
    if (over.corners.size() < 3 || beyond.empty() || !is_covered(over, number)) return false;
    open_.insert(open_.end(), beyond.begin(), beyond.end());
    return true;
  }

  /// Across its longest way from corner to corner.
  void halve(const Part& part, const Way& longest) {
    Sides sides = cut(part.corners, (longest.from + longest.to) * 0.5, longest.to - longest.from);
    const double within = part.within - per_cut_;
    open_.push_back({std::move(sides.front), within}), open_.push_back({std::move(sides.behind), within});
  }

  const NearestFace& faces_;
  const TriangleMesh& mesh_;
  const double per_cut_;
  std::vector<Part> open_;
  std::size_t looked_at_ = 0;
};

std::size_t count_far(const TriangleMesh& hull, const TriangleMesh& mesh, const PerFace<double>& tolerances,
                      const Progress& progress) {
  const double largest = std::max(verify::largest_coordinate(hull), verify::largest_coordinate(mesh));
  const double unit = verify::usable_unit(largest), rounding = verify::rounding_of_distances(largest * unit);
  // A crossing p + (q - p) f is off by 5 eps of the largest coordinate in each of its own, and 5 sqrt(3) < 9.
  const double per_cut = 9 * 0x1p-53 * largest * unit;
  const TriangleMesh to = verify::scaled(hull, unit), from = verify::scaled(mesh, unit);
  const NearestFace faces(to);
  ProgressMeter meter(progress, "verify");
  std::atomic<std::size_t> far = 0, done = 0;
  oneapi::tbb::parallel_for(std::size_t{0}, mesh.face_count(), [&](std::size_t i) {
    const FaceId f{static_cast<std::uint32_t>(i)};
    const bool is_asked = tolerances[f] > 0 && tolerances[f] < std::numeric_limits<double>::infinity();
    if (is_asked && !WithinSearch(faces, to, per_cut).holds(from.triangle(f), tolerances[f] * unit - rounding)) ++far;
    meter.at(++done, mesh.face_count());
  });
  return far;
}

}  // namespace

ToleranceReport verify_tolerances(const TriangleMesh& hull, const TriangleMesh& mesh, const PerFace<double>& tolerances,
                                  const Progress& progress) {
  check(hull, mesh, tolerances);
  ToleranceReport report;
  report.missing_faces = count_missing(hull, mesh, tolerances);
  report.far_faces = count_far(hull, mesh, tolerances, progress);
  report.holds = report.missing_faces == 0 && report.far_faces == 0;
  return report;
}

}  // namespace prohull
