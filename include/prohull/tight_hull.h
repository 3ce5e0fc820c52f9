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

}  // namespace prohull
