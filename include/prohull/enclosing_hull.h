#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/distance.h"
#include "prohull/hull_builder.h"
#include "prohull/names.h"
#include "prohull/progress.h"
#include "prohull/repair.h"
#include "prohull/triangle_mesh.h"
#include "prohull/wrap.h"

namespace prohull {

/// What may be done to triangles that are not a closed 2-manifold.
enum class Repair {
  Auto,  ///< repair the triangles; wrap them where they do not close, or where the hull is not what was asked for
  None,  ///< do only what closed_mesh does, and refuse what is not closed then
  Wrap,  ///< wrap the triangles at once
};

/// "auto", "none", "wrap"
Names<Repair> repair_names();

struct EnclosingOptions {
  HullOptions hull = {};  ///< enclosing_hulls sets its target_faces and its progress
  HullBounds bounds = {};
  bool tight = false;   ///< build tight hulls (tight_hull.h), which have no levels
  bool levels = false;  ///< keep the levels of a hull of a wrap too: it then does not move towards the triangles
  Repair repair = Repair::Auto;
  bool keep_cavities = false;  ///< keep components that lie inside of others; inner hulls always do
  double seal_holes = 0;       ///< a wrap closes openings up to this diameter, in the input's unit
  Wrapper wrap = {};           ///< for instance alpha_wrap; without a wrapper, what is not closed is refused
  /// Stages "repair", "wrap", "build", "tighten", "search", "measure" and "verify". Some occur several times.
  Progress progress = {};
};

/// One hull, and how far it can be trusted.
struct EnclosingHull {
  TriangleMesh mesh;
  bool certified = false;        ///< enclosure is proven exactly, by code that shares nothing with the construction
  std::string_view proof;        ///< how: "replay", "enclosure" or "coverage" (verification.h); empty if not certified
  std::size_t target_faces = 0;  ///< how many faces were asked for
  bool target_reached = false;   ///< the mesh has at most target_faces faces, or `bounds` allow no fewer
  bool within_bounds = true;     ///< the hull keeps `bounds`
  double void_ratio = 0;         ///< volume of the hull / volume of the solid that it was built from - 1
  double wrap_alpha = 0;         ///< alpha of the wrap that it was built from; 0 if built from the repaired input
  std::vector<std::string> notes;  ///< sentences for the user: why something is not as asked for, and what to look at

  std::size_t solid = 0;  ///< it was built from EnclosingHulls::solids[solid]
  /// The levels, with this hull as their base mesh (before it was rounded to float32). Empty for tight hulls, and for
  /// hulls of wraps unless EnclosingOptions::levels kept them.
  std::optional<ProgressiveHull> levels;
  RefusalCounts refusals, blocked;     ///< as in HullResult
  unsigned relaxed_guards = 0;         ///< as in HullResult; 0 if the hull is a finer level
  std::size_t rounded_vertices = 0;    ///< how many vertices were moved to float32 coordinates
  std::size_t self_intersections = 0;  ///< pairs of faces of the hull that intersect
  double build_seconds = 0, verify_seconds = 0;
};

/// A closed mesh that hulls were built from.
struct Solid {
  TriangleMesh mesh;
  double wrap_alpha = 0;  ///< alpha of the wrap; 0 if the solid is the repaired input itself
  double volume = 0;
  std::size_t self_intersections = 0;  ///< pairs of faces that intersect
};

struct EnclosingHulls {
  RepairedMesh input;
  std::vector<Solid> solids;         ///< all that were tried, in this order
  std::vector<EnclosingHull> hulls;  ///< one for each number of faces, in the order in which they were asked for
  double repair_seconds = 0;         ///< includes the wraps
};

/// The first step of enclosing_hulls: repairs the triangles. If `closed` is empty in the result, or with Repair::Wrap,
/// hulls would be built from wraps. Throws InputError where enclosing_hulls would refuse these triangles.
RepairedMesh prepared_for_hulls(TriangleMesh triangles, const EnclosingOptions& options = {});

/// Builds hulls of any triangles, one for each of `target_faces`: a hull has at most so many faces where that is
/// possible, and encloses every finite triangle of the input, triangles without area included. (HullSide::Inner: the
/// input, which must be closed, encloses the hull.)
///
/// Guaranteed: `certified` is decided exactly, on the coordinates returned, by verify_replay, verify_enclosure or
/// verify_cover. With options.hull.float32_coordinates these are float32 numbers.
///
/// Throws InputError if no triangle is finite, if options are outside their range or contradict each other, and if the
/// input is not closed and the hull is an inner one or there is no `wrap`; Cancelled.
///
///   const std::size_t budgets[]{1000, 100};
///   const EnclosingHulls made = enclosing_hulls(read_mesh("part.stl"), budgets, {.wrap = alpha_wrap});
///   if (made.hulls[1].certified) write_mesh("coarse.ply", made.hulls[1].mesh);
///
/// How it works: solids are tried one after the other, and the first hull that is good in every respect is taken.
///  1. The repaired input, if it is closed.
///  2. Wraps with an alpha of 1/50, 1/20 and 1/10 of the diagonal and an offset of 1/600. At the end the vertices of
///     such a hull move back towards the triangles, because `bounds` are measured from the triangles.
/// A hull is good if it is certified, free of self-intersection, within the bounds, of at most target_faces faces, and
/// of at most one and a half times the volume of the input (this last only where levels need not be kept). If no hull
/// is good, the best is taken: what counts is the certificate first, then freedom from self-intersection, the bounds,
/// the number of faces, and the volume.
EnclosingHulls enclosing_hulls(TriangleMesh triangles, std::span<const std::size_t> target_faces,
                               const EnclosingOptions& options = {});

/// Builds one hull, as enclosing_hulls does for one number of faces.
///
///   const EnclosingHull hull = enclosing_hull(read_mesh("part.stl"), 500, {.wrap = alpha_wrap});
///   if (hull.certified) write_mesh("hull.ply", hull.mesh);
EnclosingHull enclosing_hull(TriangleMesh triangles, std::size_t target_faces, const EnclosingOptions& options = {});

}  // namespace prohull
