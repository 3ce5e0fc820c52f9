#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "prohull/detail/shapes.h"
#include "prohull/distance.h"
#include "prohull/triangle_mesh.h"
#include "prohull/verification.h"

namespace prohull {

/// A point of a face: the sum of the corners, each times its weight, exactly.
struct PointOfFace {
  FaceId face{};
  std::array<double, 3> weights{};
};

/// What verify_union has found. Volumes and distances are in the input's unit.
struct UnionVerification : Verdict {
  std::size_t faces_outside = 0;  ///< triangles of the original of which a part lies outside of all pieces; exact
  std::vector<Offender> worst;    ///< the farthest of these, farthest first
  /// Connected parts of the union's surface that leave a hole in the solid; looked for only if faces_outside is 0.
  std::size_t holes = 0;
  /// Of balls: a point of a triangle that no ball holds, if one was found. Exact.
  std::optional<PointOfFace> point_outside;
  /// Triangles of which neither was found out, whether all of them is covered nor a point that is not.
  std::size_t faces_undecided = 0;
  std::vector<Offender> undecided;  ///< of these, a point in doubt; max_offenders at most, of distance 0
  bool inside_undecided = false;    ///< whether it is not known that the pieces or balls leave no hole in the solid
  std::size_t turned_pieces = 0;    ///< pieces that were inside out and count as turned
  double union_volume = std::numeric_limits<double>::quiet_NaN();     ///< overlaps count once; rounded
  double original_volume = std::numeric_limits<double>::quiet_NaN();  ///< NaN if the original is not closed
  double void_ratio = std::numeric_limits<double>::quiet_NaN();       ///< union_volume / original_volume - 1
  std::vector<std::string> notes;                                     ///< sentences for the user
};

/// Decides whether the union of pieces covers every triangle of the original and, if that is closed, its inside.
/// Guaranteed: the verdict is exact. Pieces may touch, share walls and overlap. They need not be convex, but most of
/// the work is faster where they are. With options.solid_only only the solid of a closed original must be covered.
///
/// Throws InputError if there is no piece, if a piece is not closed, not finite or not a solid (the message has its
/// number, from 1 on), if the original is empty; Cancelled. A piece that looks inwards counts as turned, and triangles
/// of the original that are not finite are left out; `turned_pieces` and `notes` tell. The volume is NaN if a piece is
/// not convex.
///
///     const UnionVerification found = verify_union(pieces, read_mesh("part.stl"));
///     if (!found.certified) std::cout << found.why_not;
UnionVerification verify_union(std::span<const TriangleMesh> pieces, TriangleMesh original,
                               const VerificationOptions& options = {});

/// The same for balls. Every triangle must be covered and, if `inside`, the solid of a closed original; with
/// options.solid_only that solid alone. `holes` is at most 1: the search for one ends at the first.
/// Guaranteed: yes is exact, for the balls with the doubles given, and so is every triangle that counts as outside, and
/// every hole. Undecided is what the balls cover with less than about 1e-9 of the diagonal to spare, if at all, and
/// what would take more than a million parts of one triangle, four million cubes of the inside, or options.max_steps;
/// then the answer is no. Balls may touch corners of the original, and each other in the middles of edges, with nothing
/// to spare.
UnionVerification verify_union(std::span<const Ball> balls, TriangleMesh original, bool inside,
                               const VerificationOptions& options = {});

/// How far the union reaches out of `original`: bounds of the greatest distance from a point of the pieces' surfaces to
/// the triangles. Points inside of the solid of a closed original count as 0, and so do points in its cavities. If the
/// original is not closed, points of the union's surface count, and none within other pieces, unless one of the pieces
/// is not convex; gaps between pieces that are narrower than about 1e-9 of these are closed. The search ends when the
/// bounds differ by options.relative_gap, or by 1e-4 of the diagonal. Throws InputError if the original is empty or not
/// finite; Cancelled.
DistanceBounds union_reach(std::span<const TriangleMesh> pieces, const TriangleMesh& original,
                           const DistanceOptions& options = {});
DistanceBounds union_reach(std::span<const Ball> balls, const TriangleMesh& original,
                           const DistanceOptions& options = {});

/// Of the union; overlaps count once. Rounded: correct to about 1e-6 of it. Pieces are convex, closed and outwards.
double union_volume(std::span<const TriangleMesh> pieces);
double union_volume(std::span<const Ball> balls);

}  // namespace prohull
