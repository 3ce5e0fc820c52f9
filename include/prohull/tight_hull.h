#pragma once

#include <cstddef>
#include <functional>
#include <limits>

#include "prohull/hull_builder.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

struct TightHull {
  TriangleMesh mesh;
  Stopped stopped;
  RefusalCounts refusals, blocked;  ///< as in HullResult; the tight collapses at the end are not counted
  std::size_t moved_vertices = 0;   ///< how many times a vertex was moved towards the original
  unsigned relaxed_guards = 0;      ///< as in HullResult
};

/// Builds one hull of at most options.target_faces faces that is tighter than the base mesh of build_hull. Edge
/// collapses take turns with rounds in which every vertex moves towards the original mesh, as far as enclosure, shape
/// and freedom from self-intersection allow. This takes 2 to 8 times as long as build_hull, and gives no levels.
/// A hull of at most 200 faces is then searched on from, in trials that put faces where they are worth more: that
/// takes up to two seconds more, and the void is 10 to 30 % less.
/// Guaranteed: the hull is a closed 2-manifold and encloses `mesh` (HullSide::Inner: is enclosed by it) in the sense of
/// winding numbers. Exact predicates on stored coordinates decide every collapse and every move. The hull has no more
/// pairs of intersecting faces than `mesh`.
/// The stage of progress is "tighten". Throws as build_hull does, and InputError(InvalidOption) if
/// options.self_intersections allows more pairs.
///
/// With `wrapped`, `mesh` is a wrap of these triangles (wrap.h). Then vertices move towards the triangles, up to a
/// millionth of their diagonal. The hull covers the triangles without touching them; it need not enclose the wrap.
/// With `padding`, in the input's unit, no move brings a face nearer to the triangles than that, instead of the
/// millionth. HullSide::Inner only with a padding: `mesh` then lies inside of closed triangles (inner_wrap), and so
/// does the hull.
///
///   const TightHull hull = build_tight_hull(closed_mesh(read_mesh("arm.stl")).mesh, {.target_faces = 500});
TightHull build_tight_hull(const TriangleMesh& mesh, const HullOptions& options = {},
                           const TriangleMesh* wrapped = nullptr, double padding = 0);

/// For moved_towards.
struct MoveOptions {
  ShapeGuards guards = {};
  bool float32_coordinates = false;  ///< as in HullOptions
  unsigned max_rounds = 12;          ///< in each, all vertices move once that may; they end when none has moved
  double padding = 0;                ///< as of build_tight_hull; moved_towards only
  HullSide side = HullSide::Outer;   ///< moved_towards only; an inner hull needs a padding
  unsigned threads = 0;              ///< as in HullOptions
  Progress progress = {};            ///< stage "tighten"
};

/// Moves the vertices of a hull towards the triangles that it covers without touching them, as build_tight_hull does at
/// the end. For hulls of wraps that gains nearly as much, in a fraction of the time. The guarantees are the same.
TriangleMesh moved_towards(const TriangleMesh& hull, const TriangleMesh& triangles, const MoveOptions& options = {});

/// The same for a hull of a closed mesh, on that side of it. The hull may touch the mesh, and becomes tighter.
TriangleMesh moved_towards_closed(const TriangleMesh& hull, const TriangleMesh& mesh, HullSide side,
                                  const MoveOptions& options = {});

/// Searches the coarsest tight hull of at least options.target_faces faces that `is_within` accepts, for instance one
/// that is near enough to the mesh (HullBounds). The search is a bisection of the number of faces to 3 %. It ends at
/// the coarsest level of build_hull that is accepted; if no tight hull is both coarser and accepted, that level is the
/// answer. The bisection assumes that a hull with more faces is accepted if one with fewer is, so a coarser hull may
/// exist. No tight hull of more than most_faces is sought: if that many are not accepted, neither are fewer. The stage
/// of progress is "search". Throws as build_hull does, and what is_within throws.
///
///   const HullBounds bounds{.max_distance = 0.5};  // mm, if the mesh has that unit
///   const auto is_near = [&](const TriangleMesh& hull) { return bounds.hold(hull, arm, signed_volume(arm)); };
///   const TightHull hull = build_tight_hull_within(arm, is_near, {.target_faces = 100});
TightHull build_tight_hull_within(const TriangleMesh& mesh, const std::function<bool(const TriangleMesh&)>& is_within,
                                  const HullOptions& options = {}, const TriangleMesh* wrapped = nullptr,
                                  double padding = 0, std::size_t most_faces = std::numeric_limits<std::size_t>::max());

}  // namespace prohull
