#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "prohull/progressive_hull.h"

namespace prohull {

/// The tetrahedra that fill the void between the base mesh of a hull and its original mesh. Every edge collapse gives
/// one for each face of the star of its edge: the face and the new vertex, the apex, span it. So two tetrahedra may
/// overlap in space, but each face of each belongs to one other tetrahedron, to the base mesh or to the original mesh.
/// Guaranteed: no tetrahedron is turned inside out; some may be flat. Immutable, any number of threads may share one.
class VoidComplex {
 public:
  /// Requires that first_defect(hull) finds none. Throws InputError(NoCertificate) if a tetrahedron is turned inside
  /// out: then the record is not one of a hull, and verify_replay fails too. Throws InputError(InvalidOption) if the
  /// hull needs more than 2^31 tetrahedra.
  explicit VoidComplex(const ProgressiveHull& hull);

  /// What lies beyond a face of a tetrahedron.
  struct Neighbour {
    enum class Kind : std::uint32_t { Tetrahedron, OriginalFace, BaseFace } kind;
    std::uint32_t id;    ///< of the tetrahedron, below size(); of the face, which has one number in all levels
    std::uint32_t star;  ///< of the tetrahedron

    bool operator==(const Neighbour&) const = default;
  };

  /// The vertices have numbers of their own here.
  struct Tetrahedron {
    std::array<VertexId, 4> corners;  ///< the apex, and the corners of the face of the star, counter-clockwise
    std::array<Neighbour, 4> beyond;  ///< of each corner: what lies beyond the face opposite to it
  };

  std::size_t size() const { return tetrahedra_.size(); }
  /// Requires a Neighbour of Kind::Tetrahedron.
  Tetrahedron operator[](const Neighbour& place) const;
  Neighbour tetrahedron(std::uint32_t id) const;  ///< slow
  bool is_flat(std::uint32_t id) const { return is_flat_[id]; }

  const Vec3& position(VertexId v) const { return stars_[index(v) / 2].ends[index(v) % 2]; }

  /// What lies in the void on the other side of a face: a tetrahedron, or the same face of the other mesh.
  Neighbour beyond_original(FaceId f) const { return neighbour(below_original_[index(f)], Neighbour::Kind::BaseFace); }
  /// Of base_faces()[i].
  Neighbour beyond_base(std::size_t i) const { return neighbour(above_base_[i], Neighbour::Kind::OriginalFace); }

  std::size_t original_face_count() const { return below_original_.size(); }
  /// Ascending, as in ProgressiveHull::base().
  const std::vector<FaceId>& base_faces() const { return base_faces_; }
  const std::vector<std::array<VertexId, 3>>& base_corners() const { return base_corners_; }

  const Box& box() const { return box_; }  ///< around all positions

  std::size_t memory_bytes() const;

 private:
  friend class VoidComplexBuilder;

  static constexpr std::uint32_t kLeaves = 0x80000000;

  struct Link {
    std::uint32_t id;  ///< of a tetrahedron; kLeaves | face: of the base or original mesh
    std::uint32_t star;
  };
  /// A cache line. The positions of all vertices are in the stars of the splits that bring them forth; those of the
  /// base mesh are in stars without tetrahedra. So vertex 2 s is o of star s, and vertex 2 s + 1 is d. The tetrahedra
  /// of a star lie together, in the order in which their faces lie around the edge o-d: (o, d, l), the others around o
  /// from l to r, (d, o, r), the others around d from r to l.
  struct alignas(64) Star {
    std::array<Vec3, 2> ends;
    std::uint32_t first;   ///< tetrahedron, that of (o, d, l)
    std::uint32_t second;  ///< that of (d, o, r)
    std::uint32_t end;
    VertexId apex;
  };
  struct Compact {
    VertexId link;  ///< the corner on the link: l and r of the two above, the first of the two of the others
    Link finer;     ///< beyond the face opposite to the apex
    Link coarser;   ///< beyond the face opposite to o or d; not of the two above
  };

  void prefetch(const Link& link) const {
    if ((link.id & kLeaves) != 0) return;
    __builtin_prefetch(&tetrahedra_[link.id]);
    __builtin_prefetch(&stars_[link.star]);
  }
  static Neighbour neighbour(const Link& link, Neighbour::Kind beyond_the_complex) {
    if ((link.id & kLeaves) == 0) return {Neighbour::Kind::Tetrahedron, link.id, link.star};
    return {beyond_the_complex, link.id & ~kLeaves, 0};
  }

  // Stars lie in the order of the vertex hierarchy, depth first: a line that goes from coarse to fine stays near.
  std::vector<Star> stars_;
  std::vector<Compact> tetrahedra_;
  std::vector<bool> is_flat_;
  std::vector<Link> below_original_;  ///< by face
  std::vector<FaceId> base_faces_;
  std::vector<std::array<VertexId, 3>> base_corners_;
  std::vector<Link> above_base_;  ///< by place in base_faces_
  Box box_;
};

inline VoidComplex::Tetrahedron VoidComplex::operator[](const Neighbour& place) const {
  using Kind = Neighbour::Kind;
  const auto [kind, t, s] = place;
  const Compact& compact = tetrahedra_[t];
  const Star& star = stars_[s];
  const VertexId o{2 * s}, d{2 * s + 1};
  prefetch(compact.finer), prefetch(compact.coarser);
  const auto in_star = [s = s](std::uint32_t other) { return Neighbour{Kind::Tetrahedron, other, s}; };
  const std::uint32_t next = t + 1 == star.end ? star.first : t + 1;
  const Neighbour before = in_star(t == star.first ? star.end - 1 : t - 1), after = in_star(next);
  __builtin_prefetch(&position(tetrahedra_[before.id].link));
  __builtin_prefetch(&position(tetrahedra_[next + 1 >= star.end ? star.first : next + 1].link));
  const Neighbour finer = neighbour(compact.finer, Kind::OriginalFace);
  if (t == star.first) return {{star.apex, o, d, compact.link}, {finer, before, after, in_star(star.second)}};
  if (t == star.second) return {{star.apex, d, o, compact.link}, {finer, before, after, in_star(star.first)}};
  return {{star.apex, t < star.second ? o : d, compact.link, tetrahedra_[next].link},
          {finer, neighbour(compact.coarser, Kind::BaseFace), after, before}};
}

/// The original faces of sheets without thickness: a line may cross two of them at one point, from the void to the
/// void. May name some more, which lie in one plane with such a sheet. Of almost all meshes there are none.
std::vector<FaceId> sheets_without_thickness(const VoidComplex& complex);

}  // namespace prohull
