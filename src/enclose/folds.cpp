#include "enclose/folds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "construct/lifting.h"
#include "enclose/offset_surface.h"
#include "geometry/float32.h"
#include "prohull/convex_hull.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/detail/text.h"
#include "verify/known_solid.h"

namespace prohull {
namespace {

TriangleMesh some_faces(const TriangleMesh& mesh, const std::vector<FaceId>& faces) {
  TriangleMesh some{mesh.positions, {}};
  for (const FaceId f : faces) some.triangles.push_back(mesh.triangles[f]);
  return some;
}

std::vector<Offender> uncovered(const TriangleMesh& triangles, const TriangleMesh& mesh, const Progress& progress) {
  return verify_cover(triangles, mesh, {.max_offenders = triangles.face_count(), .progress = progress}).worst;
}

/// Any distance for the faces that are at most `rings[i]` edges away from triangle i; all others are kept.
PerFace<double> free_around(const TriangleMesh& triangles, const std::vector<int>& rings, const TriangleMesh& mesh) {
  PerVertex<int> rings_left(mesh.vertex_count(), 0);
  for (std::size_t i = 0; i < rings.size(); ++i)
    for (const VertexId v : triangles.triangles[FaceId(i)]) rings_left[v] = std::max(rings_left[v], rings[i]);
  for (int ring = std::ranges::max(rings); ring > 1; --ring)
    for (const auto& corners : mesh.triangles)
      for (const VertexId v : corners)
        if (rings_left[v] == ring)
          for (const VertexId w : corners) rings_left[w] = std::max(rings_left[w], ring - 1);
  PerFace<double> tolerances(mesh.face_count(), 0.0);
  for (const FaceId f : mesh.triangles.ids())
    for (const VertexId v : mesh.triangles[f])
      if (rings_left[v] > 0) tolerances[f] = std::numeric_limits<double>::infinity();
  return tolerances;
}

TriangleMesh collapsed_around(const TriangleMesh& triangles, const std::vector<int>& rings, const TriangleMesh& mesh,
                              bool relax_guards, const HullOptions& how) {
  HullOptions options{.relax_guards = relax_guards,
                      .tolerances = free_around(triangles, rings, mesh),
                      .float32_coordinates = how.float32_coordinates,
                      .threads = how.threads,
                      .progress = how.progress};
  const auto kept = static_cast<std::size_t>(std::ranges::count(options.tolerances, 0.0));
  options.target_faces = std::max<std::size_t>(4, kept);
  return build_hull(mesh, options).hull.base();
}

}  // namespace

// What is lifted covers what it has covered before.
std::optional<TriangleMesh> lifted_until_covered(TriangleMesh hull, const TriangleMesh& triangles,
                                                 std::vector<Offender> offenders, const HullOptions& how) {
  constexpr int kLifts = 5;
  const double diagonal = bounding_box(hull).diagonal();
  for (int lifts = 0; lifts < kLifts && !offenders.empty(); ++lifts) {
    std::vector<Protrusion> protrusions;
    for (const Offender& o : offenders) protrusions.push_back({o.point, o.distance});
    hull = lifted_over(hull, protrusions,
                       {.least = std::pow(10.0, lifts - 8) * diagonal,
                        .rings = lifts,
                        .float32_coordinates = how.float32_coordinates});
    offenders = uncovered(triangles, hull, how.progress);
  }
  return offenders.empty() ? std::optional(std::move(hull)) : std::nullopt;
}

// A collapse covers what the mesh covers, too. Of the models that we have, folds take 1 to 10 rounds.
std::optional<Unfolded> unfolded(const TriangleMesh& mesh, const HullOptions& how) {
  constexpr std::size_t kMostPairs = 1000;  // where there are more, faces_beside_the_solid does not know
  constexpr int kRounds = 12, kStrict = 3;
  verify::KnownSolid solid(mesh, "mesh");
  ProgressMeter meter(how.progress, "repair");
  const std::size_t pairs = solid.self_intersections(meter).size();
  if (pairs == 0 || pairs > kMostPairs) return std::nullopt;
  const std::vector<FaceId> folded = solid.faces_beside(how.progress);
  if (folded.empty()) return std::nullopt;
  const std::vector<Offender> found = uncovered(some_faces(mesh, folded), mesh, how.progress);
  if (found.empty()) return std::nullopt;
  const Folds folds{found.size(), found.front().point};
  std::vector<FaceId> outside;
  for (const Offender& o : found) outside.push_back(folded[index(o.face)]);
  const TriangleMesh triangles = some_faces(mesh, outside);
  std::vector<int> rings(triangles.face_count(), 1);
  for (int round = 0; round < kRounds; ++round) {
    TriangleMesh made = collapsed_around(triangles, rings, mesh, round >= kStrict, how);
    const std::vector<Offender> left = uncovered(triangles, made, how.progress);
    if (auto lifted = lifted_until_covered(std::move(made), triangles, left, how))
      return Unfolded{std::move(*lifted), folds};
    for (const Offender& o : left) ++rings[index(o.face)];
  }
  return std::nullopt;
}

// Wherever a hull is built, it winds around no point less often than what it is built from: so it covers the triangles,
// too. Where the mesh winds backwards, it takes more than one layer. Around needles there are slabs.
std::optional<Unfolded> with_sheets(TriangleMesh mesh, const TriangleMesh& triangles, double distance,
                                    const HullOptions& how) {
  constexpr std::size_t kMostFaces = 2000, kMostSlabs = 1000;
  constexpr int kMostLayers = 4;
  const auto left_of = [&](const TriangleMesh& faces) {
    std::vector<FaceId> outside;
    for (const Offender& o : uncovered(faces, mesh, how.progress)) outside.push_back(o.face);
    return some_faces(faces, outside);
  };
  TriangleMesh left = left_of(triangles);
  const Folds folds{left.face_count(), left.face_count() > 0 ? left.triangle(FaceId{0}).a : Vec3{}};
  for (int layer = 0; layer < kMostLayers && left.face_count() > 0; ++layer) {
    if (left.face_count() > (layer == 0 ? kMostFaces : kMostSlabs)) return std::nullopt;
    TriangleMesh around;
    if (layer == 0)
      around = sheets_around(left, distance);
    else
      for (const FaceId f : left.triangles.ids()) append(around, slab_around(some_faces(left, {f}), distance / 2));
    if (how.float32_coordinates)
      for (Vec3& p : around.positions) p = nearest_float32(p);
    append(mesh, around);
    left = left_of(left);
  }
  if (folds.faces == 0 || left.face_count() > 0) return std::nullopt;
  return Unfolded{std::move(mesh), folds};
}

std::string describe(const Folds& folds) {
  const auto& [faces, p] = folds;
  return fmt::format("{} over, inside out, {} ({:.6g}, {:.6g}, {:.6g})", counted(faces, "face folds", "faces fold"),
                     faces == 1 ? "at" : "as at", p.x, p.y, p.z);
}

}  // namespace prohull
