#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include "geometry/select.h"
#include "prohull/geometry.h"

namespace prohull {

inline Box box_of(const Triangle& t) {
  Box box;
  for (const Vec3& p : {t.a, t.b, t.c}) box.extend(p);
  return box;
}

/// A binary tree over boxes, halved at the median along the longest side: depth ceil(log2(count)) whatever the input.
class Bvh {
 public:
  Bvh() = default;
  explicit Bvh(std::vector<Box> boxes) : items_(boxes.size()) {
    std::iota(items_.begin(), items_.end(), 0u);
    nodes_.reserve(most_nodes(boxes.size()));
    std::vector<Key> keys(boxes.size());
    if (!boxes.empty()) build(boxes, keys, 0, static_cast<std::uint32_t>(boxes.size()));
    sort_as_items(boxes);
    item_boxes_ = std::move(boxes);
  }
  explicit Bvh(const std::vector<Triangle>& triangles) : Bvh(boxes_of(triangles, std::identity())) {}
  /// Over the triangles of a mesh, by their numbers.
  template <class Mesh>
  requires requires(const Mesh& mesh) { mesh.triangles.ids(); }
  explicit Bvh(const Mesh& mesh) : Bvh(boxes_of(mesh.triangles.ids(), [&](auto f) { return mesh.triangle(f); })) {}

  /// visit(item) for every item of which the box, and the boxes above it in the tree, are wanted(box).
  template <class Wanted, class Visit>
  void visit(Wanted wanted, Visit visit_item) const {
    if (nodes_.empty()) return;
    std::uint32_t stack[kMaxDepth], size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const Node& node = nodes_[stack[--size]];
      if (!wanted(node.box)) continue;
      if (node.is_leaf()) {
        for (std::uint32_t i = node.begin; i < node.end; ++i)
          if (wanted(item_boxes_[i])) visit_item(items_[i]);
      } else {
        stack[size++] = node.right;
        stack[size++] = static_cast<std::uint32_t>(&node - nodes_.data()) + 1;
      }
    }
  }

  /// The least measure(item) of all, for measures that are never below bound(box) of a box around the item; none that
  /// is not below `best`.
  template <class Bound, class Measure>
  double least(Bound bound, Measure measure, double best = std::numeric_limits<double>::infinity()) const {
    if (!nodes_.empty()) descend(0, bound, measure, best);
    return best;
  }

 private:
  static constexpr std::uint32_t kLeafSize = 4, kMaxDepth = 64;

  struct Node {
    Box box;
    std::uint32_t begin, end;  // of the items
    std::uint32_t right;       // the left child follows its parent; 0 in a leaf
    bool is_leaf() const { return right == 0; }
  };

  /// By which items are halved.
  struct Key {
    double center;  ///< along the longest side
    std::uint32_t item;
    bool operator<(const Key& other) const {
      return center != other.center ? center < other.center : item < other.item;
    }
  };

  template <class Items, class TriangleOf>
  static std::vector<Box> boxes_of(const Items& items, TriangleOf triangle_of) {
    std::vector<Box> boxes;
    for (const auto& item : items) boxes.push_back(box_of(triangle_of(item)));
    return boxes;
  }

  std::uint32_t build(const std::vector<Box>& boxes, std::vector<Key>& keys, std::uint32_t begin, std::uint32_t end) {
    const auto self = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, begin, end, 0});
    if (end - begin <= kLeafSize) {
      for (std::uint32_t i = begin; i < end; ++i) nodes_[self].box.extend(boxes[items_[i]]);
      return self;
    }
    Box centers;
    for (std::uint32_t i = begin; i < end; ++i) centers.extend(boxes[items_[i]].center());
    const Vec3 size = centers.max * 0.5 - centers.min * 0.5;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    for (std::uint32_t i = begin; i < end; ++i) keys[i] = {boxes[items_[i]].center()[axis], items_[i]};
    select_nth(keys.begin() + begin, keys.begin() + middle, keys.begin() + end, std::less<>());
    for (std::uint32_t i = begin; i < end; ++i) items_[i] = keys[i].item;
    const std::uint32_t left = build(boxes, keys, begin, middle), right = build(boxes, keys, middle, end);
    Node& node = nodes_[self];
    node.right = right;
    node.box = nodes_[left].box;
    node.box.extend(nodes_[right].box);
    return self;
  }

  static std::size_t most_nodes(std::size_t items) {
    std::size_t leaves = 1;
    while (leaves * kLeafSize < items) leaves *= 2;
    return std::min(items, 2 * leaves - 1);
  }

  /// In place: these are the largest arrays of all.
  void sort_as_items(std::vector<Box>& boxes) const {
    std::vector<bool> is_done(boxes.size());
    for (std::uint32_t first = 0; first < items_.size(); ++first) {
      const Box of_first = boxes[first];
      for (std::uint32_t i = first; !is_done[i]; i = items_[i]) {
        is_done[i] = true;
        boxes[i] = items_[i] == first ? of_first : boxes[items_[i]];
      }
    }
  }

  template <class Bound, class Measure>
  void descend(std::uint32_t n, Bound& bound, Measure& measure, double& best) const {
    const Node& node = nodes_[n];
    if (node.is_leaf()) {
      for (std::uint32_t i = node.begin; i < node.end; ++i)
        if (bound(item_boxes_[i]) < best) best = std::min(best, measure(items_[i]));
      return;
    }
    const double left = bound(nodes_[n + 1].box), right = bound(nodes_[node.right].box);
    const bool left_first = left <= right;
    if (std::min(left, right) < best) descend(left_first ? n + 1 : node.right, bound, measure, best);
    if (std::max(left, right) < best) descend(left_first ? node.right : n + 1, bound, measure, best);
  }

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> items_;
  std::vector<Box> item_boxes_;
};

}  // namespace prohull
