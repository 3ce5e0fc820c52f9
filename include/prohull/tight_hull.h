#pragma once

#include <cstddef>
#include <functional>

#include "prohull/hull_builder.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

struct TightHull {
  TriangleMesh mesh;
  Stopped stopped;
  RefusalCounts refusals, blocked;  ///< as in HullResult, but for the collapses towards the mesh at the end
  std::size_t moved_vertices = 0;   ///< how often a vertex was moved towards the original
  unsigned relaxed_guards = 0;      ///< as in HullResult
};

/// One hull of at most options.target_faces, tighter than the base mesh of build_hull: edge collapses take turns with
/// rounds in which each vertex moves towards the original mesh, as far as enclosure, shape and freedom from
/// self-intersection allow. It takes some twenty to seventy times as long, and leaves no nested levels.
/// Guaranteed: a closed 2-manifold that encloses `mesh` (HullSide::Inner: is enclosed by it) in the sense of winding
/// numbers; every collapse and every move is decided by exact predicates on stored coordinates. Pairs of faces that
/// intersect are never more than those of `mesh`. Throws as build_hull does, and InputError(InvalidOption) if
/// options.self_intersections allows more of them. The stage of its progress is "tighten".
///
/// With `wrapped`, `mesh` is a wrap of these triangles (wrap.h): it covers them without touching. Then vertices move
/// towards the triangles, but for a millionth of their diagonal, and the hull covers and does not touch them; it need
/// not enclose the wrap. HullSide::Outer only.
///
///   const TightHull hull = build_tight_hull(closed_mesh(read_mesh("arm.stl")).mesh, {.target_faces = 500});
TightHull build_tight_hull(const TriangleMesh& mesh, const HullOptions& options = {},
                           const TriangleMesh* wrapped = nullptr);

struct MoveOptions {
  ShapeGuards guards = {};
  bool float32_coordinates = false;  ///< as in HullOptions
  Progress progress = {};            ///< stage "tighten"
};

/// A hull that covers the triangles without touching them, its vertices moved towards them as build_tight_hull does at
/// the end: a fraction of its time, and of hulls of wraps nearly all of what there is to gain. The guarantees are the
/// same.
TriangleMesh moved_towards(const TriangleMesh& hull, const TriangleMesh& triangles, const MoveOptions& options = {});

/// The most hulls that build_tight_hull_within builds, with the progressive one that it begins with.
constexpr int kMaxTightBuilds = 11;

/// The coarsest tight hull found, of at least options.target_faces, that `is_within` accepts: such as those that are
/// near enough to the mesh (see HullBounds). Found by bisection of the logarithm of the number of faces, from
/// target_faces to the coarsest level of build_hull that is accepted, to 3 %, as if finer hulls always were; a coarser
/// one may exist. That level is the answer where no tight hull is both coarser and accepted. `progress`: stage
/// "search". Throws as build_hull does, and what is_within throws.
///
///   const HullBounds bounds{.max_distance = 0.5};  // mm, if the mesh has that unit
///   const auto is_near = [&](const TriangleMesh& hull) { return bounds.hold(hull, arm, signed_volume(arm)); };
///   const TightHull hull = build_tight_hull_within(arm, is_near, {.target_faces = 100});
TightHull build_tight_hull_within(const TriangleMesh& mesh, const std::function<bool(const TriangleMesh&)>& is_within,
                                  const HullOptions& options = {}, const TriangleMesh* wrapped = nullptr);

}  // namespace prohull
