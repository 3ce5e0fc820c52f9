#include "prohull/hull_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "construct/checked_options.h"
#include "construct/closed_manifold.h"
#include "construct/growth.h"
#include "construct/progressive/rounds.h"
#include "construct/turned.h"
#include "geometry/face_tolerances.h"
#include "parallel/arena.h"
#include "prohull/error.h"

namespace prohull {

void check(const HullOptions& options) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw InputError(Defect::InvalidOption, what);
  };
  require(options.target_faces >= 4, "target_faces must be at least 4, the faces of a tetrahedron");
  require(options.side == HullSide::Outer || options.self_intersections != SelfIntersections::Allowed,
          "self-intersections cannot be allowed: an inner hull that intersects itself could stick out of the mesh");
  const ShapeGuards& guards = options.guards;
  constexpr unsigned kMost = 1000;
  static_assert(kMost + 2 <= ProgressiveHull::kMostValence, "a symmetric pair of collapses goes beyond it by two");
  require(guards.max_valence >= 3 && guards.max_valence <= kMost, "max_valence must be in [3, 1000]");
  require(guards.min_compactness_ratio >= 0 && guards.min_compactness_ratio <= 1,
          "min_compactness_ratio must be in [0, 1]");
  require(guards.sufficient_compactness >= 0 && guards.sufficient_compactness <= 1,
          "sufficient_compactness must be in [0, 1]");
  require(guards.max_normal_deviation >= 0 && guards.max_normal_deviation <= std::numbers::pi / 2,
          "the largest normal deviation must be between 0 and 90 degrees, pi/2 radians");
  require(guards.max_overhang >= 0, "max_overhang must be at least 0");
}

namespace {

void check_tolerances(const TriangleMesh& mesh, const HullOptions& options) {
  const PerFace<double>& tolerances = options.tolerances;
  if (tolerances.empty()) return;
  if (options.mirror)
    throw InputError(Defect::InvalidOption,
                     "a symmetric hull has no tolerances for single faces: ask for one of the two");
  require_tolerances(tolerances, mesh.face_count());
  if (!options.deviations.empty() && options.deviations.size() != mesh.positions.size())
    throw InputError(Defect::InvalidOption,
                     fmt::format("{} deviations for {} vertices: there must be one for each vertex",
                                 options.deviations.size(), mesh.positions.size()));
  if (!std::ranges::all_of(options.deviations, [](double d) { return d >= 0 && std::isfinite(d); }))
    throw InputError(Defect::InvalidOption, "deviations must be numbers of at least 0");
  const auto kept = static_cast<std::size_t>(std::ranges::count(tolerances, 0.0));
  if (kept > options.target_faces)
    throw InputError(Defect::InvalidOption,
                     fmt::format("{} faces are kept as they are, but the hull should have {}: ask for more faces, or "
                                 "keep fewer",
                                 kept, options.target_faces));
}

// Every face with its corners 1 and 2 exchanged: o and d exchange their roles, l and r their sides.
HullResult turned(HullResult result) {
  const auto corner = [](std::uint32_t c) { return c % 3 == 0 ? c : c / 3 * 3 + 3 - c % 3; };
  const ProgressiveHull& hull = result.hull;
  std::vector<VertexId> corners(hull.base_corners().size());
  for (std::uint32_t c = 0; c < corners.size(); ++c) corners[corner(c)] = hull.base_corners()[c];
  std::vector<VertexSplit> splits = hull.splits();
  // (o, d, l) has become (o, l, d), that is (d, o, l): now on the right of o-d.
  for (VertexSplit& split : splits) {
    const auto second = [&](std::uint32_t od) { return corner(od % 3 == 2 ? od - 2 : od + 1); };
    split = {split.o, split.d, split.r, split.l, second(split.do_), second(split.od)};
  }
  result.hull = ProgressiveHull(hull.side(), hull.original_vertex_count(), hull.positions(), std::move(corners),
                                std::move(splits));
  return result;
}

}  // namespace

ShapeGuards weaker(const ShapeGuards& a, const ShapeGuards& b) {
  return {.max_valence = std::max(a.max_valence, b.max_valence),
          .min_compactness_ratio = std::min(a.min_compactness_ratio, b.min_compactness_ratio),
          .sufficient_compactness = std::min(a.sufficient_compactness, b.sufficient_compactness),
          .max_normal_deviation = std::max(a.max_normal_deviation, b.max_normal_deviation),
          .max_overhang = std::max(a.max_overhang, b.max_overhang)};
}

HullResult build_hull(const TriangleMesh& mesh, const HullOptions& options) { return build_hull(mesh, options, {}); }

HullResult build_hull(const TriangleMesh& mesh, const HullOptions& options, const MayReach& may_reach) {
  check(options);
  check_tolerances(mesh, options);
  if (mesh.face_count() == 0) throw InputError(Defect::EmptyMesh, "the mesh has no faces");
  if (!std::ranges::all_of(mesh.positions, is_finite)) require_closed_manifold(mesh);
  if (!(signed_volume(mesh) > 0)) {
    require_closed_manifold(mesh);
    throw InputError(Defect::NoVolume, "the mesh is inside out or encloses nothing; closed_mesh turns what it can");
  }
  return arena_of(options.threads).execute([&] {
    if (options.side == HullSide::Inner) return turned(simplify_in_rounds(turned(mesh), options, nullptr, may_reach));
    return simplify_in_rounds(mesh, options, nullptr, may_reach);
  });
}

}  // namespace prohull
