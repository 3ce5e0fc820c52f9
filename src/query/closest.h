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
  ClosestCollector(const TriangleMesh& mesh, const Vec3& point, double max_distance)
      : mesh_(mesh), point_(point), limit_(max_distance) {}

  /// `triangle` is that of the face.
  void offer(FaceId face, const Triangle& triangle);
  void offer_all();

  const Vec3& point() const { return point_; }
  /// Faces that are certainly farther away are not of interest.
  double limit() const { return limit_; }
  std::optional<ClosestPoint> best() const;

 private:
  const TriangleMesh& mesh_;
  Vec3 point_;
  double limit_;
  double lower_ = std::numeric_limits<double>::infinity();
  std::optional<ClosestPoint> best_;
};

}  // namespace prohull
