#pragma once

#include <limits>
#include <optional>

#include "prohull/mesh_query.h"

namespace prohull {

/// The distance of a face from a point; nothing if the box of the face is certainly farther away than `limit`.
std::optional<ClosestPoint> distance_to(FaceId face, const Triangle& triangle, const Vec3& point, double limit);

/// Takes the faces that an engine thinks may be closest to a point, and keeps what is asked: the face with the least
/// upper bound, of several the one with the lowest number. Which other faces an engine offers, and when, does not
/// change that; only the lower bound, which is the least of all faces that are not certainly farther, may be another.
class ClosestCollector {
 public:
  /// Requires the mesh to lie in the box.
  ClosestCollector(const TriangleMesh& mesh, const Box& box, const Vec3& point, double max_distance);

  /// `triangle` is that of the face.
  void offer(FaceId face, const Triangle& triangle);
  void offer_all();

  const Vec3& point() const { return point_; }
  /// Faces that are certainly farther away are not of interest.
  double limit() const { return limit_; }
  std::optional<ClosestPoint> best() const;

 private:
  bool is_certainly_farther(const Triangle& t) const;

  const TriangleMesh& mesh_;
  Vec3 point_;
  double limit_;
  double error_;  ///< of dot(away_, point - corner)
  Vec3 away_;     ///< from the closest point so far to the point; of length 1 but for rounding, or 0
  double lower_ = std::numeric_limits<double>::infinity();
  std::optional<ClosestPoint> best_;
};

}  // namespace prohull
