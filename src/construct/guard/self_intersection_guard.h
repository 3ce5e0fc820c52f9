#pragma once

#include <array>
#include <vector>

#include "construct/guard/fan.h"
#include "construct/star.h"
#include "geometry/cones.h"
#include "geometry/four_boxes.h"
#include "mesh/half_edge_mesh.h"

namespace prohull {

/// Knows which collapses would make faces meet that do not share the point where they meet. Exact; the faces of the
/// mesh lie in a tree of boxes, which follow the collapses and are packed anew whenever half of the faces are gone.
class SelfIntersectionGuard {
 public:
  /// Fast if `faces`, all of the mesh, are in an order in which what lies together in space does so in the list,
  /// mostly.
  SelfIntersectionGuard(const HalfEdgeMesh& mesh, const std::vector<FaceId>& faces);

  /// Whether the new star would take part in more pairs of intersecting faces than the star that it replaces: an input
  /// that intersects itself can still be simplified, but its pairs are never multiplied.
  bool would_add_intersections(const HalfEdgeMesh& mesh, const Star& star, const Vec3& apex);

  /// The same for a vertex that would move; its link in order around it.
  bool would_add_intersections(const HalfEdgeMesh& mesh, VertexId v, const std::vector<VertexId>& link, const Vec3& to);

  /// The same for an edge that would be flipped (HalfEdgeMesh::flip).
  bool would_add_intersections(const HalfEdgeMesh& mesh, HalfEdgeId flipped);

  /// The same for faces that would make room for others: `gone` in ascending order.
  bool would_add_intersections(const HalfEdgeMesh& mesh, const std::vector<FaceId>& gone,
                               const std::vector<Triangle>& made);

  /// To be told of every collapse,
  void collapsed(const HalfEdgeMesh& mesh, const VertexSplit& inverse);
  /// and of every vertex moved, and of one end of every edge flipped, as it is then.
  void changed(const HalfEdgeMesh& mesh, VertexId s);

 private:
  static constexpr std::uint32_t kWidth = FourBoxes::kWidth;

  /// Its corners, then its own id: as they lie in memory, and in the lanes of an exam of all of them.
  struct Face {
    std::array<VertexId, 3> corners;
    FaceId id;
  };
  static Face face(const HalfEdgeMesh& mesh, FaceId f) { return {mesh.corners(f), f}; }

  void pack(const HalfEdgeMesh& mesh);
  void place(std::uint32_t slot, const FloatBox& box);
  std::size_t find_others(const FloatBox& box, auto&& is_other, auto&& is_apart_from);
  std::size_t count_pairs_of_fan(const HalfEdgeMesh& mesh, VertexId o, VertexId d, const std::vector<VertexId>& link,
                                 const Vec3& apex);
  std::size_t count_pairs(const HalfEdgeMesh& mesh, auto&& is_other);
  std::size_t count_pairs_among_faces() const;
  void set_faces(const HalfEdgeMesh& mesh, const std::vector<VertexId>& link, auto&& apex);
  bool adds_pairs(const HalfEdgeMesh& mesh, VertexId o, VertexId d, const std::vector<VertexId>& link, const Vec3& apex,
                  auto&& set_faces_before);

  const UnitCube unit_cube_;
  std::size_t faces_when_packed_ = 0;
  std::vector<Face> face_at_;  ///< by slot; what is gone has an empty box
  PerFace<std::uint32_t> slot_of_;
  FourWideTree levels_;  ///< over slots
  Cones cones_;

  // Scratch.
  Fan fan_;
  std::vector<Triangle> faces_;
  std::vector<FloatBox> face_boxes_;
  std::vector<std::uint32_t> nodes_, children_;
  std::vector<Face> others_;
};

/// In such an order.
std::vector<FaceId> faces_along_curve(const HalfEdgeMesh& mesh);

}  // namespace prohull
