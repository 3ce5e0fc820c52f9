#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "geometry/four_boxes.h"
#include "geometry/tetrahedron_contact.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// Finds the faces of a mesh near small convex regions: a tree of float32 boxes, four children to a node and four
/// faces to a leaf, in a frame in which the mesh lies in [-1, 1]^3. What it leaves out is far away for certain.
class TriangleSieve {
 public:
  explicit TriangleSieve(const TriangleMesh& mesh);

  /// The mesh, its faces and vertices in an order in which what lies together in space does so in memory, mostly.
  const TriangleMesh& mesh() const { return mesh_; }

  /// A box, cut by planes; in the frame.
  class Region {
   private:
    friend class TriangleSieve;
    struct Plane {
      std::array<float, 3> normal;
      float offset;  ///< the region is where normal . x >= offset
    };
    std::array<float, 3> low, high;
    std::array<Plane, 4> planes;
    std::size_t plane_count = 0;
  };
  /// The points within `reach` of the tetrahedron, and some more.
  Region around(const Tetrahedron& t, double reach) const;
  /// The points within `reach` of the triangle, and some more.
  Region around(const Triangle& t, double reach) const;

  /// visit(face) for every face that may have a point in the region, until it returns false.
  template <class Visit>
  void visit(const Region& region, Visit visit) const;

 private:
  static constexpr std::uint32_t kWidth = FourBoxes::kWidth;
  struct Leaf {
    Float4 corner[3][3];  ///< [corner][axis], lane i: of face i
  };

  Vec3 in_frame(const Vec3& p) const { return (p - center_) * scale_; }
  void add_box(Region& region, const Box& box, double reach) const;
  static void add_plane(Region& region, const Vec3& normal, const Vec3& on, const Vec3& inside, double reach);
  Leaf leaf_of_faces_from(std::uint32_t first) const;
  static unsigned reached(const FourBoxes& node, const Region& region);
  static unsigned reached(const Leaf& leaf, const Region& region);

  TriangleMesh mesh_;
  Vec3 center_;
  double scale_ = 1;
  std::vector<Leaf> leaves_;  ///< each of the next four faces
  FourWideTree levels_;       ///< over the leaves
};

inline unsigned TriangleSieve::reached(const FourBoxes& node, const Region& r) {
  Truth4 in = (node.min[0] <= r.high[0]) & (node.max[0] >= r.low[0]) & (node.min[1] <= r.high[1]) &
              (node.max[1] >= r.low[1]) & (node.min[2] <= r.high[2]) & (node.max[2] >= r.low[2]);
  for (std::size_t i = 0; i < r.plane_count; ++i) {
    const auto& [n, offset] = r.planes[i];
    const Float4 &x = n[0] > 0 ? node.max[0] : node.min[0], &y = n[1] > 0 ? node.max[1] : node.min[1],
                 &z = n[2] > 0 ? node.max[2] : node.min[2];
    in &= x * n[0] + y * n[1] + z * n[2] >= offset;
  }
  return mask(in);
}

inline unsigned TriangleSieve::reached(const Leaf& leaf, const Region& r) {
  unsigned in = 0xf;
  const auto& [a, b, c] = leaf.corner;
  for (std::size_t i = 0; i < r.plane_count && in != 0; ++i) {
    const auto& [n, offset] = r.planes[i];
    in &=
        mask((a[0] * n[0] + a[1] * n[1] + a[2] * n[2] >= offset) | (b[0] * n[0] + b[1] * n[1] + b[2] * n[2] >= offset) |
             (c[0] * n[0] + c[1] * n[1] + c[2] * n[2] >= offset));
  }
  for (std::size_t i = 0; i < 3 && in != 0; ++i)
    in &= mask(((a[i] <= r.high[i]) | (b[i] <= r.high[i]) | (c[i] <= r.high[i])) &
               ((a[i] >= r.low[i]) | (b[i] >= r.low[i]) | (c[i] >= r.low[i])));
  return in;
}

template <class Visit>
void TriangleSieve::visit(const Region& region, Visit visit) const {
  if (levels_.empty()) return;
  struct Place {
    std::uint32_t level, node;
  };
  constexpr std::size_t kMostLevels = 16;  // 4^16 = 2^32
  std::array<Place, kMostLevels * kWidth> stack;
  std::size_t size = 0;
  stack[size++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0};
  while (size > 0) {
    const auto [level, node] = stack[--size];
    for (unsigned in = reached(levels_[level][node], region); in != 0; in &= in - 1) {
      const std::uint32_t child = kWidth * node + static_cast<std::uint32_t>(std::countr_zero(in));
      if (level > 0) {
        stack[size++] = {level - 1, child};
        continue;
      }
      const Leaf& leaf = leaves_[child];
      for (unsigned faces = reached(leaf, region); faces != 0; faces &= faces - 1)
        if (!visit(FaceId{kWidth * child + static_cast<std::uint32_t>(std::countr_zero(faces))})) return;
    }
  }
}

}  // namespace prohull
