#pragma once

#include <span>
#include <vector>

#include "prohull/mesh_query.h"

namespace prohull::bench {

/// Exact answers that owe nothing to a tree: every face is looked at for every segment. Most are certainly missed by
/// the line, as a few rounded products tell; the others are asked by Engine::Brute.
class ExhaustiveScan {
 public:
  explicit ExhaustiveScan(const TriangleMesh& mesh);

  /// Every crossing, in the order in which the segment passes them.
  std::vector<Hit> all_hits(const Segment& segment) const;

  /// The same for each, by all cores.
  std::vector<std::vector<Hit>> all_hits(std::span<const Segment> segments) const;

 private:
  using Float4 = float __attribute__((vector_size(16)));
  /// By their centre and half their size along each axis.
  struct FourBoxes {
    Float4 center[3], half[3];
  };
  class Line;

  static void set(FourBoxes& boxes, std::size_t lane, const Box& box);
  std::vector<FaceId> not_certainly_missed(const Segment& segment) const;

  const TriangleMesh& mesh_;
  Vec3 center_;
  double scale_;                  ///< (p - center) scale is in [-1, 1]^3 for points of the mesh, but for rounding
  FourBoxes around_{};            ///< lane 0: the whole mesh
  std::vector<FourBoxes> boxes_;  ///< of the faces
};

}  // namespace prohull::bench
