#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/half_edge_mesh.h"

namespace prohull {

/// The half-edges 3f, 3f + 1 and 3f + 2 of faces f, sorted by their tails in linear time. `tail(h)` is kNoVertex for
/// those that are not there.
template <class Tail>
class HalfEdgesByTail {
 public:
  HalfEdgesByTail(std::size_t vertices, std::size_t half_edges, Tail tail) : tail_(tail), first_(vertices + 1, 0) {
    const auto count = static_cast<std::uint32_t>(half_edges);
    for (std::uint32_t h = 0; h < count; ++h)
      if (const VertexId v = tail_(HalfEdgeId{h}); v != kNoVertex) ++first_[index(v) + 1];
    for (std::size_t v = 0; v < vertices; ++v) first_[v + 1] += first_[v];
    by_tail_.resize(first_.back());
    std::vector<std::uint32_t> cursor(first_.begin(), first_.end() - 1);
    for (std::uint32_t h = 0; h < count; ++h)
      if (const VertexId v = tail_(HalfEdgeId{h}); v != kNoVertex) by_tail_[cursor[index(v)]++] = HalfEdgeId{h};
  }

  std::span<const HalfEdgeId> leaving(VertexId v) const {
    return {by_tail_.data() + first_[index(v)], first_[index(v) + 1] - first_[index(v)]};
  }

  /// The first one from `tail` to `tip`, or kNoHalfEdge. It is looked for around the end with fewer faces, so that
  /// vertices with very many do not cost more.
  HalfEdgeId between(VertexId tail, VertexId tip) const {
    const auto from_tail = leaving(tail), from_tip = leaving(tip);
    if (from_tail.size() <= from_tip.size()) {
      for (const HalfEdgeId h : from_tail)
        if (tail_(HalfEdgeMesh::next(h)) == tip) return h;
    } else {
      for (const HalfEdgeId h : from_tip)
        if (const HalfEdgeId before = HalfEdgeMesh::previous(h); tail_(before) == tail) return before;
    }
    return kNoHalfEdge;
  }

 private:
  Tail tail_;
  std::vector<std::uint32_t> first_;  ///< of each vertex, in by_tail_
  std::vector<HalfEdgeId> by_tail_;
};

}  // namespace prohull
