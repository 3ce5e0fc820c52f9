#pragma once

#include <optional>
#include <vector>

#include "construct/guard/self_intersection_guard.h"
#include "construct/placement.h"
#include "construct/star.h"
#include "geometry/mirror_plane.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/hull_builder.h"

namespace prohull {

/// What the collapse of an edge takes with it in a mesh that stays its own mirror image.
///
///       |            |            |            |       The plane is |. An edge apart from its image is collapsed
///   o-d | d'-o'   o--|--o'        o          d-o-d'    together with it. So is one whose end o has an edge to its
///       |         |  |  |         |            |       own image o'. An edge that is its own image, upright in the
///     apart       d  |  d'        d            |       plane or across it, gets its new vertex in the plane. An edge
///       |          across       itself     to the plane   with one end in the plane goes there with its image: all
///                                                      three vertices become one.
///
/// The stars of other edges meet those of their images in ways that leave no symmetric result.
class MirroredCollapse {
 public:
  MirroredCollapse(const HalfEdgeMesh& mesh, const PerHalfEdge<HalfEdgeId>& images, const MirrorPlane& plane)
      : mesh_(mesh), images_(images), plane_(plane) {}

  EdgeId image(EdgeId edge) const { return mesh_.edge(images_[mesh_.half_edge(edge)]); }

  /// Whether the star's edge may be collapsed as symmetry wants it; the rest is about the star that was looked at last.
  /// Requires gather_star and the link condition.
  bool look_at(const Star& star);

  /// How many faces the new vertex will have.
  std::size_t valence() const { return valence_; }

  /// As place_outside; the added volume is that of one collapse, where there are two. Requires measure_star.
  std::optional<Placement> place(const Star& star, double margin);

  /// Whether a collapse to an end of the edge, or to its middle, that adds nothing is accepted. As any_flat_end.
  template <class Accepts>
  bool any_flat_point(const Star& star, const Placement& placement, Accepts&& accepts) const {
    if (kind_ != Kind::Itself || is_upright_)
      return any_flat_end(mesh_, star, placement, [&](const Vec3& end, const Vec3& local) {
        return !(goes_to_plane() && plane_.side(end) != 0) && accepts(end, local);
      });
    if (!is_nearly_flat(star, placement)) return false;
    Vec3 middle = mesh_.position(star.o);
    middle[plane_.axis] = plane_.coordinate();
    return lies_on_all_planes(mesh_, star, middle) && accepts(middle, star.to_local(middle));
  }

  /// The nearest position to p that has an exact image, both as they are stored; nothing if there is none on the same
  /// side of the plane.
  std::optional<Vec3> as_stored(const Star& star, Vec3 p, bool float32_coordinates) const;

  std::optional<Refusal> refused_shape(const Star& star, const Vec3& apex, const HullOptions& options) const;

  bool would_add_intersections(SelfIntersectionGuard& guard, const Star& star, const Vec3& apex);

  /// The edge to be collapsed after that of the star, and where to; nothing if there is none.
  bool has_second() const { return kind_ != Kind::Itself; }
  HalfEdgeId second() const { return mesh_.tail(second_) == kNoVertex ? second_twin_ : second_; }
  Vec3 second_apex(const Vec3& apex) const { return goes_to_plane() ? apex : *plane_.image(apex); }
  /// Whether the vertex that the first collapse makes is an end of the second edge.
  bool are_joined() const { return kind_ == Kind::ToPlane; }

 private:
  enum class Kind { Apart, Across, Itself, ToPlane };

  bool goes_to_plane() const { return kind_ == Kind::Itself || kind_ == Kind::ToPlane; }
  bool look_at_pair(const Star& star);
  bool look_at_fan(const Star& star, VertexId far);
  bool is_beside_plane(const Star& star, const Vec3& apex) const;
  void find_faces(const Star& star, const Vec3& apex);

  const HalfEdgeMesh& mesh_;
  const PerHalfEdge<HalfEdgeId>& images_;
  const MirrorPlane plane_;

  Kind kind_ = Kind::Apart;
  bool is_upright_ = false;  ///< in the plane
  HalfEdgeId second_ = kNoHalfEdge, second_twin_ = kNoHalfEdge;
  VertexId image_of_o_ = kNoVertex, image_of_d_ = kNoVertex;
  std::size_t moved_ = 0;  ///< Across and ToPlane: the vertex of the link that the second collapse takes away
  std::size_t valence_ = 0;

  // Scratch.
  StarPlane star_plane_{};
  std::vector<FaceId> gone_;
  std::vector<Triangle> made_;
};

}  // namespace prohull
