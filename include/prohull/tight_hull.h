#pragma once

#include <cstddef>

#include "prohull/hull_builder.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

struct TightHull {
  TriangleMesh mesh;
  Stopped stopped;
  RefusalCounts refused, blocked;  ///< as in HullResult
  std::size_t moved_vertices = 0;  ///< how often a vertex was moved towards the original
};

/// One hull of at most options.target_faces, tighter than the base mesh of build_hull: edge collapses take turns with
/// rounds in which each vertex moves towards the original mesh, as far as enclosure, shape and freedom from
/// self-intersection allow. It takes some ten times as long, and leaves no nested levels.
/// Guaranteed: a closed 2-manifold that encloses `mesh` (HullSide::Inner: is enclosed by it) in the sense of winding
/// numbers; every collapse and every move is decided by exact predicates on stored coordinates. Pairs of faces that
/// intersect are never more than those of `mesh`, whatever options.self_intersections says. Throws as build_hull does.
///
///   const TightHull hull = build_tight_hull(closed_mesh(read_mesh("arm.stl")).mesh, {.target_faces = 500});
TightHull build_tight_hull(const TriangleMesh& mesh, const HullOptions& options = {});

/// The most tight hulls that build_tight_hull_within builds, but for one more where none of them is near enough.
constexpr int kMaxTightBuilds = 9;

/// The coarsest tight hull found, of at least options.target_faces, no point of which is farther than `distance` from
/// `mesh`, provenly (see distance_bounds); with options.float32_coordinates also after with_float32_coordinates.
/// Found by bisection of the logarithm of the number of faces, from target_faces to the coarsest level of build_hull
/// that is near enough, to 3 %, as if finer hulls were never farther; a coarser one may exist. That level is the answer
/// where no tight hull is both coarser and near enough. `progress` sees one build after another, each with its
/// target_faces; if it cancels, the answer is the best so far, at worst `mesh` itself. Throws as build_hull does, and
/// for a distance that is not above 0.
///
///   const TightHull hull = build_tight_hull_within(arm, 0.5, {.target_faces = 100});  // 0.5 mm, if its unit is that
TightHull build_tight_hull_within(const TriangleMesh& mesh, double distance, const HullOptions& options = {});

}  // namespace prohull
