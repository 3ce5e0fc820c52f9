#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/bvh.h"
#include "prohull/progress.h"
#include "prohull/triangle_mesh.h"
#include "prohull/verification.h"

namespace prohull::verify {

/// The points of a piece that no face's plane has outside. Of a convex piece that is all of it.
///
/// Why these points are covered: let p lie strictly inside of all planes of a closed mesh. Then p sees all faces from
/// inside, the solid angles under which it sees them add up to a positive multiple of 4 pi, and the mesh winds around p
/// at least once. On the way from p to anywhere else all faces are crossed outwards, so that the mesh winds around no
/// point a negative number of times. Such points are a convex set; if there is one, all points that lie inside of all
/// planes, or on them, lie in its closure.
class Kernel {
 public:
  /// Of a closed mesh that is turned outwards.
  explicit Kernel(const TriangleMesh& piece);

  /// False if no point strictly inside of all planes was found, or if there are too many planes; then no point counts
  /// as contained.
  bool is_solid() const { return is_solid_; }
  const Box& box() const { return box_; }
  const std::vector<Triangle>& faces() const { return faces_; }
  /// Exact.
  bool contains(const Vec3& p) const;
  /// Whether the kernel is solid and all of the piece: no corner of it is outside of a plane. Exact.
  bool is_whole_piece() const { return is_whole_piece_; }

 private:
  std::vector<Triangle> faces_;  ///< those with an area
  Box box_;                      ///< of the piece
  bool is_solid_ = false, is_whole_piece_ = false;
};

/// The pieces of a union, fit for the addition of winding numbers.
struct Pieces {
  std::vector<TriangleMesh> meshes;  ///< closed, turned outwards, winding nowhere a negative number of times
  std::vector<Kernel> kernels;       ///< of each
  Bvh bvh;                           ///< of the kernels' boxes
  std::size_t turned = 0;            ///< how many looked inwards
  bool are_sure = true;              ///< else it is not known that none winds a negative number of times

  /// All as one mesh: the union is where it winds at least once.
  TriangleMesh together() const;
  /// The kernels of pieces near a box, but for one piece.
  std::vector<const Kernel*> near(const Box& box, std::optional<std::size_t> except = {}) const;
};

/// Throws InputError, with the number of the piece from 1 on, if there is none, or if one is empty, not finite, not
/// closed, or winds around some point a negative number of times. Whether it does is not known where that would take
/// more than most_steps(options, ...). Cancelled.
Pieces prepare_pieces(std::span<const TriangleMesh> pieces, const VerificationOptions& options,
                      const Progress& progress);

/// The triangles that do not lie in one kernel; all others are covered. Exact.
std::vector<FaceId> faces_beyond_kernels(const TriangleMesh& mesh, const Pieces& pieces);

}  // namespace prohull::verify
