#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/simd.h"
#include "prohull/triangle_mesh.h"
#include "query/line.h"

namespace prohull {

/// What a WideBvh sees of a line: float32 planes meet float32 origins, conservatively.
///
/// t = (plane - origin) / direction is bounded from below at the near plane and from above at the far one by rounding
/// the origin up or down. Difference, inverse and product then have a relative error of at most 3 eps + O(eps^2), eps =
/// 2^-24, and the right sign; so far values times (1 + 8 eps), plus 2^-100 for products that underflow, are safe.
/// Axes along which this does not hold, where the direction is neither 0 nor of a middling size, are left out: their
/// origins are NaN, and NaN is never chosen.
struct WideLine {
  std::array<float, 3> near_origin, far_origin, inverse;
  std::array<bool, 3> backwards;  ///< the near plane is that of the greater coordinate
};

/// A tree of float32 boxes around the faces of a mesh, four children to a node, in a frame in which the mesh is about
/// of size 1 at the origin. Built by the surface-area heuristic with bins (Wald 2007).
class WideBvh {
 public:
  static constexpr int kWidth = 4;

  explicit WideBvh(const TriangleMesh& mesh);

  /// visit(face) for every face of which the box may be met by the line up to limit(), nearer boxes first.
  /// visit returns whether to go on; limit() may shrink meanwhile.
  template <class Limit, class Visit>
  void visit(const DirectedLine& line, Limit limit, Visit visit) const;

  /// visit(face) for every face of which the box may overlap, until it returns false.
  template <class Visit>
  void visit(const Box& box, Visit visit) const;

  std::size_t memory_bytes() const { return nodes_.size() * sizeof(Node) + faces_.size() * sizeof(FaceId); }

 private:
  friend class WideBvhBuilder;

  struct alignas(64) Node {
    Float4 low[3], high[3];                   ///< lane i: the box of child i
    std::array<std::uint32_t, kWidth> first;  ///< a node, or the first face of a leaf in faces_
    std::array<std::uint8_t, kWidth> faces;   ///< in a leaf; 0 for a node
    std::uint8_t children;
  };
  struct Entry {
    float near;
    std::uint32_t first, faces;
  };
  static constexpr int kMaxDepth = 96, kStackSize = (kWidth - 1) * kMaxDepth + 1;

  WideLine seen(const DirectedLine& line) const;
  /// In the tree's frame, rounded outwards.
  std::pair<float, float> outwards(int axis, double low, double high) const;

  Vec3 center_;
  double scale_ = 1;  ///< a power of 2; a point p of the mesh is at (p - center) scale
  std::vector<Node> nodes_;
  std::vector<FaceId> faces_;
};

template <class Limit, class Visit>
void WideBvh::visit(const DirectedLine& line, Limit limit, Visit visit) const {
  if (nodes_.empty()) return;
  constexpr float kWiden = 1 + 8 * 0x1p-24f, kUnderflow = 0x1p-100f;
  const WideLine seen_line = seen(line);
  Entry stack[kStackSize];
  int size = 0;
  stack[size++] = {0, 0, 0};
  while (size > 0) {
    const Entry entry = stack[--size];
    const float end = static_cast<float>(limit()) * kWiden + kUnderflow;
    if (entry.near > end) continue;
    for (std::uint32_t i = 0; i < entry.faces; ++i)
      if (!visit(faces_[entry.first + i])) return;
    if (entry.faces > 0) continue;

    const Node& node = nodes_[entry.first];
    Float4 from{}, to = {end, end, end, end};
    for (int axis = 0; axis < 3; ++axis) {
      const Float4& near_plane = seen_line.backwards[axis] ? node.high[axis] : node.low[axis];
      const Float4& far_plane = seen_line.backwards[axis] ? node.low[axis] : node.high[axis];
      const Float4 near = (near_plane - seen_line.near_origin[axis]) * seen_line.inverse[axis];
      const Float4 far = (far_plane - seen_line.far_origin[axis]) * seen_line.inverse[axis];
      from = near > from ? near : from;
      to = far < to ? far : to;
    }
    const auto met = from <= to * kWiden + kUnderflow;
    const int first = size;
    for (int i = 0; i < node.children; ++i) {
      if (!met[i]) continue;
      const Entry child{from[i], node.first[i], node.faces[i]};
      int place = size++;
      for (; place > first && stack[place - 1].near < child.near; --place) stack[place] = stack[place - 1];
      stack[place] = child;
    }
  }
}

template <class Visit>
void WideBvh::visit(const Box& box, Visit visit) const {
  if (nodes_.empty() || box.is_empty()) return;
  const auto [low_x, high_x] = outwards(0, box.min.x, box.max.x);
  const auto [low_y, high_y] = outwards(1, box.min.y, box.max.y);
  const auto [low_z, high_z] = outwards(2, box.min.z, box.max.z);
  std::uint32_t stack[kStackSize];
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    const auto met = (node.low[0] <= high_x) & (node.high[0] >= low_x) & (node.low[1] <= high_y) &
                     (node.high[1] >= low_y) & (node.low[2] <= high_z) & (node.high[2] >= low_z);
    for (int i = 0; i < node.children; ++i) {
      if (!met[i]) continue;
      if (node.faces[i] == 0) stack[size++] = node.first[i];
      for (std::uint32_t k = 0; k < node.faces[i]; ++k)
        if (!visit(faces_[node.first[i] + k])) return;
    }
  }
}

}  // namespace prohull
