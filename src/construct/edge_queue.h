#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "mesh/half_edge_mesh.h"

namespace prohull {

// Three priority queues of edges with one interface. Priorities are >= 0; the least comes first; equal priorities are
// ordered by edge (Heap, RedBlackTree) or by age (Bucket).

/// A binary heap that knows where each edge is.
class EdgeHeap {
 public:
  explicit EdgeHeap(std::size_t edges) : priority_(edges), place_(edges, kNowhere) {}

  bool empty() const { return heap_.empty(); }
  bool contains(EdgeId e) const { return place_[e] != kNowhere; }
  bool precedes_all(double priority) const { return priority <= least(); }
  /// Infinity if there is none.
  double least() const { return heap_.empty() ? std::numeric_limits<double>::infinity() : priority_[heap_.front()]; }

  void insert(EdgeId e, double priority) {
    assert(!contains(e));
    priority_[e] = priority;
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

  bool before(EdgeId a, EdgeId b) const { return std::pair(priority_[a], a) < std::pair(priority_[b], b); }
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

  PerEdge<double> priority_;
  PerEdge<std::uint32_t> place_;
  std::vector<EdgeId> heap_;
};

/// The paper's choice: std::set is a red-black tree.
class EdgeTree {
 public:
  explicit EdgeTree(std::size_t edges) : priority_(edges), queued_(edges, 0) {}

  bool empty() const { return tree_.empty(); }
  bool contains(EdgeId e) const { return queued_[e] != 0; }
  bool precedes_all(double priority) const { return tree_.empty() || priority <= tree_.begin()->first; }

  void insert(EdgeId e, double priority) {
    assert(!contains(e));
    priority_[e] = priority;
    queued_[e] = 1;
    tree_.emplace(priority, e);
  }
  void erase(EdgeId e) {
    queued_[e] = 0;
    tree_.erase({priority_[e], e});
  }
  EdgeId pop() {
    const EdgeId e = tree_.begin()->second;
    erase(e);
    return e;
  }

 private:
  PerEdge<double> priority_;
  PerEdge<std::uint8_t> queued_;
  std::set<std::pair<double, EdgeId>> tree_;
};

/// Eight buckets to an octave, first in first out within each: all operations take constant time. A bucket is an array
/// in which erased edges leave their entries behind. Priorities mostly span few of the many octaves: buckets are made
/// in pages.
class EdgeBuckets {
 public:
  explicit EdgeBuckets(std::size_t edges) : places_(edges) {}

  bool empty() const { return size_ == 0; }
  bool contains(EdgeId e) const { return places_[e].bucket != kNotQueued; }
  bool precedes_all(double priority) { return empty() || bucket_of(priority) <= least(); }

  void insert(EdgeId e, double priority) {
    assert(!contains(e));
    const std::uint16_t b = bucket_of(priority);
    auto& page = pages_[b / kPage];
    if (!page) page = std::make_unique<Page>();
    std::vector<EdgeId>& entries = bucket(b).entries;
    places_[e] = {static_cast<std::uint32_t>(entries.size()), b};
    entries.push_back(e);
    if (b < least_) least_ = b;
    ++size_;
  }
  void erase(EdgeId e) {
    places_[e].bucket = kNotQueued;
    --size_;
    if (++left_behind_ > kRoom + size_) remove_left_behind();
  }
  EdgeId pop() {
    Bucket& first = bucket(least());
    const EdgeId e = first.entries[first.first++];
    places_[e].bucket = kNotQueued;
    --size_;
    return e;
  }

 private:
  static constexpr std::size_t kBuckets = 1 << 14, kPage = 1 << 7, kRoom = 1 << 16;
  static constexpr std::uint16_t kNotQueued = 0xffff;

  struct Place {
    std::uint32_t entry = 0;
    std::uint16_t bucket = kNotQueued;
  };
  struct Bucket {
    std::vector<EdgeId> entries;
    std::size_t first = 0;  ///< those before are gone
  };
  using Page = std::array<Bucket, kPage>;

  Bucket& bucket(std::uint16_t b) { return (*pages_[b / kPage])[b % kPage]; }

  // The exponent of a non-negative double and the first three bits of its mantissa, which are in the order of the
  // values.
  static std::uint16_t bucket_of(double priority) {
    assert(priority >= 0);
    return static_cast<std::uint16_t>(std::bit_cast<std::uint64_t>(priority + 0.0) >> 49);
  }
  bool is_queued(std::uint16_t b, std::size_t entry) {
    const Place& place = places_[bucket(b).entries[entry]];
    return place.bucket == b && place.entry == entry;
  }
  // The first bucket with an edge, its first entry that of an edge.
  std::uint16_t least() {
    while (true) {
      if (!pages_[least_ / kPage]) {
        least_ = static_cast<std::uint16_t>((least_ / kPage + 1) * kPage);
        continue;
      }
      Bucket& at = bucket(least_);
      for (; at.first < at.entries.size(); ++at.first, --left_behind_)
        if (is_queued(least_, at.first)) return least_;
      at = {};
      ++least_;
    }
  }
  void remove_left_behind() {
    for (std::uint16_t b = least_; b < kBuckets; ++b) {
      if (!pages_[b / kPage]) continue;
      Bucket& at = bucket(b);
      std::uint32_t kept = 0;
      for (std::size_t i = at.first; i < at.entries.size(); ++i) {
        if (!is_queued(b, i)) continue;
        const EdgeId e = at.entries[i];
        at.entries[kept] = e;
        places_[e].entry = kept++;
      }
      at.entries.resize(kept);
      at.first = 0;
    }
    left_behind_ = 0;
  }

  PerEdge<Place> places_;
  std::array<std::unique_ptr<Page>, kBuckets / kPage> pages_;
  std::uint16_t least_ = kBuckets - 1;  ///< no bucket before it holds an edge
  std::size_t size_ = 0, left_behind_ = 0;
};

}  // namespace prohull
