#pragma once

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <optional>

#include "prohull/mesh_query.h"
#include "prohull/triangle_mesh.h"

namespace prohull::cover {

/// How deep points lie in a solid. Any thread may ask.
class Depth {
 public:
  /// `solid` is closed, and no point of its surface is farther than `slack` from the triangles that balls are to be
  /// near. `sheets` are triangles of these that `solid` does not have; they may be none.
  Depth(TriangleMesh solid, double slack, TriangleMesh sheets);

  /// A ball around p reaches out of the solid, and from the sheets, by no more than its radius minus this. It is
  /// negative outside.
  double at(const Vec3& p) const;

  /// The same of the solid alone, whatever the slack.
  double in_solid(const Vec3& p) const;

  /// A point in the solid whose ball of the solid's depth touches the surface near p, but for `tolerance`: a point near
  /// the medial axis. Nothing if the solid has no thickness there.
  std::optional<Vec3> medial_point(const Vec3& p, double tolerance) const;

  /// The direction in which the depth grows fastest, of length 1, or 0 on the surface.
  Vec3 inwards(const Vec3& p) const;

 private:
  Vec3 normal_of(FaceId face) const;

  TriangleMesh solid_;
  double slack_, unit_;  ///< a power of two near the solid's size
  mutable oneapi::tbb::enumerable_thread_specific<MeshQuery> query_;
  mutable std::optional<oneapi::tbb::enumerable_thread_specific<MeshQuery>> sheets_;
};

}  // namespace prohull::cover
