#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "prohull/triangle_mesh.h"

namespace prohull::bench {

struct PeerHit {
  FaceId face;
  double t;  ///< fraction of the way from a to b
};

/// Another library's tree over the faces of a mesh.
class QueryPeer {
 public:
  virtual ~QueryPeer() = default;
  virtual std::optional<PeerHit> first_hit(const Segment& segment) = 0;
  virtual bool any_hit(const Segment& segment) = 0;
  /// How many crossings; nothing if the library does not say in one call.
  virtual std::optional<std::size_t> all_hits(const Segment& segment) = 0;
};

/// CGAL's AABB tree with exact predicates (GPL). Null if it was not built.
std::unique_ptr<QueryPeer> make_cgal_tree(const TriangleMesh& mesh);

/// Embree's own tree and intersection of triangles, in float32; robust: with RTC_SCENE_FLAG_ROBUST. Null if it was not
/// built.
std::unique_ptr<QueryPeer> make_embree(const TriangleMesh& mesh, bool robust);

}  // namespace prohull::bench
