#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "prohull/collide.h"
#include "prohull/convex_cover.h"
#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"
#include "prohull/verdict.h"

namespace prohull {

/// A rigid motion over time, from 0 to 1. The body begins in a pose and turns at a constant rate about an axis, while
/// the axis goes straight. Positive angles are right-handed.
struct RigidMotion {
  Pose start = {};
  Vec3 through = {};   ///< a point of the axis at the beginning
  Vec3 axis{0, 0, 1};  ///< of any length but 0
  double angle = 0;    ///< radians
  Vec3 shift = {};     ///< of the axis, from beginning to end
};

struct SweepOptions {
  std::size_t max_pieces = 16;  ///< convex pieces that the mesh is covered by: ConvexCoverOptions
  /// How far the slices of the motion may add to the reach of these pieces, in the input's unit. The motion is divided
  /// into as many slices as that takes. 0: 2 % of the diagonal of the mesh.
  double max_distance = 0;
  bool float32_coordinates = false;  ///< of the vertices of the pieces, as in HullOptions
  unsigned threads = 0;              ///< 0: one for each core; the sweep is the same for any number
  Progress progress = {};            ///< stages of convex_cover, then "sweep"
};

/// More convex pieces than that, one for each slice of each piece of the mesh, are refused.
inline constexpr std::size_t kMostSweptPieces = 50'000;

struct Sweep {
  std::vector<TriangleMesh> pieces;  ///< convex polytopes: closed, outwards, no vertex outside of a face's plane
  /// Of all positions of the mesh, or of polytopes, together: what ConvexCover proves of one. Distances are of points
  /// of the pieces' surfaces from all positions.
  Verdict verdict;
  bool fills_cavities = false;     ///< the mesh has cavities, which count as filled
  double volume = 0;               ///< of the union of the pieces, overlaps counted once: an estimate,
  double volume_error = 0;         ///< and its standard error; 0 of a single piece
  std::size_t cover_pieces = 0;    ///< convex pieces of the mesh
  std::vector<std::string> notes;  ///< sentences for the user
  double seconds = 0;
};

/// Encloses all positions of a mesh along motions, one after the other, by convex pieces.
///
/// Guaranteed: each position of each finite triangle lies in the union of the pieces, at every moment of the motions,
/// in real numbers; and so does the inside where `verdict` says so. Rounding is part of the bounds. `notes` tell
/// how many triangles are not finite.
///
/// Throws InputError as convex_cover; NonFiniteCoordinate for a motion that is not finite or goes beyond 1e100;
/// InvalidOption for an axis of length 0, no motion, and motions that take more than kMostSweptPieces; Cancelled.
///
///     const RigidMotion quarter{.axis = {0, 0, 1}, .angle = std::numbers::pi / 2};
///     const Sweep door = sweep(read_mesh("door.stl"), {{quarter}});
///
/// How it works: The mesh is covered by convex pieces, and this cover is proven (convex_cover). In a slice, in which
/// the body turns by an angle, each vertex of a piece goes along an arc. The arc lies in the triangle of its two ends
/// and the point where the tangents meet there. So the convex hull of these points encloses the piece all along.
Sweep sweep(TriangleMesh mesh, std::span<const RigidMotion> motions, const SweepOptions& options = {});

/// Encloses all positions of the union of convex polytopes, which are closed, look outwards and have finite vertices:
/// as above, but without a cover. Throws EmptyMesh if there is none.
Sweep sweep(std::span<const TriangleMesh> polytopes, std::span<const RigidMotion> motions,
            const SweepOptions& options = {});

/// A convex polytope that encloses all points within `distance` of the convex hull of the points, which are finite and
/// not all the same: proven, with its vertices as they are. It reaches out by at most `growth`.
struct EnclosingPolytope {
  TriangleMesh mesh;
  double growth = 0;
};
EnclosingPolytope polytope_around(std::vector<Vec3> points, double distance, bool float32_coordinates);

}  // namespace prohull
