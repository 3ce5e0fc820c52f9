#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "prohull/triangle_mesh.h"

namespace prohull::bench {

struct PeerHit {
  FaceId face;
  double t;  ///< fraction of the way from a to b
};

/// Segments made ready to be asked several at a time.
class PeerPackets {
 public:
  virtual ~PeerPackets() = default;
  // How many segments hit.
  virtual std::size_t first_hits() = 0;
  virtual std::size_t any_hits() = 0;
};

/// Another library's tree over the faces of a mesh.
class QueryPeer {
 public:
  virtual ~QueryPeer() = default;
  virtual std::optional<PeerHit> first_hit(const Segment& segment) = 0;
  virtual bool any_hit(const Segment& segment) = 0;
  /// Every crossing; Embree's in the order in which the segment passes them. Valid until the next call.
  virtual std::span<const PeerHit> all_hits(const Segment& segment) = 0;
  /// Whether the point is inside of a closed mesh: the parity of the crossings of a ray. Nothing if that was not built.
  virtual std::optional<bool> contains(const Vec3&) { return std::nullopt; }
  /// From the nearest face. Nothing if that was not built.
  virtual std::optional<double> distance(const Vec3&) { return std::nullopt; }
  /// By `width` segments, 8 or 16; coherent: neighbours take nearly the same way. Null if the library has no packets.
  virtual std::unique_ptr<PeerPackets> packets(std::span<const Segment>, std::size_t, bool) { return nullptr; }
  /// Of the tree, without the mesh; 0 if the library does not say.
  virtual std::size_t memory_bytes() const { return 0; }
};

/// CGAL's AABB tree with exact predicates (GPL). Null if it was not built.
std::unique_ptr<QueryPeer> make_cgal_tree(const TriangleMesh& mesh);

/// Embree's own tree and intersection of triangles, in float32; robust: with RTC_SCENE_FLAG_ROBUST. The tree is built
/// by `threads` threads. Null if it was not built.
std::unique_ptr<QueryPeer> make_embree(const TriangleMesh& mesh, bool robust, unsigned threads = 1);

}  // namespace prohull::bench
