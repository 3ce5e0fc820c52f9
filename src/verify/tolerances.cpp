#include "prohull/tolerances.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/bvh.h"
#include "geometry/closest_point.h"
#include "geometry/largest_coordinate.h"
#include "parallel/progress_meter.h"
#include "prohull/error.h"
#include "verify/distance.h"

namespace prohull {
namespace {

using Corners = std::array<std::array<double, 3>, 3>;

/// Equal for faces that have the same corners in the same orientation.
Corners key_of(const Triangle& t) {
  const auto corner = [](const Vec3& p) { return std::array{p.x, p.y, p.z}; };
  Corners key{corner(t.a), corner(t.b), corner(t.c)};
  std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
  return key;
}

/// How far faces are from a hull.
class Nearness {
 public:
  Nearness(const TriangleMesh& hull, const Box& of_mesh) : hull_(hull) {
    std::vector<Box> boxes;
    Box all = of_mesh;
    for (const FaceId f : hull.triangles.ids()) boxes.push_back(box_of(hull.triangle(f)));
    for (const Box& box : boxes) all.extend(box);
    tree_ = Bvh(std::move(boxes));
    rounding_ = 64 * 0x1p-53 * largest_coordinate(all);  // as distance_bounds derives it
  }

  /// True only if no point of t is farther away. A part of a face is no farther from a triangle than the farthest of
  /// its corners, because the distance to a convex set is a convex function.
  bool is_within(const Triangle& t, double distance) const {
    constexpr std::size_t kMostParts = 1'000'000;
    std::vector<Triangle> parts{t};
    for (std::size_t seen = 0; !parts.empty(); ++seen) {
      const Triangle part = parts.back();
      parts.pop_back();
      bool is_near = false;
      for (const Vec3& p : {part.a, part.b, part.c}) {
        const auto [face, least] = nearest(p);
        if (least + rounding_ > distance) return false;
        is_near = is_near || reach(part, face) + rounding_ <= distance;
      }
      if (is_near) continue;
      if (seen == kMostParts) return false;
      halve(part, parts);
    }
    return true;
  }

 private:
  struct Nearest {
    FaceId face;
    double distance;
  };

  double distance(const Vec3& p, FaceId f) const { return norm(p - closest_point(p, hull_.triangle(f))); }

  Nearest nearest(const Vec3& p) const {
    Nearest best{FaceId{0}, std::numeric_limits<double>::infinity()};
    tree_.least([&](const Box& box) { return verify::distance(p, box); },
                [&](std::uint32_t i) {
                  const double d = distance(p, FaceId{i});
                  if (d < best.distance) best = {FaceId{i}, d};
                  return d;
                });
    return best;
  }

  double reach(const Triangle& t, FaceId f) const {
    return std::max({distance(t.a, f), distance(t.b, f), distance(t.c, f)});
  }

  // At the middle of the longest edge.
  static void halve(const Triangle& t, std::vector<Triangle>& parts) {
    const double ab = squared_norm(t.b - t.a), bc = squared_norm(t.c - t.b), ca = squared_norm(t.a - t.c);
    const auto [a, b, c] = ab >= bc && ab >= ca ? t : bc >= ca ? Triangle{t.b, t.c, t.a} : Triangle{t.c, t.a, t.b};
    const Vec3 middle = a * 0.5 + b * 0.5;
    parts.push_back({a, middle, c});
    parts.push_back({middle, b, c});
  }

  const TriangleMesh& hull_;
  Bvh tree_;
  double rounding_;
};

void check(const TriangleMesh& hull, const TriangleMesh& mesh, const PerFace<double>& tolerances) {
  for (const TriangleMesh* const m : {&hull, &mesh}) {
    if (m->face_count() == 0) throw InputError(Defect::EmptyMesh, "there is no distance without faces");
    for (const auto& corners : m->triangles)
      for (const VertexId v : corners)
        if (!is_finite(m->positions[v]))
          throw InputError(Defect::NonFiniteCoordinate, "there is no distance from coordinates that are not finite");
  }
  if (tolerances.size() != mesh.face_count())
    throw InputError(Defect::InvalidOption, fmt::format("{} tolerances for {} faces: there must be one for each face",
                                                        tolerances.size(), mesh.face_count()));
}

std::size_t count_missing(const TriangleMesh& hull, const TriangleMesh& mesh, const PerFace<double>& tolerances) {
  std::vector<Corners> there;
  for (const FaceId f : hull.triangles.ids()) there.push_back(key_of(hull.triangle(f)));
  std::ranges::sort(there);
  std::size_t missing = 0;
  for (const FaceId f : mesh.triangles.ids())
    missing += tolerances[f] == 0 && !std::ranges::binary_search(there, key_of(mesh.triangle(f)));
  return missing;
}

std::size_t count_far(const TriangleMesh& hull, const TriangleMesh& mesh, const PerFace<double>& tolerances,
                      const Progress& progress) {
  const Nearness nearness(hull, bounding_box(mesh));
  ProgressMeter meter(progress, "verify");
  std::atomic<std::size_t> far = 0, done = 0;
  oneapi::tbb::parallel_for(std::size_t{0}, mesh.face_count(), [&](std::size_t i) {
    const FaceId f{static_cast<std::uint32_t>(i)};
    const bool is_asked = tolerances[f] > 0 && tolerances[f] < std::numeric_limits<double>::infinity();
    if (is_asked && !nearness.is_within(mesh.triangle(f), tolerances[f])) ++far;
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
