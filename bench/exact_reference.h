#pragma once

#include <span>
#include <vector>

#include "prohull/triangle_mesh.h"

namespace prohull::bench {

/// A face that a segment crosses.
struct ExactCrossing {
  FaceId face;
  bool entering;
  std::size_t place;  ///< counts the places along the segment; equal for faces that are crossed at one place
  double t;           ///< rounded
};

/// The crossings of segments and a mesh, by definition: the segment is moved by (e, e^2, e^3) for an infinitesimal e.
/// Shares no code with the queries of the library. Signs are those of polynomials in e with integer coefficients, where
/// rounded determinants and their error bounds do not tell. Coordinates between 2^-320 and 2^320, or 0.
class ExactReference {
 public:
  explicit ExactReference(const TriangleMesh& mesh);

  /// In the order in which the segment passes them.
  std::vector<ExactCrossing> crossings(const Segment& segment) const;

  /// The same for each, by all cores.
  std::vector<std::vector<ExactCrossing>> crossings(std::span<const Segment> segments) const;

 private:
  /// Faces, or boxes of the level below, that one box holds.
  static constexpr std::size_t kPerBox = 8;

  void add_candidates(const Segment& segment, std::size_t level, std::size_t i, std::vector<FaceId>& found) const;

  const TriangleMesh& mesh_;
  std::vector<FaceId> order_;             ///< of the faces: neighbours in space are neighbours here
  std::vector<std::vector<Box>> levels_;  ///< first of single faces, in that order, then of eights, and so on
};

}  // namespace prohull::bench
