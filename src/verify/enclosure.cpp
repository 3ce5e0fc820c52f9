#include "prohull/enclosure.h"
#include "prohull/detail/disjoint_sets.h"

#include <fmt/format.h>

#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "geometry/interior_contact.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/detail/text.h"
#include "prohull/error.h"
#include "verify/arrangement.h"
#include "verify/cell.h"
#include "verify/offenders.h"
#include "verify/self_intersection.h"
#include "verify/solids.h"
#include "verify/surface.h"
#include "verify/winding.h"

// Why the decision is complete. Let w_O and w_H be the winding numbers of the inner and the outer surface, and X the
// open set where w_O >= 1 and w_H < 1: the mesh is enclosed if and only if X is empty. X is bounded, so if it is not
// empty it has a boundary, made of faces of the arrangement of both surfaces.
//
//   (1) X lies beside some part of a triangle of O. check_inner_faces visits every triangle of O, which H (and O, where
//       that matters) divide into parts beside which w_H and w_O are constant. An Arrangement knows both beside each: X
//       is found.
//   (2) X lies beside none, or only beside parts of O that H holds, with w_H >= 1 on their other side. Then its
//   boundary lies on H alone, and is made of whole pieces of faces of H as H cuts
//       itself: where O crosses such a piece or covers a part of it, on the side of X, X would lie beside O; and where
//       O only touches it from the other side, X goes on. find_holes looks beside each piece: X is found. A piece that
//       lies on O needs no answer: it does not bound X.
//
// A triangle of O lies outside where w_H < 1 on both of its sides. If X lies beside one, but none lies outside, then
// w_H >= 1 all around X: X is all of some regions of H, but for surfaces, and find_holes finds these as well.
//
// What is found is a point beside which w_O >= 1 and w_H < 1, exactly; so what is rejected does not enclose.
// Triangles of O whose interior H does not meet lie in one region of H, together with their neighbours, if some point
// of the common edge is not on H: one evaluation answers for all of them.

namespace prohull {
namespace verify {
namespace {

constexpr std::size_t kO = 0, kH = 1;  // in an Arrangement

bool is_solid_there(const Windings& w) { return w.outside[kO] >= 1 || w.inside[kO] >= 1; }
bool is_open_there(const Windings& w) { return w.outside[kH] < 1 || w.inside[kH] < 1; }
bool is_x_there(const Windings& w) {
  return (w.outside[kO] >= 1 && w.outside[kH] < 1) || (w.inside[kO] >= 1 && w.inside[kH] < 1);
}
/// Beside X, and no part of the solid that H bounds.
bool lies_outside(const Windings& w) { return w.outside[kH] < 1 && w.inside[kH] < 1 && is_solid_there(w); }

class Verifier {
 public:
  Verifier(const Surface& inner, const Surface& outer, const EnclosureOptions& options)
      : inner_(inner),
        outer_(outer),
        options_(options),
        meter_(options.progress, "verify"),
        steps_(meter_, options.max_steps) {}

  EnclosureReport report() {
    check_inner_faces();
    x_is_off_o_ = !x_is_beside_o_ && undecided_ == 0;
    const FacePairs pairs = self_intersections(outer_, meter_);
    const Holes holes = offenders_.empty() ? find_holes(pairs) : Holes{};
    report_.self_intersections = pairs.size();
    report_.cavities = holes.count;
    report_.faces_undecided = undecided_ + holes.undecided;
    report_.faces_outside = offenders_.size();
    report_.worst = worst_of(std::move(offenders_), options_.max_offenders);
    report_.encloses = report_.faces_outside == 0 && report_.cavities == 0 && report_.faces_undecided == 0;
    report_.inner_volume = inner_.volume;
    report_.outer_volume = outer_.volume;
    if (inner_.volume != 0) report_.void_ratio = (outer_.volume - inner_.volume) / inner_.volume;
    meter_.at(1);
    return report_;
  }

  /// Looks for pieces of H beside which w_H < 1, in the midst of O; `pairs` are the self_intersections of H.
  Holes find_holes(const FacePairs& pairs) {
    std::vector<std::vector<FaceIndex>> meets(outer_.faces.size());
    for (const auto& [f, g] : pairs) meets[f].push_back(g), meets[g].push_back(f);
    return find_holes([&](FaceIndex f) {
      Neighbours near;
      for (const FaceIndex g : meets[f]) near.add(outer_.faces[f], outer_.axis[f], outer_.faces[g]);
      return beside_a_hole(f, near.cutters);
    });
  }

  /// The same if point_of(f) is a point of the face that is beside a hole, if there is one.
  template <class PointOf>
  Holes find_holes(PointOf point_of) {
    Holes holes;
    std::vector<std::uint8_t> bounds_hole(outer_.faces.size());
    for (FaceIndex f = 0; f < outer_.faces.size(); ++f) {
      if (f % 64 == 0) meter_.at(0.8 + 0.2 * double(f) / double(outer_.faces.size()));
      try {
        const std::optional<Vec3> point = point_of(f);
        if (!point) continue;
        holes.point = *point;
        bounds_hole[f] = 1;
      } catch (const OutOfSteps&) {
        ++holes.undecided;
      }
    }
    DisjointSets clusters(outer_.faces.size());
    join_along_edges(outer_, clusters, [&](const FaceEdge& e) { return bounds_hole[e.face] != 0; });
    for (FaceIndex f = 0; f < outer_.faces.size(); ++f)
      if (bounds_hole[f] && clusters.find(f) == f) ++holes.count;
    return holes;
  }

  /// A point of one of these cells of face f that is beside a hole.
  std::optional<Vec3> beside_a_hole(FaceIndex f, const std::vector<Cell>& cells) {
    for (const Cell& cell : cells) {
      meter_.go_on();
      if (const auto point = beside_a_hole(f, cell)) return point;
    }
    return std::nullopt;
  }

  /// A point of face f that is beside a hole.
  std::optional<Vec3> beside_a_hole(FaceIndex f) { return beside_a_hole(f, neighbours(outer_, f, outer_, f).cutters); }

 private:
  /// The faces of a surface that meet the inside of a triangle in segments, and the edges of the triangle that they may
  /// cover.
  struct Neighbours {
    std::vector<Triangle> cutters;
    bool touches_interior = false;
    bool is_same = false;  // one of them has the same corners
    std::uint8_t edges = 0;

    void add(const Triangle& t, int axis, const Triangle& other) {
      const TriangleContact c = interior_contact(t, axis, other);
      edges |= c.edges;
      touches_interior |= c.interior != Contact::None;
      is_same |= c.interior == Contact::Same;
      if (c.interior == Contact::Crossing) cutters.push_back(other);
    }
  };

  bool is_enough() const { return offenders_.size() > options_.most_outside; }

  void check_inner_faces() {
    DisjointSets clusters(inner_.faces.size());
    std::vector<std::uint8_t> is_free(inner_.faces.size());        // H does not meet the interior
    std::vector<std::uint8_t> open_edges(inner_.faces.size(), 0);  // bit e: edge e is not on H
    for (FaceIndex f = 0; f < inner_.faces.size() && !is_enough(); ++f) {
      if (f % 64 == 0) meter_.at(0.7 * double(f) / double(inner_.faces.size()));
      const Neighbours near = neighbours(inner_, f, outer_);
      if (near.touches_interior) {
        check_inner_face(f, near.cutters);
      } else {
        is_free[f] = 1;
        open_edges[f] = std::uint8_t(~near.edges & 7);
      }
    }
    const auto joins = [&](const FaceEdge& e) { return is_free[e.face] && (open_edges[e.face] >> e.edge & 1); };
    join_along_edges(inner_, clusters, joins);
    std::vector<std::uint8_t> is_uncovered(inner_.faces.size());  // by representative, which comes first in its cluster
    for (FaceIndex f = 0; f < inner_.faces.size() && !is_enough(); ++f) {
      if (!is_free[f]) continue;
      const FaceIndex r = clusters.find(f);
      if (r == f) is_uncovered[r] = is_uncovered_somewhere(f);
      if (is_uncovered[r]) check_inner_face(f, {});
    }
  }

  /// Looks for X beside face f of O, and for parts of it that lie outside; `cutters` are the faces of H that cut it.
  void check_inner_face(FaceIndex f, const std::vector<Triangle>& cutters) {
    try {
      const std::vector<Vec3> points = points_outside(f, cutters);
      if (!points.empty()) offenders_.push_back(farthest(inner_.source[f], points, outer_));
    } catch (const OutOfSteps&) {
      ++undecided_;
    }
  }

  std::vector<Vec3> points_outside(FaceIndex f, const std::vector<Triangle>& cutters) {
    const Triangle& t = inner_.faces[f];
    Arrangement parts(t, inner_.axis[f], random_, steps_);
    parts.add(kH, outer_, cutters);
    if (!parts.has_part(is_open_there)) return {};
    parts.add(kO, inner_, neighbours(inner_, f, inner_, f).cutters);
    if (!parts.has_part(is_x_there)) return {};
    x_is_beside_o_ = true;
    return parts.points_of_parts(lies_outside);
  }

  /// Of a face of O that H does not cut.
  bool is_uncovered_somewhere(FaceIndex f) {
    const Cell cell = whole_cell(inner_.faces[f], inner_.axis[f]);
    SurfacePoint p(inner_.faces[f], inner_.axis[f], cell, random_);
    const WindingBeside w = winding_beside(outer_, p, cell, random_);
    return w.outside < 1 || w.inside < 1;
  }

  /// A point of face f of H, which faces of H cut, that is beside a hole.
  std::optional<Vec3> beside_a_hole(FaceIndex f, const std::vector<Triangle>& cutters) {
    if (cutters.empty()) return beside_a_hole(f, whole_cell(outer_.faces[f], outer_.axis[f]));
    const Neighbours inner = neighbours(outer_, f, inner_);
    if (inner.is_same && x_is_off_o_) return std::nullopt;
    Arrangement parts(outer_.faces[f], outer_.axis[f], random_, steps_);
    parts.add(kO, inner_, inner.cutters);
    if (!parts.has_part(is_solid_there)) return std::nullopt;
    parts.add(kH, outer_, cutters);
    const std::vector<Vec3> points = parts.points_of_parts(is_x_there);
    return points.empty() ? std::nullopt : std::optional(points.front());
  }

  /// A point of the piece of face f, if a side of it lies in the midst of O and w_H < 1 there.
  std::optional<Vec3> beside_a_hole(FaceIndex f, const Cell& cell) {
    SurfacePoint p(outer_.faces[f], outer_.axis[f], cell, random_);
    if (!winding_beside(inner_, p, cell, random_).is_cover()) return std::nullopt;
    const WindingBeside outer = winding_beside(outer_, p, cell, random_);
    const WindingBeside inner = winding_beside(inner_, p, cell, random_);  // p may have moved
    if ((outer.outside < 1 && inner.outside >= 1) || (outer.inside < 1 && inner.inside >= 1)) return p.rounded();
    return std::nullopt;
  }

  /// How other faces of `of` meet face f of `on`; `itself` is left out.
  Neighbours neighbours(const Surface& on, FaceIndex f, const Surface& of, std::optional<FaceIndex> itself = {}) const {
    Neighbours result;
    const Box box = box_of(on.faces[f]);
    of.bvh.visit([&](const Box& other) { return box.overlaps(other); },
                 [&](FaceIndex g) {
                   if (g != itself) result.add(on.faces[f], on.axis[f], of.faces[g]);
                 });
    return result;
  }

  template <class Joins>
  static void join_along_edges(const Surface& surface, DisjointSets& clusters, Joins joins) {
    const std::vector<FaceEdge> sides = edges(surface);
    for (std::size_t i = 0, end; i < sides.size(); i = end) {
      std::optional<FaceIndex> first;
      for (end = i; end < sides.size() && sides[end].key == sides[i].key; ++end) {
        if (!joins(sides[end])) continue;
        if (first)
          clusters.join(*first, sides[end].face);
        else
          first = sides[end].face;
      }
    }
  }

  const Surface &inner_, &outer_;
  const EnclosureOptions& options_;
  ProgressMeter meter_;
  Steps steps_;
  std::mt19937 random_;  // the verdict does not depend on it
  std::vector<Offender> offenders_;
  std::size_t undecided_ = 0;   // faces of O
  bool x_is_beside_o_ = false;  // X was found beside a triangle of O
  bool x_is_off_o_ = false;     // it is known that X lies beside no triangle of O
  EnclosureReport report_;
};

}  // namespace

EnclosureReport verify_enclosure(const Surface& inner, const Surface& outer, const EnclosureOptions& options) {
  return Verifier(inner, outer, options).report();
}

// Inside out, it winds at least once around such points.
Answer winds_negatively(TriangleMesh mesh, std::size_t most_steps, const Progress& progress) {
  for (auto& corners : mesh.triangles) std::swap(corners[1], corners[2]);
  const Surface inside_out(mesh, "given", Turning::Never), nothing;
  const EnclosureReport report = verify_enclosure(
      inside_out, nothing, {.max_offenders = 0, .most_outside = 0, .progress = progress, .max_steps = most_steps});
  const Answer is_empty = answer_of(report);
  return is_empty == Answer::Yes ? Answer::No : is_empty == Answer::No ? Answer::Yes : Answer::Undecided;
}

std::string undecided(std::size_t faces) {
  return fmt::format("the search was ended before {} {} decided; allow more steps", counted(faces, "face"),
                     faces == 1 ? "was" : "were");
}

Holes find_holes(const Surface& inner, const Surface& outer, const OpenCells& open_cells,
                 const EnclosureOptions& options) {
  Verifier verifier(inner, outer, options);
  return verifier.find_holes([&](FaceIndex f) {
    const auto cells = open_cells(f);
    return cells ? verifier.beside_a_hole(f, *cells) : verifier.beside_a_hole(f);
  });
}

}  // namespace verify

EnclosureReport verify_enclosure(const TriangleMesh& inner, const TriangleMesh& outer,
                                 const EnclosureOptions& options) {
  return verify::verify_enclosure(verify::Surface(inner, "inner"), verify::Surface(outer, "outer"), options);
}

}  // namespace prohull
