#include "hull/void_complex.h"

#include <algorithm>

#include "geometry/triangle_predicates.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/detail/refuse.h"
#include "prohull/error.h"

namespace prohull {

// Lays out the stars, then replays the splits. A split replaces coarse faces by fine ones of the same numbers, but for
// the two that it brings forth. So the tetrahedra over the versions of one face are a stack: beyond the coarse face of
// one lies the one made before.
class VoidComplexBuilder {
 public:
  VoidComplexBuilder(const ProgressiveHull& hull, VoidComplex& complex) : hull_(hull), complex_(complex) {}

  void build() {
    number_vertices();
    lowest_.assign(hull_.original_face_count(), kNone);
    add_base();
    replay();
    for (std::uint32_t f = 0; f < lowest_.size(); ++f)
      if ((lowest_[f].id & VoidComplex::kLeaves) == 0) complex_.tetrahedra_[lowest_[f].id].finer = leaving(f);
    complex_.below_original_ = std::move(lowest_);
    decide_signs();
  }

 private:
  using Link = VoidComplex::Link;
  static constexpr Link kNone{0xffffffff, 0};
  static Link leaving(std::uint32_t face) { return {VoidComplex::kLeaves | face, 0}; }

  bool is_made(VertexId v) const { return index(v) >= hull_.original_vertex_count(); }
  std::size_t split_of(VertexId made) const { return index(made) - hull_.original_vertex_count(); }

  /// The base vertices by pairs, with the stars below each pair after it.
  void number_vertices() {
    const std::size_t splits = hull_.splits().size();
    number_.assign(hull_.positions().size(), ProgressiveHull::kAbsent);
    star_of_split_.resize(splits);
    std::vector<bool> has_parent(hull_.positions().size(), false);
    for (const VertexSplit& split : hull_.splits()) has_parent[index(split.o)] = has_parent[index(split.d)] = true;
    std::vector<VertexId> roots;
    for (const VertexId v : hull_.positions().ids())
      if (!has_parent[index(v)]) roots.push_back(v);
    complex_.stars_.reserve(splits + (roots.size() + 1) / 2);
    std::vector<VertexId> waiting;
    for (std::size_t i = 0; i < roots.size(); i += 2) {
      add_pair(roots[i], i + 1 < roots.size() ? roots[i + 1] : ProgressiveHull::kAbsent, waiting);
      while (!waiting.empty()) {
        const VertexId made = waiting.back();
        waiting.pop_back();
        const VertexSplit& split = hull_.splits()[split_of(made)];
        star_of_split_[split_of(made)] = static_cast<std::uint32_t>(complex_.stars_.size());
        add_pair(split.o, split.d, waiting);
        complex_.stars_.back().apex = number_[made];
      }
    }
  }

  void add_pair(VertexId o, VertexId d, std::vector<VertexId>& waiting) {
    auto number = static_cast<std::uint32_t>(2 * complex_.stars_.size());
    VoidComplex::Star& star = complex_.stars_.emplace_back();
    for (std::size_t end = 0; end < 2; ++end) {
      const VertexId v = end == 0 ? o : d;
      if (v == ProgressiveHull::kAbsent) continue;
      number_[v] = VertexId(number++);
      star.ends[end] = hull_.positions()[v];
      complex_.box_.extend(star.ends[end]);
      if (is_made(v)) waiting.push_back(v);
    }
  }

  void add_base() {
    const std::vector<VertexId>& corners = hull_.base_corners();
    place_.resize(lowest_.size());
    for (std::uint32_t f = 0; f < lowest_.size(); ++f) {
      if (corners[3 * f] == ProgressiveHull::kAbsent) continue;
      lowest_[f] = leaving(f);
      place_[f] = static_cast<std::uint32_t>(complex_.base_faces_.size());
      complex_.base_faces_.push_back(FaceId(f));
      complex_.base_corners_.push_back(
          {number_[corners[3 * f]], number_[corners[3 * f + 1]], number_[corners[3 * f + 2]]});
      complex_.above_base_.push_back(leaving(f));
    }
  }

  void replay() {
    HalfEdgeMesh mesh(hull_.positions(), hull_.base_corners());
    give_room(mesh);
    for (std::size_t i = hull_.splits().size(); i-- > 0;) {
      const VertexSplit& record = hull_.splits()[i];
      const VertexId made = hull_.made_vertex(i);
      const std::uint32_t s = star_of_split_[i];
      VoidComplex::Star& star = complex_.stars_[s];
      Link t{star.first, s};
      add(record.od / 3, record.l, t);
      HalfEdgeId h = mesh.out(made);
      while (mesh.tip(h) != record.l) h = mesh.rotated(h);
      const HalfEdgeId first = h;
      do {
        if (mesh.tip(h) == record.r) {
          star.second = t.id;
          add(record.do_ / 3, record.r, t);
        }
        add(index(h) / 3, mesh.tip(h), t);
        h = mesh.rotated(h);
      } while (h != first);
      mesh.split(made, record);
    }
  }

  /// To each star for its tetrahedra, in the order of the stars; their numbers are the valences of the apexes and 2.
  void give_room(HalfEdgeMesh coarse) {
    for (std::size_t i = hull_.splits().size(); i-- > 0;) {
      complex_.stars_[star_of_split_[i]].end = coarse.valence(hull_.made_vertex(i)) + 2;
      coarse.split(hull_.made_vertex(i), hull_.splits()[i]);
    }
    std::size_t count = 0;
    for (VoidComplex::Star& star : complex_.stars_) {
      star.first = static_cast<std::uint32_t>(count);
      count += star.end;
      star.end = static_cast<std::uint32_t>(count);
      if (count >= VoidComplex::kLeaves) refuse("the hull has more than 2^31 tetrahedra of void");
    }
    complex_.tetrahedra_.resize(count);
  }

  void add(std::uint32_t face, VertexId link, Link& t) {
    const Link coarser = lowest_[face];
    if (coarser.id == leaving(face).id)
      complex_.above_base_[place_[face]] = t;
    else if (coarser.id != kNone.id)
      complex_.tetrahedra_[coarser.id].finer = t;
    lowest_[face] = t;
    complex_.tetrahedra_[t.id] = {number_[link], kNone, coarser};
    ++t.id;
  }

  void decide_signs() {
    const Side wrong = hull_.side() == HullSide::Outer ? Side::Inside : Side::Outside;
    complex_.is_flat_.reserve(complex_.size());
    for (std::uint32_t s = 0; s < complex_.stars_.size(); ++s)
      for (std::uint32_t t = complex_.stars_[s].first; t < complex_.stars_[s].end; ++t) {
        const auto [apex, a, b, c] = complex_[{VoidComplex::Neighbour::Kind::Tetrahedron, t, s}].corners;
        const Side found =
            side(complex_.position(a), complex_.position(b), complex_.position(c), complex_.position(apex));
        if (found == wrong)
          throw InputError(Defect::NoCertificate,
                           "a vertex of the hierarchy lies on the wrong side of a face that it stands for, so this is "
                           "no hierarchy of hulls; `prohull verify` says more");
        complex_.is_flat_.push_back(found == Side::On);
      }
  }

  const ProgressiveHull& hull_;
  VoidComplex& complex_;
  PerVertex<VertexId> number_;                // in the complex
  std::vector<std::uint32_t> star_of_split_;  // in the order of the record
  std::vector<Link> lowest_;                  // of the stack over each face
  std::vector<std::uint32_t> place_;          // of each base face in base_faces_
};

VoidComplex::VoidComplex(const ProgressiveHull& hull) { VoidComplexBuilder(hull, *this).build(); }

VoidComplex::Neighbour VoidComplex::tetrahedron(std::uint32_t id) const {
  const auto star = std::ranges::upper_bound(stars_, id, {}, &Star::end);
  return {Neighbour::Kind::Tetrahedron, id, static_cast<std::uint32_t>(star - stars_.begin())};
}

std::size_t VoidComplex::memory_bytes() const {
  return sizeof(*this) + stars_.capacity() * sizeof(Star) + tetrahedra_.capacity() * sizeof(Compact) +
         is_flat_.capacity() / 8 + below_original_.capacity() * sizeof(Link) + base_faces_.capacity() * sizeof(FaceId) +
         base_corners_.capacity() * sizeof(base_corners_[0]) + above_base_.capacity() * sizeof(Link);
}

namespace {

/// Flat tetrahedra of one plane, from one face to the next, and the original faces below them.
struct FlatFaces {
  int axis;  ///< along which no face of an area is seen edge-on
  std::vector<FaceId> upward, downward;
};

FlatFaces flat_part(const VoidComplex& complex, const VoidComplex::Neighbour& first, int axis,
                    std::vector<bool>& seen) {
  using Kind = VoidComplex::Neighbour::Kind;
  FlatFaces part{axis, {}, {}};
  std::vector<VoidComplex::Neighbour> waiting{first};
  seen[first.id] = true;
  while (!waiting.empty()) {
    const VoidComplex::Tetrahedron here = complex[waiting.back()];
    waiting.pop_back();
    for (std::size_t i = 0; i < 4; ++i) {
      const auto at = [&](std::size_t k) { return complex.position(here.corners[k <= i ? k - 1 : k]); };
      const int seen_turning = turn(axis, at(1), at(2), at(3));
      if (seen_turning == 0) continue;  // no line passes a face without area
      if (here.beyond[i].kind == Kind::OriginalFace)
        (seen_turning > 0 ? part.upward : part.downward).push_back(FaceId(here.beyond[i].id));
      if (here.beyond[i].kind != Kind::Tetrahedron || !complex.is_flat(here.beyond[i].id) || seen[here.beyond[i].id])
        continue;
      seen[here.beyond[i].id] = true;
      waiting.push_back(here.beyond[i]);
    }
  }
  return part;
}

}  // namespace

// From the void to the void at one point: through flat tetrahedra only, into the original by a face of one orientation
// and out of it by one of the other.
std::vector<FaceId> sheets_without_thickness(const VoidComplex& complex) {
  std::vector<FaceId> faces;
  std::vector<bool> seen(complex.size(), false);
  for (std::uint32_t f = 0; f < complex.original_face_count(); ++f) {
    const VoidComplex::Neighbour above = complex.beyond_original(FaceId(f));
    if (above.kind != VoidComplex::Neighbour::Kind::Tetrahedron || !complex.is_flat(above.id) || seen[above.id])
      continue;
    const auto [apex, a, b, c] = complex[above].corners;
    const auto axis = projection_axis({complex.position(a), complex.position(b), complex.position(c)});
    if (!axis) continue;
    const FlatFaces part = flat_part(complex, above, *axis, seen);
    if (part.upward.empty() || part.downward.empty()) continue;
    for (const auto* side : {&part.upward, &part.downward}) faces.insert(faces.end(), side->begin(), side->end());
  }
  std::ranges::sort(faces);
  return faces;
}

}  // namespace prohull
