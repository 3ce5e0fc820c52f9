#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "prohull/detail/names.h"
#include "prohull/distance.h"
#include "prohull/hull_builder.h"
#include "prohull/progress.h"
#include "prohull/repair.h"
#include "prohull/triangle_mesh.h"
#include "prohull/verification.h"

namespace prohull {

/// What may be done to triangles that are not a closed 2-manifold.
enum class Repair {
  Auto,  ///< repair the triangles, and take the best of several hulls
  None,  ///< do only what closed_mesh does, and refuse what is not closed then
  Wrap,  ///< wrap the triangles at once
};

/// What a hull was built from.
enum class Source {
  Mesh,        ///< the repaired input, its caps included
  ConvexHull,  ///< the convex hull of the input
  Wrap,        ///< a wrap of the input (wrap.h)
};

/// "mesh", "convex-hull", "wrap"
Names<Source> source_names();

/// "auto", "none", "wrap"
Names<Repair> repair_names();

struct EnclosingOptions {
  /// enclosing_hulls sets its target_faces and its progress. Its tolerances are those of the faces of `triangles`. A
  /// hull with tolerances is built from the repaired input only, has no padding, is not tight, and is checked by
  /// verify_tolerances. A symmetric hull (HullOptions::mirror) is built from the repaired input only, has no padding,
  /// is not tight, and is checked by inspect_symmetry.
  HullOptions hull = {};
  HullBounds bounds = {};
  unsigned best_of = 1;  ///< build with this many seeds, from HullOptions::seed on, and keep the best hull; at least 1
  /// Try tight hulls too (tight_hull.h), which have no levels: of the mesh if that is closed, else of the solid that
  /// has the best hull. The hull is never worse than without.
  bool tight = false;
  /// The hull keeps at least this distance from the triangles, in the input's unit; without levels only. An inner hull
  /// leaves out what is thinner than twice of it. Must be less than bounds.max_distance.
  double padding = 0;
  bool levels = false;  ///< keep the levels, whatever they are of: the hull then does not move towards the triangles
  Repair repair = Repair::Auto;
  bool keep_cavities = false;  ///< keep components that lie inside of others; inner hulls always do
  OpenShells open_shells = OpenShells::Close;
  double seal_holes = 0;  ///< a wrap closes openings up to this diameter, in the input's unit
  /// Stages "repair", "wrap", "build", "tighten", "search", "measure" and "verify". Some occur several times.
  Progress progress = {};
};

/// One hull, and how far it can be trusted.
struct EnclosingHull {
  TriangleMesh mesh;
  bool certified = false;  ///< enclosure is proven exactly, by code that shares nothing with the construction
  /// What verify_hull says of `mesh` and all finite triangles of the input as they were given. If these are not closed,
  /// but could be closed, RepairedMesh::closed stands for them. Distances are not measured: verdict_of (summary.h).
  Verification verdict;
  std::size_t target_faces = 0;  ///< how many faces were asked for
  bool target_reached = false;   ///< the mesh has at most target_faces faces, or none with fewer was found to keep
                                 ///< `bounds`
  bool within_bounds = true;     ///< the hull keeps `bounds`
  double excess = 0;             ///< HullBounds::excess, if bounds were given; above 1 where it does not keep them
  double padding = 0;            ///< Verdict::gap, if EnclosingOptions::padding asks for one; else 0
  double volume_inside = 0;      ///< EnclosingHulls::volume; of an estimate, that with which bounds compare this hull
  double void_ratio = 0;         ///< volume of the hull / volume_inside - 1; NaN if that is not known well enough
  Source source = Source::Mesh;
  std::vector<std::string> notes;  ///< sentences for the user: why something is not as asked for, and what to look at

  std::size_t solid = 0;  ///< it was built from EnclosingHulls::solids[solid]
  /// The levels, with this hull as their base mesh (before it was rounded to float32). Empty for tight hulls, and for
  /// others that moved after their last collapse, unless EnclosingOptions::levels kept them.
  std::optional<ProgressiveHull> levels;
  RefusalCounts refusals, blocked;               ///< as in HullResult
  unsigned relaxed_guards = 0;                   ///< as in HullResult; 0 of a finer level, or where nothing collapsed
  std::size_t rounded_vertices = 0;              ///< how many vertices were moved to float32 coordinates
  std::size_t self_intersections = 0;            ///< pairs of faces of the hull that intersect
  double build_seconds = 0, verify_seconds = 0;  ///< with those of all that was tried for it
};

/// Of all that the hull winds around at least once, as the verdict has it: overlaps count once. Where these are too
/// many, its signed volume.
double volume_of(const EnclosingHull& hull);

/// Places where a closed mesh folds over itself, inside out: faces there bound no part of its solid, and stick out.
struct Folds {
  std::size_t faces = 0;  ///< faces that the mesh itself does not cover
  Vec3 place;             ///< a point of the one that sticks out farthest
};

/// "6 faces fold over, inside out, as at (0.1, 0.2, 0.3)"
std::string describe(const Folds& folds);

/// A closed mesh that hulls were built from.
struct Solid {
  Source source;
  TriangleMesh mesh;
  double wrap_spacing = 0;     ///< of the grid of a wrap, or the distance of an offset surface, in the input's unit
  double slab_width = 0;       ///< given to the convex hull of what is flat (slab_around), in the input's unit
  TriangleMesh doors = {};     ///< of a wrap: faces across what it closed, which a hull has to cover as well
  double largest_door = 0;     ///< as in Wrap
  std::size_t components = 0;  ///< parts that no hull of it joins, of at least four faces each
  double volume = 0;
  std::size_t self_intersections = 0;  ///< pairs of faces that intersect
  Folds folds = {};  ///< of the repaired input, if `mesh` is that, changed around its folds so that it covers them
};

struct EnclosingHulls {
  RepairedMesh input;
  std::vector<Solid> solids;         ///< all that were tried, in this order
  std::vector<EnclosingHull> hulls;  ///< one for each number of faces, in the order in which they were asked for
  /// Of what lies inside of the input, with the cavities that repairs have filled; 0 if nothing is known of it. An
  /// estimate is that of the first hull: a wrap tells it, and hulls of other numbers of faces have other wraps.
  double volume = 0;
  /// `volume` is an estimate, by lines or from a wrap. Else it is Verification::original_volume, or where cavities are
  /// filled that of RepairedMesh::closed.
  bool is_estimated = true;
  double repair_seconds = 0;  ///< includes the wraps
};

/// Memory that enclosing_hulls takes for each face of a large clean mesh, about, in bytes, beside the mesh that it is
/// given. Defects, wraps and tight hulls take more.
constexpr double kHullBytesPerFace = 260;

/// The first step of enclosing_hulls: repairs the triangles. If `closed` is empty in the result, or with Repair::Wrap,
/// hulls would be built from wraps or the convex hull. Throws InputError where enclosing_hulls would refuse these
/// triangles.
RepairedMesh prepared_for_hulls(TriangleMesh triangles, const EnclosingOptions& options = {});

/// Builds hulls of any triangles, one for each of `target_faces`: a hull has at most so many faces where that is
/// possible, and encloses every finite triangle of the input, triangles without area included. (HullSide::Inner: the
/// input, which must be closed, encloses the hull.)
///
/// Guaranteed: `certified` is decided exactly, on the coordinates returned, by verify_hull and verify_cover. With
/// options.hull.float32_coordinates these are float32 numbers.
///
/// Throws InputError if no triangle is finite, if options are outside their range or contradict each other, if the
/// hull is an inner one and the input cannot be closed, and if its void is bounded and the input encloses no volume;
/// Cancelled.
///
///   const std::size_t budgets[]{1000, 100};
///   const EnclosingHulls made = enclosing_hulls(read_mesh("part.stl"), budgets);
///   if (made.hulls[1].certified) write_mesh("coarse.ply", made.hulls[1].mesh);
///
/// How it works: hulls are built from up to three sources, and the best is taken.
///  1. The repaired input, with caps on its openings, if that closes it. Where few triangles are left uncovered, as
///  those
///     of folds, vertices of the hull are lifted over them. Where that does not help, the folds of the input are
///     covered first: edges around them are collapsed. Where the hull has much void, its vertices move back towards
///     the triangles in the end.
///  2. The convex hull of the input.
///  3. Wraps, whose grid fits the number of faces. The vertices of such a hull, and of one of the convex hull, move
///     back, too.
/// A source is left out if it cannot win: the second if the convex hull is larger than the best hull, the third if the
/// best hull is nearly as small as the solid. With `bounds` the first is always tried, as levels, and by collapses each
/// of which keeps HullBounds::max_distance (HullOptions::tolerances). Wraps have a spacing of half of that, or less; of
/// two thirds, where it is below 1/200 of the diagonal: then only collapses are tried that keep it. The best
/// hull within such a bound is measured and moved towards the triangles, and has further collapses. What counts is the
/// certificate first, then the number of faces, the bounds, the overhang (ShapeGuards::max_overhang), and the volume; a
/// hull that intersects itself has to have less than ten elevenths of the void of one that does not.
EnclosingHulls enclosing_hulls(TriangleMesh triangles, std::span<const std::size_t> target_faces,
                               const EnclosingOptions& options = {});

/// What `hull`, one of `made.hulls`, had to cover: the finite triangles of the input, the caps of its openings, and the
/// doors of the wrap that the hull was built from. Distances of the hull are measured from these.
TriangleMesh triangles_to_cover(const EnclosingHulls& made, const EnclosingHull& hull);

/// What the finest level of `hull`, one of `made.hulls`, is: for ProgressiveHull::with_finest_level.
FinestLevel finest_level(const EnclosingHulls& made, const EnclosingHull& hull);

/// Builds one hull, as enclosing_hulls does for one number of faces.
///
///   const EnclosingHull hull = enclosing_hull(read_mesh("part.stl"), 500);
///   if (hull.certified) write_mesh("hull.ply", hull.mesh);
EnclosingHull enclosing_hull(TriangleMesh triangles, std::size_t target_faces, const EnclosingOptions& options = {});

}  // namespace prohull
