#include "prohull/tolerances.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <utility>
#include <vector>

#include "prohull/detail/progress_meter.h"
#include "prohull/error.h"
#include "verify/nearest_face.h"

namespace prohull {
namespace {

using Corners = std::array<std::array<double, 3>, 3>;

/// Equal for faces that have the same corners in the same orientation.
Corners positions_of(const Triangle& t) {
  const auto corner = [](const Vec3& p) { return std::array{p.x, p.y, p.z}; };
  Corners key{corner(t.a), corner(t.b), corner(t.c)};
  std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
  return key;
}

void check(const TriangleMesh& hull, const TriangleMesh& mesh, const PerFace<double>& tolerances) {
  verify::require_distances(hull);
  verify::require_distances(mesh);
  if (tolerances.size() != mesh.face_count())
    throw InputError(Defect::InvalidOption, fmt::format("{} tolerances for {} faces: there must be one for each face",
                                                        tolerances.size(), mesh.face_count()));
}

std::size_t count_missing(const TriangleMesh& hull, const TriangleMesh& mesh, const PerFace<double>& tolerances) {
  std::vector<Corners> there;
  for (const FaceId f : hull.triangles.ids()) there.push_back(positions_of(hull.triangle(f)));
  std::ranges::sort(there);
  std::size_t missing = 0;
  for (const FaceId f : mesh.triangles.ids())
    missing += tolerances[f] == 0 && !std::ranges::binary_search(there, positions_of(mesh.triangle(f)));
  return missing;
}

/// True only if no point of t is farther away from the faces.
bool is_within(const Triangle& t, const verify::NearestFace& faces, double distance) {
  constexpr std::size_t kMostParts = 1'000'000;
  const verify::FarFromFaces rule(faces);
  verify::FarFromFaces::Search search(rule, {.max_parts = kMostParts, .at_most = distance});
  search.add({{t.a, t.b, t.c}, {rule.look_at(t.a, search), rule.look_at(t.b, search), rule.look_at(t.c, search)}});
  return search.run([] {}).upper <= distance;
}

std::size_t count_far(const TriangleMesh& hull, const TriangleMesh& mesh, const PerFace<double>& tolerances,
                      const Progress& progress) {
  const double largest = std::max(verify::largest_coordinate(hull), verify::largest_coordinate(mesh));
  const double unit = verify::usable_unit(largest), rounding = verify::rounding_of_distances(largest * unit);
  const TriangleMesh to = verify::scaled(hull, unit), from = verify::scaled(mesh, unit);
  const verify::NearestFace faces(to);
  ProgressMeter meter(progress, "verify");
  std::atomic<std::size_t> far = 0, done = 0;
  oneapi::tbb::parallel_for(std::size_t{0}, mesh.face_count(), [&](std::size_t i) {
    const FaceId f{static_cast<std::uint32_t>(i)};
    const bool is_asked = tolerances[f] > 0 && tolerances[f] < std::numeric_limits<double>::infinity();
    if (is_asked && !is_within(from.triangle(f), faces, tolerances[f] * unit - rounding)) ++far;
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
