#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "construct/shape_guards.h"
#include "enclose/making.h"
#include "verify/nearest_face.h"

namespace prohull {
namespace {

/// Of each vertex, how far it is from the triangles, about.
PerVertex<double> distances_from(const TriangleMesh& triangles, const TriangleMesh& mesh) {
  const verify::NearestFace faces(triangles);
  PerVertex<double> distances(mesh.positions.size());
  constexpr std::uint32_t kTogether = 1024;  // neighbours, of which one tells where to look for the next
  const auto count = std::uint32_t(mesh.positions.size());
  oneapi::tbb::parallel_for(std::uint32_t{0}, (count + kTogether - 1) / kTogether, [&](std::uint32_t i) {
    std::uint32_t face = 0;
    std::size_t looked_at = 0;
    for (std::uint32_t v = i * kTogether; v < std::min(count, (i + 1) * kTogether); ++v) {
      const Vec3& p = mesh.positions[VertexId{v}];
      const auto found = faces.nearest(p, {face, faces.distance(p, face)}, looked_at);
      distances[VertexId{v}] = found.distance, face = found.face;
    }
  });
  return distances;
}

/// A large hull moves only where it misses the bounds: of three parts, hulls of 19,220, 39,808 and 50,476 faces that
/// kept them broke them by moving, after 3, 7 and 11 s.
bool may_move(std::size_t faces, double excess) { return is_small(faces) || (excess > 1 && excess <= kNearerByMoving); }

/// Of a hull that breaks the bound of the distance, the faces that do, about, and how much less of it may be used
/// there.
struct Narrow {
  TriangleMesh faces;
  double share;
};

/// Of each face of a mesh, whether it is farther from some triangles than `distance`, about; as it is, where that would
/// take long.
std::vector<char> are_beyond(const TriangleMesh& mesh, const verify::NearestFace& triangles, double distance) {
  constexpr std::size_t kMostParts = 1000;
  const verify::FarFromFaces rule(triangles);
  std::vector<char> are_beyond(mesh.face_count());
  oneapi::tbb::parallel_for(std::size_t{0}, mesh.face_count(), [&](std::size_t i) {
    verify::FarFromFaces::Search search(
        rule, {.relative_gap = std::numeric_limits<double>::infinity(), .max_parts = kMostParts, .decides = distance});
    const Triangle t = mesh.triangle(FaceId{static_cast<std::uint32_t>(i)});
    const auto at = [&](const Vec3& p, std::uint32_t guess) {
      return rule.look_at(p, search, {guess, triangles.distance(p, guess)});
    };
    const auto a = at(t.a, 0), b = at(t.b, a.face), c = at(t.c, b.face);
    rule.add(t, {a, b, c}, search);
    are_beyond[i] = search.run([] {}).upper > distance;
  });
  return are_beyond;
}

/// None if there is no such bound.
TriangleMesh faces_beyond(const TriangleMesh& hull, const Making& making) {
  TriangleMesh faces{hull.positions, {}};
  const double distance = making.bounds().max_distance;
  if (std::isinf(distance)) return faces;
  const std::vector<char> beyond = are_beyond(hull, verify::NearestFace(making.to_cover()), distance);
  for (const FaceId f : hull.triangles.ids())
    if (beyond[index(f)]) faces.triangles.push_back(hull.triangles[f]);
  return faces;
}

/// Of each face of `start`.
PerFace<double> tolerances(const TriangleMesh& start, double distance, const std::vector<Narrow>& narrows) {
  PerFace<double> all;
  all.assign(start.face_count(), distance);
  for (const Narrow& narrow : narrows) {
    const verify::NearestFace faces(narrow.faces);
    const std::vector<char> far = are_beyond(start, faces, distance);
    for (const FaceId f : start.triangles.ids())
      if (!far[index(f)]) all[f] *= narrow.share;
  }
  return all;
}

/// A hull with further collapses, which keep so much of the bound of the distance, or all bounds of the void.
struct FurtherTrial {
  HullResult result;
  TriangleMesh mesh;
  double excess;  ///< HullBounds::excess: above 1, it breaks a bound
};

/// The hull, moved towards the triangles if it keeps the bounds then, too: between vertices, it may come farther from
/// them. Large ones stay: moving takes most of the time.
TriangleMesh start_of(const TriangleMesh& hull, const Making& making) {
  if (!is_small(hull.face_count())) return hull;
  TriangleMesh moved = placed(hull, making);
  return excess_of(moved, making) <= 1 ? moved : hull;
}

FurtherTrial try_further(const TriangleMesh& start, double distance, const std::vector<Narrow>& narrows,
                         const Making& making) {
  HullOptions how = making.hull_options();
  const bool is_of_void = std::isinf(distance);
  if (!is_of_void) {
    how.tolerances = tolerances(start, distance, narrows);
    how.deviations = distances_from(making.to_cover(), start);
  }
  how.guards.max_overhang =
      overhang_left(bounding_box(start), bounding_box(making.request.input.original), how.guards.max_overhang);
  HullResult result = build_hull(start, how);
  const auto keeps = [&](const TriangleMesh& level) { return excess_of(level, making) <= 1; };
  TriangleMesh mesh =
      is_of_void && keeps(start) ? result.hull.level(faces_within(result.hull, keeps)) : result.hull.base();
  const double excess = excess_of(mesh, making);
  FurtherTrial trial{std::move(result), std::move(mesh), excess};
  if (trial.excess > 1 && is_small(trial.mesh.face_count())) {
    TriangleMesh moved = placed(trial.mesh, making);
    if (const double nearer = excess_of(moved, making); nearer < trial.excess)
      trial.mesh = std::move(moved), trial.excess = nearer;
  }
  return trial;
}

}  // namespace

// Where the hull moves, it has less void, and may come nearer.
EnclosingHull built_within(const Making& making) {
  const Solid& solid = making.solid();
  HullOptions how = making.hull_options();
  how.tolerances.assign(solid.mesh.face_count(), making.candidate.within);
  if (solid.source != Source::Mesh) how.deviations = distances_from(making.to_cover(), solid.mesh);
  HullResult result = build_hull(solid.mesh, how);
  EnclosingHull hull;
  hull.mesh = result.hull.base();
  hull.target_reached = hull.mesh.face_count() > making.candidate.target_faces;  // which bounds ask for
  hull.refusals = result.refusals, hull.blocked = result.blocked, hull.relaxed_guards = result.relaxed_guards;
  if (!making.recipe().moves) {
    hull.levels = std::move(result.hull);
  } else if (const double excess = excess_of(hull.mesh, making); may_move(hull.mesh.face_count(), excess)) {
    TriangleMesh moved = placed(hull.mesh, making);
    if (excess_of(moved, making) <= std::max(1.0, excess)) hull.mesh = std::move(moved);
  }
  return hull;
}

// What collapses count as used up of the bound is more than what the hull is away. So that is measured, and there are
// further collapses. Between vertices, they may break the bound: where moving does not help, they keep less of it, and
// only there, if it is known where. A chassis at 0.3 % of the diagonal has 24,400 faces, and 27,856 if less of it is
// kept everywhere; a leg at 1 % has 134 and 166. An axis at 0.1 %, where six such trials failed one after the other,
// had 18,694; now less is kept everywhere after two, and it has 6,556. Without a move before each round, a head at 3 %
// had 156 faces, with it 116.
EnclosingHull built_further(const Making& making) {
  constexpr int kMostRounds = 6;
  constexpr double kFewer = 0.95;  // with more faces than so much of those before, another round is not worth its time
  constexpr double kNearer = 0.85, kMuchNearer = 0.1;
  constexpr int kMostNarrow = 2;  // trials that fail one after the other before less is kept everywhere
  EnclosingHull hull = *making.candidate.start;
  hull.levels.reset();
  TriangleMesh start = start_of(hull.mesh, making);
  double distance = making.bounds().max_distance, fewer = 0;
  std::vector<Narrow> narrows;
  int failed = 0;
  for (int round = 0; round < kMostRounds && fewer <= kFewer && distance > 0; ++round) {
    FurtherTrial trial = try_further(start, distance, narrows, making);
    fewer = double(trial.mesh.face_count()) / double(hull.mesh.face_count());
    if (trial.excess > 1) {
      const double share = std::min(kNearer, 1 / trial.excess);
      const bool may_be_narrow = share > kMuchNearer && ++failed <= kMostNarrow;
      TriangleMesh beyond = may_be_narrow ? faces_beyond(trial.mesh, making) : TriangleMesh{};
      if (beyond.face_count() > 0)
        narrows.push_back({std::move(beyond), share});
      else
        distance *= share;
    } else if (failed = 0; fewer < 1) {
      hull.mesh = std::move(trial.mesh);
      if (fewer <= kFewer && round + 1 < kMostRounds) start = start_of(hull.mesh, making);
      hull.refusals += trial.result.refusals, hull.blocked = trial.result.blocked;
      hull.relaxed_guards = std::max(hull.relaxed_guards, trial.result.relaxed_guards);
    }
  }
  return hull;
}

}  // namespace prohull
