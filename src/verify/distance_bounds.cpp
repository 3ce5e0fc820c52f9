#include "prohull/distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "prohull/detail/progress_meter.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "verify/nearest_face.h"

namespace prohull {
namespace {

bool have_same_corners(const Triangle& s, const Triangle& t) {
  const std::array of_s{s.a, s.b, s.c}, of_t{t.a, t.b, t.c};
  return std::is_permutation(of_s.begin(), of_s.end(), of_t.begin());
}

/// Whether every triangle of the part is one of the mesh, in the same order, in either orientation: a hull that is the
/// mesh, or some of its components.
bool is_part_of(const TriangleMesh& part, const TriangleMesh& mesh) {
  std::uint32_t found = 0;
  for (const FaceId f : mesh.triangles.ids()) {
    if (found == part.face_count()) break;
    found += have_same_corners(mesh.triangle(f), part.triangle(FaceId{found}));
  }
  return found == part.face_count();
}

}  // namespace

DistanceBounds distance_bounds(const TriangleMesh& from, const TriangleMesh& to, const DistanceOptions& options) {
  verify::require_distances(from);
  verify::require_distances(to);
  if (is_part_of(from, to)) return {};
  const double largest = std::max(verify::largest_coordinate(from), verify::largest_coordinate(to));
  if (const double unit = verify::usable_unit(largest); unit != 1) {
    DistanceOptions how = options;
    how.decides *= unit;
    return verify::unscaled(distance_bounds(verify::scaled(from, unit), verify::scaled(to, unit), how), unit);
  }

  const verify::NearestFace faces(to);
  const verify::FarFromFaces rule(faces);
  const double rounding = verify::rounding_of_distances(largest);
  verify::FarFromFaces::Search search(rule, {.relative_gap = options.relative_gap,
                                             .absolute_gap = rounding,
                                             .max_parts = options.max_cells,
                                             .decides = std::isfinite(options.decides) ? options.decides - rounding : 0,
                                             .patience = options.max_cells / 8});
  ProgressCounter counter(options.progress, "measure", options.max_cells + from.face_count());
  PerVertex<verify::NearestFace::Found> nearest(from.vertex_count(), verify::NearestFace::kNone);
  std::uint32_t guess = 0;  // near the vertex before
  for (const FaceId f : from.triangles.ids()) {
    counter.next();
    const auto& corners = from.triangles[f];
    for (const VertexId v : corners)
      if (nearest[v].distance == verify::NearestFace::kNone.distance) {
        const Vec3& p = from.positions[v];
        nearest[v] = rule.look_at(p, search, {guess, faces.distance(p, guess)});
        guess = nearest[v].face;
      }
    const auto& [a, b, c] = corners;
    rule.add(from.triangle(f), {nearest[a], nearest[b], nearest[c]}, search);
  }
  return verify::proven(search.run([&] { counter.next(); }), faces, rounding);
}

void HullBounds::require_usable() const {
  if (!(max_distance >= 0 && max_void_ratio >= 0 && max_added_volume >= 0))
    throw InputError(Defect::InvalidOption, "the largest distance, void and added volume must be at least 0");
}

double HullBounds::excess(const TriangleMesh& hull, double hull_volume, const TriangleMesh& original, double volume,
                          const Progress& progress) const {
  require_usable();
  const double added = std::abs(hull_volume - volume);
  // A bound of 0 is kept by nothing but 0. Values that are not known keep none, nor does anything a share of a volume
  // that is not positive.
  const auto quotient = [](double value, double bound) {
    if (value <= bound) return bound > 0 ? value / bound : 0;
    return value > bound && bound > 0 ? value / bound : std::numeric_limits<double>::infinity();
  };
  double most = 0;
  if (std::isfinite(max_added_volume)) most = quotient(added, max_added_volume);
  if (std::isfinite(max_void_ratio)) most = std::max(most, quotient(added, max_void_ratio * volume));
  if (std::isfinite(max_distance))
    most = std::max(
        most,
        quotient(distance_bounds(hull, original, {.decides = max_distance, .progress = progress}).upper, max_distance));
  return most;
}

bool HullBounds::hold(const TriangleMesh& hull, const TriangleMesh& original, double volume,
                      const Progress& progress) const {
  const double hull_volume = any_of_volume() ? solid_volume(hull, progress).value_or(signed_volume(hull)) : volume;
  return excess(hull, hull_volume, original, volume, progress) <= 1;
}

}  // namespace prohull
