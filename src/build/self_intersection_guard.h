#pragma once

#include <array>
#include <vector>

#include "build/star.h"
#include "mesh/half_edge_mesh.h"

namespace prohull {

/// Knows which collapses would make faces meet that do not share the point where they meet. Exact; the faces of the
/// mesh lie in a tree of boxes that grow with the collapses and are made anew whenever half of the faces are gone.
class SelfIntersectionGuard {
 public:
  explicit SelfIntersectionGuard(const HalfEdgeMesh& mesh);

  /// Whether the new star would take part in more pairs of intersecting faces than the star that it replaces: an input
  /// that intersects itself can still be simplified, but its pairs are never multiplied.
  bool would_add_intersections(const HalfEdgeMesh& mesh, const Star& star, const Vec3& apex);

  /// The same for a vertex that would move; its link in order around it.
  bool would_add_intersections(const HalfEdgeMesh& mesh, VertexId v, const std::vector<VertexId>& link, const Vec3& to);

  /// To be told of every collapse, and of every vertex moved.
  void changed(const HalfEdgeMesh& mesh, VertexId s);

 private:
  // In units of the mesh's box. Mapping a coordinate to float is monotone, so that boxes that overlap still do.
  struct FloatBox {
    std::array<float, 3> min, max;
    void extend(const FloatBox& other);
    bool overlaps(const FloatBox& other) const;
    bool contains(const FloatBox& other) const;
  };
  struct Slot {
    FaceId face;
    FloatBox box;
  };
  static constexpr std::uint32_t kLeafSize = 4;

  void rebuild(const HalfEdgeMesh& mesh);
  FloatBox box_of(const Triangle& t) const;
  std::size_t count_pairs(const HalfEdgeMesh& mesh, VertexId o, VertexId d, const std::vector<Triangle>& faces);
  template <class Use>
  void visit(const FloatBox& box, Use&& use) const;

  Vec3 center_;
  double inverse_unit_;
  std::size_t faces_when_built_ = 0;
  std::vector<Slot> slots_;  ///< leaf i holds those from kLeafSize * i on
  PerFace<std::uint32_t> slot_of_;
  std::vector<FloatBox> nodes_;  ///< a complete binary tree: children of i are 2i and 2i+1, the root is 1
  std::uint32_t first_leaf_ = 1;
  std::vector<Triangle> faces_;       ///< scratch
  std::vector<FloatBox> face_boxes_;  ///< scratch
};

}  // namespace prohull
