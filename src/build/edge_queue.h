#pragma once

#include <bit>
#include <cassert>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "mesh/half_edge_mesh.h"

namespace prohull {

// Three priority queues of edges with one interface. Keys are >= 0; the least comes first; equal keys are ordered by
// edge (Heap, RedBlackTree) or by age (Bucket).

/// A binary heap that knows where each edge is.
class EdgeHeap {
 public:
  explicit EdgeHeap(std::size_t edges) : key_(edges), place_(edges, kNowhere) {}

  bool empty() const { return heap_.empty(); }
  bool contains(EdgeId e) const { return place_[e] != kNowhere; }
  bool precedes_all(double key) const { return heap_.empty() || key <= key_[heap_.front()]; }

  void insert(EdgeId e, double key) {
    assert(!contains(e));
    key_[e] = key;
    heap_.push_back(e);
    place_[e] = static_cast<std::uint32_t>(heap_.size() - 1);
    sift_up(place_[e]);
  }
  void erase(EdgeId e) {
    const std::uint32_t i = place_[e];
    place_[e] = kNowhere;
    const EdgeId last = heap_.back();
    heap_.pop_back();
    if (last == e) return;
    put(i, last);
    sift_up(i);
    sift_down(place_[last]);
  }
  EdgeId pop() {
    const EdgeId e = heap_.front();
    erase(e);
    return e;
  }

 private:
  static constexpr std::uint32_t kNowhere = 0xffffffff;

  bool before(EdgeId a, EdgeId b) const { return std::pair(key_[a], a) < std::pair(key_[b], b); }
  void put(std::uint32_t i, EdgeId e) { heap_[i] = e, place_[e] = i; }
  void sift_up(std::uint32_t i) {
    const EdgeId e = heap_[i];
    for (; i > 0 && before(e, heap_[(i - 1) / 2]); i = (i - 1) / 2) put(i, heap_[(i - 1) / 2]);
    put(i, e);
  }
  void sift_down(std::uint32_t i) {
    const EdgeId e = heap_[i];
    while (2 * i + 1 < heap_.size()) {
      std::uint32_t child = 2 * i + 1;
      if (child + 1 < heap_.size() && before(heap_[child + 1], heap_[child])) ++child;
      if (!before(heap_[child], e)) break;
      put(i, heap_[child]);
      i = child;
    }
    put(i, e);
  }

  PerEdge<double> key_;
  PerEdge<std::uint32_t> place_;
  std::vector<EdgeId> heap_;
};

/// The paper's choice: std::set is a red-black tree.
class EdgeTree {
 public:
  explicit EdgeTree(std::size_t edges) : key_(edges), queued_(edges, 0) {}

  bool empty() const { return tree_.empty(); }
  bool contains(EdgeId e) const { return queued_[e] != 0; }
  bool precedes_all(double key) const { return tree_.empty() || key <= tree_.begin()->first; }

  void insert(EdgeId e, double key) {
    assert(!contains(e));
    key_[e] = key;
    queued_[e] = 1;
    tree_.emplace(key, e);
  }
  void erase(EdgeId e) {
    queued_[e] = 0;
    tree_.erase({key_[e], e});
  }
  EdgeId pop() {
    const EdgeId e = tree_.begin()->second;
    erase(e);
    return e;
  }

 private:
  PerEdge<double> key_;
  PerEdge<std::uint8_t> queued_;
  std::set<std::pair<double, EdgeId>> tree_;
};

/// Eight buckets to an octave, first in first out within each: all operations take constant time.
class EdgeBuckets {
 public:
  explicit EdgeBuckets(std::size_t edges)
      : next_(edges, kNone),
        previous_(edges, kNone),
        bucket_(edges, kNotQueued),
        first_(kBuckets, kNone),
        last_(kBuckets, kNone) {}

  bool empty() const { return size_ == 0; }
  bool contains(EdgeId e) const { return bucket_[e] != kNotQueued; }
  bool precedes_all(double key) const { return empty() || bucket_of(key) <= least(); }

  void insert(EdgeId e, double key) {
    assert(!contains(e));
    const std::uint16_t b = bucket_of(key);
    bucket_[e] = b;
    next_[e] = kNone;
    previous_[e] = last_[b];
    (last_[b] == kNone ? first_[b] : next_[last_[b]]) = e;
    last_[b] = e;
    if (b < least_) least_ = b;
    ++size_;
  }
  void erase(EdgeId e) {
    const std::uint16_t b = bucket_[e];
    (previous_[e] == kNone ? first_[b] : next_[previous_[e]]) = next_[e];
    (next_[e] == kNone ? last_[b] : previous_[next_[e]]) = previous_[e];
    bucket_[e] = kNotQueued;
    --size_;
  }
  EdgeId pop() {
    const EdgeId e = first_[least()];
    erase(e);
    return e;
  }

 private:
  static constexpr EdgeId kNone{0xffffffff};
  static constexpr std::size_t kBuckets = 1 << 14;
  static constexpr std::uint16_t kNotQueued = 0xffff;

  // The exponent of a non-negative double and the first three bits of its mantissa, which are in the order of the
  // values.
  static std::uint16_t bucket_of(double key) {
    assert(key >= 0);
    return static_cast<std::uint16_t>(std::bit_cast<std::uint64_t>(key + 0.0) >> 49);
  }
  std::uint16_t least() const {
    while (first_[least_] == kNone) ++least_;
    return least_;
  }

  PerEdge<EdgeId> next_, previous_;
  PerEdge<std::uint16_t> bucket_;
  std::vector<EdgeId> first_, last_;
  mutable std::uint16_t least_ = kBuckets - 1;  ///< no bucket before it holds an edge
  std::size_t size_ = 0;
};

}  // namespace prohull
