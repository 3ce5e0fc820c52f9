#pragma once

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <optional>
#include <span>

#include "prohull/detail/progress_meter.h"
#include "prohull/mesh_query.h"
#include "prohull/triangle_mesh.h"

namespace prohull::cover {

/// A place for a ball.
struct Place {
  Vec3 center;
  double depth = 0;   ///< a ball reaches out of the solid, and from the sheets, by no more than its radius minus this
  Vec3 foot = {};     ///< the point of the solid's surface that is closest
  Vec3 inwards = {};  ///< where the depth in the solid grows fastest; of length 1, or 0 on the surface
};

/// How deep points lie in a solid. Any thread may ask.
class Depth {
 public:
  /// `solid` is closed, and no point of its surface is farther than `slack` from the triangles that balls are to be
  /// near. `sheets` are triangles of these that `solid` does not have; they may be none.
  Depth(const TriangleMesh& solid, double slack, TriangleMesh sheets, ProgressMeter& meter);

  /// The depth is negative outside.
  Place at(const Vec3& p) const;

  /// The depth in the solid alone, whatever the slack.
  double in_solid(const Vec3& p) const;

  /// A bound of the depth at p that takes no search. `feet` are those of any places.
  double most_at(const Vec3& p, std::span<const Vec3> feet) const;

  /// A place in the solid whose ball of the solid's depth touches the surface near p, but for `tolerance`: one near the
  /// medial axis. Nothing if the solid has no thickness there, or is elsewhere.
  std::optional<Place> medial_place(const Vec3& p, double tolerance) const;

 private:
  Place place(const Vec3& p, const ClosestPoint& surface, bool is_inside) const;
  bool is_inside(const Vec3& p) const;

  TriangleMesh faces_;   ///< of the solid's surface
  double slack_, unit_;  ///< a power of two near the solid's size
  double foot_error_;    ///< of a foot from the surface
  using Queries = oneapi::tbb::enumerable_thread_specific<MeshQuery>;
  mutable Queries inside_, surface_;
  mutable std::optional<Queries> sheets_;
};

}  // namespace prohull::cover
