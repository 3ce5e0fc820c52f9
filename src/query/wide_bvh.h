#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include "geometry/simd.h"
#include "parallel/huge_array.h"
#include "prohull/triangle_mesh.h"
#include "query/line.h"

namespace prohull {

/// A tree of float32 boxes around the faces of a mesh, eight children to a node and up to eight faces to a leaf, in a
/// frame in which the mesh lies in [-1, 1]^3. Built by the surface-area heuristic with bins (Wald 2007). A leaf has the
/// corners of its faces too, rounded to 16 bits: what they leave open, the mesh itself decides.
class WideBvh {
 public:
  static constexpr std::uint32_t kWidth = 8;

  explicit WideBvh(const TriangleMesh& mesh);

  struct alignas(64) Node {
    Float8 plane[6];              ///< low x, y, z, high x, y, z; lane i: of the box of child i, empty if there is none
    std::uint32_t child[kWidth];  ///< a node, a leaf as leaf_at has it, or kNoChild
  };
  /// In the frame, corner c of face i is at low + corner[c][..][i] / per_quantum, within kCornerError / per_quantum.
  struct alignas(32) Leaf {
    std::array<float, 3> low;
    float per_quantum;    ///< a power of 2
    Short8 corner[3][3];  ///< [corner][axis], lane i: of face i
    std::uint32_t face[kWidth];
    std::uint32_t first_corner;         ///< of its own, in corners_
    std::uint8_t corner_at[3][kWidth];  ///< [corner][face], from there on
  };
  /// The face in lane i, not rounded.
  Triangle triangle(const Leaf& leaf, int i) const {
    const Vec3* const corners = corners_.begin() + leaf.first_corner;
    return {corners[leaf.corner_at[0][i]], corners[leaf.corner_at[1][i]], corners[leaf.corner_at[2][i]]};
  }
  static constexpr float kCornerError = 0.5f + 0x1p-8f;

  static constexpr std::uint32_t kNoChild = 0xffffffff;  ///< a leaf too, for is_leaf
  static constexpr std::uint32_t kLeafBit = 1u << 31, kCountShift = 28, kLeafMask = (1u << kCountShift) - 1;
  static std::uint32_t leaf_at(std::uint32_t place, std::uint32_t faces) {
    return kLeafBit | (faces - 1) << kCountShift | place;
  }
  static bool is_leaf(std::uint32_t child) { return (child & kLeafBit) != 0; }
  static std::uint32_t faces_of(std::uint32_t leaf) { return (leaf >> kCountShift & 7) + 1; }
  const Leaf& leaf(std::uint32_t child) const { return leaves_[child & kLeafMask]; }
  void prefetch_leaf(std::uint32_t child) const {
    const char* const first = reinterpret_cast<const char*>(leaves_.begin() + (child & kLeafMask));
    __builtin_prefetch(first), __builtin_prefetch(first + 64), __builtin_prefetch(first + 128);
  }
  void prefetch_corners(const Leaf& leaf) const {
    const char* const first = reinterpret_cast<const char*>(corners_.begin() + leaf.first_corner);
    __builtin_prefetch(first), __builtin_prefetch(first + 64), __builtin_prefetch(first + 128);
  }
  const Node& node(std::uint32_t child) const { return nodes_[child]; }

  bool is_empty() const { return nodes_.size() == 0; }
  static constexpr std::uint32_t kRoot = 0;
  static constexpr int kMaxDepth = 96, kStackSize = (kWidth - 1) * kMaxDepth + 1;

  /// visit(face, triangle) for every face of which the box may overlap, until it returns false.
  template <class Visit>
  void visit(const Box& box, Visit visit) const;

  /// A point of the mesh's space in the frame, but for rounding.
  Vec3 in_frame(const Vec3& p) const { return (p - center_) * scale_; }
  double scale() const { return scale_; }
  /// In the frame, rounded outwards.
  std::pair<float, float> outwards(int axis, double low, double high) const;

  std::size_t memory_bytes() const { return nodes_.bytes() + leaves_.bytes() + corners_.bytes(); }

 private:
  friend class WideBvhBuilder;
  /// Bit i: face i of the leaf. Rounding to quanta, of both, is made up for by 2 quanta.
  unsigned faces_that_may_overlap(std::uint32_t child, const std::array<float, 3>& low,
                                  const std::array<float, 3>& high) const;

  Vec3 center_;
  double scale_ = 1;  ///< a power of 2; a point p of the mesh is at (p - center) scale
  HugeArray<Node> nodes_;
  HugeArray<Leaf> leaves_;
  HugeArray<Vec3> corners_;  ///< those of one leaf lie together, each once
};

template <class Visit>
void WideBvh::visit(const Box& box, Visit visit) const {
  if (is_empty() || box.is_empty()) return;
  std::array<float, 3> low, high;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    std::tie(low[axis], high[axis]) = outwards(a, box.min[a], box.max[a]);
  }
  std::uint32_t stack[kStackSize];
  int size = 0;
  stack[size++] = kRoot;
  while (size > 0) {
    const std::uint32_t child = stack[--size];
    if (is_leaf(child)) {
      for (unsigned met = faces_that_may_overlap(child, low, high); met != 0; met &= met - 1)
        if (const int i = std::countr_zero(met); !visit(FaceId{leaf(child).face[i]}, triangle(leaf(child), i))) return;
      continue;
    }
    const Node& n = nodes_[child];
    const Truth8 met = (n.plane[0] <= high[0]) & (n.plane[3] >= low[0]) & (n.plane[1] <= high[1]) &
                       (n.plane[4] >= low[1]) & (n.plane[2] <= high[2]) & (n.plane[5] >= low[2]);
    for (std::uint32_t i = 0; i < kWidth; ++i)
      if (met[i] && n.child[i] != kNoChild) stack[size++] = n.child[i];
  }
}

}  // namespace prohull
