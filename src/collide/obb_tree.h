#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prohull/geometry.h"

namespace prohull {

/// A box with any axes, one cache line of it: the points c + x u + y v + z w with |x|, |y|, |z| at most the three half
/// sizes. The axes u, v, w are unit vectors, square to each other, within 2^-22 in each product.
struct ObbNode {
  float axes[9];  ///< the x coordinates of u, v, w, then their y and z coordinates
  float half[3];
  float center[3];
  std::uint32_t link;  ///< inner: the second child, the first one follows its parent; leaf: kLeaf + its first item

  static constexpr std::uint32_t kLeaf = 0x80000000u;
  bool is_leaf() const { return link >= kLeaf; }
  std::uint32_t first() const { return link - kLeaf; }
};
static_assert(sizeof(ObbNode) == 64);

/// A binary tree of boxes around triangles, halved along the longest axis. Boxes are in float32, in coordinates of
/// their own: (p - center) * unit, in which all triangles lie in the unit ball.
class ObbTree {
 public:
  static constexpr std::uint32_t kLeafSize = 2;
  static constexpr std::uint32_t kMaxDepth = 34;

  /// At least one triangle, finite and within 1e100.
  explicit ObbTree(std::span<const Triangle> triangles);

  std::span<const ObbNode> boxes() const { return boxes_; }
  /// The triangles, in the order of the leaves. A leaf has kLeafSize of them, the last leaf may have fewer.
  std::span<const std::uint32_t> items() const { return items_; }
  std::span<const std::uint32_t> items_of(const ObbNode& leaf) const {
    const std::size_t first = leaf.first();
    return std::span(items_).subspan(first, std::min<std::size_t>(kLeafSize, items_.size() - first));
  }

  const Vec3& center() const { return center_; }
  double unit() const { return unit_; }      ///< a power of two
  double radius() const { return radius_; }  ///< no triangle reaches farther from the center
  double reach() const { return reach_; }    ///< nor farther from the origin
  std::size_t memory_bytes() const { return boxes_.size() * sizeof(ObbNode) + items_.size() * sizeof(items_[0]); }

 private:
  struct Builder;

  std::vector<ObbNode> boxes_;
  std::vector<std::uint32_t> items_;
  Vec3 center_;
  double unit_ = 1, radius_ = 0, reach_ = 0;
};

}  // namespace prohull
