#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "prohull/detail/vertex_split.h"
#include "prohull/triangle_mesh.h"

namespace prohull {

/// One side of an edge, from tail to tip, its face on the left. Corner c of face f starts half-edge 3 f + c.
enum class HalfEdgeId : std::uint32_t {};
enum class EdgeId : std::uint32_t {};

template <class T>
using PerHalfEdge = IndexedBy<HalfEdgeId, T>;
template <class T>
using PerEdge = IndexedBy<EdgeId, T>;

constexpr VertexId kNoVertex{0xffffffff};
constexpr HalfEdgeId kNoHalfEdge{0xffffffff};

/// A closed 2-manifold, its edges collapsible and every collapse exactly undoable: faces, half-edges and edges keep
/// their ids for ever, vertices are never reused (a collapse makes a new one).
class HalfEdgeMesh {
 public:
  /// Requires a closed 2-manifold, consistently oriented (MeshReport::is_closed_manifold).
  explicit HalfEdgeMesh(const TriangleMesh& mesh);

  /// The same with room for faces to come: corner c of face f has the vertex corners[3 f + c], or kNoVertex. Faces may
  /// be missing; what is asked of elements with a border must not need them.
  HalfEdgeMesh(PerVertex<Vec3> positions, const std::vector<VertexId>& corners);

  /// The same of which the twins are known: twins[3 f + c] of the half-edge that starts at that corner, kNoHalfEdge if
  /// its face is missing.
  HalfEdgeMesh(PerVertex<Vec3> positions, const std::vector<VertexId>& corners, const std::vector<HalfEdgeId>& twins);

  static HalfEdgeId next(HalfEdgeId h) { return HalfEdgeId(index(h) % 3 == 2 ? index(h) - 2 : index(h) + 1); }
  static HalfEdgeId previous(HalfEdgeId h) { return HalfEdgeId(index(h) % 3 == 0 ? index(h) + 2 : index(h) - 1); }
  HalfEdgeId twin(HalfEdgeId h) const { return half_edges_[h].twin; }
  VertexId tail(HalfEdgeId h) const { return half_edges_[h].tail; }
  VertexId tip(HalfEdgeId h) const { return tail(next(h)); }
  EdgeId edge(HalfEdgeId h) const { return edge_[h]; }
  HalfEdgeId half_edge(EdgeId e) const { return half_edge_[e]; }
  /// Some half-edge that starts at v.
  HalfEdgeId out(VertexId v) const { return out_[v]; }
  /// The next half-edge that starts where h does, counter-clockwise seen from outside.
  HalfEdgeId rotated(HalfEdgeId h) const { return twin(previous(h)); }

  /// The half-edges that start at v, counter-clockwise seen from outside, from out(v) on.
  ///
  ///     for (const HalfEdgeId h : mesh.around(v)) visit(mesh.tip(h));
  class Around {
   public:
    struct End {};
    class Iterator {
     public:
      Iterator(const HalfEdgeMesh& mesh, HalfEdgeId first) : mesh_(mesh), first_(first), at_(first) {}
      HalfEdgeId operator*() const { return at_; }
      Iterator& operator++() {
        at_ = mesh_.rotated(at_);
        is_round_ = at_ == first_;
        return *this;
      }
      bool operator==(End) const { return is_round_; }

     private:
      const HalfEdgeMesh& mesh_;
      HalfEdgeId first_, at_;
      bool is_round_ = false;
    };
    Around(const HalfEdgeMesh& mesh, HalfEdgeId first) : mesh_(mesh), first_(first) {}
    Iterator begin() const { return {mesh_, first_}; }
    End end() const { return {}; }

   private:
    const HalfEdgeMesh& mesh_;
    HalfEdgeId first_;
  };
  Around around(VertexId v) const { return {*this, out(v)}; }

  const Vec3& position(VertexId v) const { return positions_[v]; }
  std::uint32_t valence(VertexId v) const { return valence_[v]; }

  std::size_t face_count() const { return face_count_; }
  /// All ids ever given, whether the element still is in the mesh or not.
  const PerVertex<Vec3>& positions() const { return positions_; }
  std::size_t edge_id_count() const { return half_edge_.size(); }
  std::size_t face_id_count() const { return half_edges_.size() / 3; }
  bool has(FaceId f) const { return tail(HalfEdgeId(3 * index(f))) != kNoVertex; }
  bool has(EdgeId e) const { return half_edge_[e] != kNoHalfEdge; }
  bool has(VertexId v) const { return out_[v] != kNoHalfEdge; }
  std::array<VertexId, 3> corners(FaceId f) const {
    const HalfEdgeId h{3 * index(f)};
    return {tail(h), tail(HalfEdgeId(index(h) + 1)), tail(HalfEdgeId(index(h) + 2))};
  }

  //      l               l      collapse(o-d): faces (o,d,l) and (d,o,r) vanish, s stands for o and d.
  //     / \              |      split(s) undoes it and needs the whole link of s in place (3.2.1),
  //    o---d     -->     s      not only the faces beside l and r, as in Hoppe's scheme: a star
  //     \ /              |      that comes back different would no longer enclose.
  //      r               r
  /// Requires the link condition for the edge of h (o is its tail, d its tip).
  VertexSplit collapse(HalfEdgeId h, const Vec3& apex);

  /// Undoes the collapse that made `s`; requires its link to be in place.
  void split(VertexId s, const VertexSplit& record);

  /// Whether the edge of h may be flipped: its ends keep three faces at least, and no edge joins the other two corners.
  bool can_flip(HalfEdgeId h) const;

  /// Puts the other diagonal of its two faces in the place of the edge of h, which becomes r-l (above). Not known to
  /// splits: only before collapses, or without any.
  void flip(HalfEdgeId h);

  void move(VertexId v, const Vec3& position) { positions_[v] = position; }

  /// Of the faces that are there, in the order of their ids; vertices likewise, renumbered without gaps.
  TriangleMesh triangle_mesh() const;

 private:
  // What a walk around a vertex reads lies together.
  struct HalfEdge {
    VertexId tail;
    HalfEdgeId twin;
  };

  void allocate(std::size_t vertices, std::size_t faces);
  void link_twins();
  void pair(HalfEdgeId a, HalfEdgeId b, EdgeId e) {
    half_edges_[a].twin = b, half_edges_[b].twin = a;
    edge_[a] = edge_[b] = e;
    half_edge_[e] = a;
  }
  void set_tails_around(HalfEdgeId from, HalfEdgeId until, VertexId v);

  PerVertex<Vec3> positions_;
  PerVertex<HalfEdgeId> out_;
  PerVertex<std::uint32_t> valence_;
  PerHalfEdge<HalfEdge> half_edges_;
  PerHalfEdge<EdgeId> edge_;
  PerEdge<HalfEdgeId> half_edge_;
  std::size_t face_count_ = 0;
};

/// "half-edge 12: twin of twin is 40", or nothing if the structure is sound: a closed 2-manifold.
std::optional<std::string> first_defect(const HalfEdgeMesh& mesh);

}  // namespace prohull
