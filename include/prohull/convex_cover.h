#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "prohull/detail/names.h"
#include "prohull/detail/shapes.h"
#include "prohull/distance.h"
#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"
#include "prohull/verdict.h"

namespace prohull {

/// What a piece of a convex cover may be.
enum class PieceShape { Polytope, Box, Capsule, Ball };

/// "polytope", "box", "capsule", "sphere"
Names<PieceShape> piece_shape_names();

struct ConvexCoverOptions {
  std::size_t max_pieces = 16;    ///< at least 1
  std::size_t max_vertices = 64;  ///< of a piece; at least 4
  /// How far the union may reach (Verdict::distance), and how large it may be. With bounds the cover has as few pieces
  /// as keep them, at most max_pieces.
  HullBounds bounds = {};
  /// With any other shape than Polytope, pieces take that shape where `bounds` allow it: all, if there are none.
  PieceShape shape = PieceShape::Polytope;
  bool float32_coordinates = false;  ///< of the vertices of the pieces, as in HullOptions
  bool boxes_as_meshes = true;       ///< false: boxes themselves are written, and their meshes need no float32
  unsigned threads = 0;              ///< 0: one for each core; the cover is the same for any number
  Progress progress = {};            ///< stages of enclosing_hulls, then "cut", "fit" and "verify"
};

/// A convex piece.
struct ConvexPiece {
  TriangleMesh
      mesh;  ///< a convex polytope: closed, outwards, no vertex outside of a face's plane; of a box its own mesh
  /// A capsule or sphere around the mesh, or the box; none if the piece is the mesh itself.
  std::variant<std::monostate, OrientedBox, Capsule, Ball> primitive = {};
};

/// The volume of the capsule, sphere or box of the piece, or of its mesh if it has none of these.
double volume_of(const ConvexPiece& piece);

struct ConvexCover {
  std::vector<ConvexPiece> pieces;
  /// Of the meshes of the pieces, by verify_union. Where the input is not closed, but can be (repaired_mesh), its solid
  /// is the closed mesh. Cavities of the solid count as full in distances.
  Verdict verdict;
  double volume = 0;  ///< of the union; overlaps count once
  /// The volume is not greater: it is that of polytopes around capsules, or around spheres beside other pieces.
  /// Distances are always theirs.
  bool volume_is_bound = false;
  double original_volume = 0;   ///< as EnclosingHulls::volume; 0 if it is not known
  bool is_estimated = false;    ///< `original_volume` is an estimate
  double void_ratio = 0;        ///< volume / original_volume - 1; infinite if the triangles have no volume
  bool fills_cavities = false;  ///< the input has cavities, which count as filled: distances are not from them
  bool within_bounds = true;
  std::vector<std::string> notes;  ///< sentences for the user
  double seconds = 0, verify_seconds = 0;
};

/// Covers triangles by a few convex pieces. Guaranteed: `verdict` is decided exactly, on the coordinates returned, by
/// code that shares nothing with the search. Every finite triangle is covered, and the inside too where the triangles
/// bound a solid, or bound one with their openings closed (repaired_mesh).
///
/// Throws InputError if no triangle is finite, for options outside of their range, and if the void is bounded and the
/// input encloses no volume; Cancelled.
///
///     const ConvexCover cover = convex_cover(read_mesh("horse.ply"), {.max_pieces = 32});
ConvexCover convex_cover(TriangleMesh triangles, const ConvexCoverOptions& options = {});

}  // namespace prohull
