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
  Auto,  ///< repaired_mesh; where that is not closed, or its hull is not what was asked for, a wrap
  None,  ///< only what closed_mesh does
  Wrap,  ///< a wrap at once
};

/// "auto", "none", "wrap"
Names<Repair> repair_names();

struct EnclosingOptions {
  HullOptions hull = {};  ///< of which target_faces is set for each hull
  HullBounds bounds = {};
  bool tight = false;
  bool levels = false;  ///< also of hulls of wraps, which then do not move towards the triangles; not with `tight`
  Repair repair = Repair::Auto;
  bool keep_cavities = false;  ///< components inside of others; inner hulls always do
  double seal_holes = 0;       ///< a wrap closes round openings up to this diameter; the input's unit
  Wrapper wrap = {};           ///< such as alpha_wrap; without one, what is not closed is refused
  /// Stages "repair", "wrap", "build", "tighten", "search", "measure", "verify", some of them several times.
  Progress progress = {};
};

/// A hull, and how far it is to be trusted.
struct EnclosingHull {
  TriangleMesh mesh;
  bool certified = false;        ///< proven exactly by code that shares nothing with the construction; see `proof`
  std::string_view proof;        ///< "replay", "enclosure" or "coverage"; empty if not certified
  std::size_t target_faces = 0;  ///< that were asked for
  bool target_reached = false;   ///< the mesh has at most so many faces, or `bounds` allow no fewer
  bool within_bounds = true;     ///< `bounds` hold
  double void_ratio = 0;         ///< volume of the mesh / volume of what it was built from - 1
  double wrap_alpha = 0;         ///< of the wrap that it was built from; 0: built from the repaired input itself
  /// Phrases for the user: why something is not as it was asked for, and what to look at.
  std::vector<std::string> notes;

  /// What it was built from: EnclosingHulls::solids[solid].
  std::size_t solid = 0;
  std::optional<ProgressiveHull> levels;  ///< with this hull, but for rounding, as its base; unless vertices moved
  RefusalCounts refusals, blocked;        ///< as in HullResult
  unsigned relaxed_guards = 0;            ///< as in HullResult; not where the hull is a finer level
  std::size_t rounded_vertices = 0;       ///< moved to float32 coordinates
  std::size_t self_intersections = 0;     ///< pairs of faces
  double build_seconds = 0, verify_seconds = 0;
};

/// A closed mesh that hulls were built from.
struct Solid {
  TriangleMesh mesh;
  double wrap_alpha = 0;  ///< 0: the repaired input itself
  double volume = 0;
  std::size_t self_intersections = 0;
};

struct EnclosingHulls {
  RepairedMesh input;
  std::vector<Solid> solids;         ///< that were looked at, in the order of the ladder
  std::vector<EnclosingHull> hulls;  ///< one for each budget, in the order that was asked for
  double repair_seconds = 0;         ///< with wraps
};

/// The first step of enclosing_hulls: the triangles repaired. Where `closed` is empty, or with Repair::Wrap, hulls
/// would be built from wraps. Throws InputError where enclosing_hulls would refuse these triangles with these options.
RepairedMesh prepared_for_hulls(TriangleMesh triangles, const EnclosingOptions& options = {});

/// Hulls of any triangles, one for each of `target_faces`: meshes of at most so many faces that provably enclose every
/// finite triangle of the input, also those without area (HullSide::Inner: that a closed input encloses). The ladder:
///  1. repaired_mesh; if it is closed, the hull is built from it, and encloses it as build_hull promises.
///  2. Where it is not closed, or the hull has more faces than asked for, intersects itself, breaks the bounds, or has
///     more than one and a half times the volume (where levels need not be kept): a wrap with an alpha of a fiftieth of
///     the diagonal, of a twentieth, of a tenth, and an offset of a 600th; its vertices move back towards the triangles
///     at the end, for bounds are those from the triangles.
/// The first hull that has all of it is taken, else the best of all: certified, free of self-intersection, within the
/// bounds, of the fewest faces above those asked for, of the least volume.
/// Guaranteed: `certified` is decided exactly, on the coordinates returned, by verify_replay, verify_enclosure or
/// verify_cover; with options.hull.float32_coordinates these are float32 numbers.
/// Throws InputError if there is no finite triangle, if an option is outside its range, and where the input is not
/// closed for an inner hull, or without a `wrap`; Cancelled.
///
///   const std::size_t budgets[]{1000, 100};
///   const EnclosingHulls made = enclosing_hulls(read_mesh("part.stl"), budgets, {.wrap = alpha_wrap});
///   if (made.hulls[1].certified) write_mesh("coarse.ply", made.hulls[1].mesh);
EnclosingHulls enclosing_hulls(TriangleMesh triangles, std::span<const std::size_t> target_faces,
                               const EnclosingOptions& options = {});

/// The only hull of enclosing_hulls for one budget.
///
///   const EnclosingHull hull = enclosing_hull(read_mesh("part.stl"), 500, {.wrap = alpha_wrap});
///   if (hull.certified) write_mesh("hull.ply", hull.mesh);
EnclosingHull enclosing_hull(TriangleMesh triangles, std::size_t target_faces, const EnclosingOptions& options = {});

}  // namespace prohull
