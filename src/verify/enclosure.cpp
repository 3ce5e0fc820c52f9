#include "prohull/enclosure.h"

#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "geometry/interior_contact.h"
#include "parallel/progress_meter.h"
#include "prohull/error.h"
#include "verify/holes.h"
#include "verify/offenders.h"
#include "verify/self_intersection.h"
#include "verify/solids.h"
#include "verify/subdivision.h"
#include "verify/surface.h"
#include "verify/winding.h"

// Why the decision is complete. Let w_O and w_H be the winding numbers of the inner and the outer surface, and X the
// open set where w_O >= 1 and w_H < 1: the mesh is enclosed if and only if X is empty. X is bounded, so if it is not
// empty it has a boundary, made of faces of the arrangement of both surfaces.
//
//   (1) X lies beside some part of a triangle of O. check_inner_faces visits every triangle of O, cut along H (and
//       O, where that matters), so that w_H and w_O are constant beside each piece, and evaluates one point of each:
//       X is found.
//   (2) X lies beside none. Then its boundary lies on H alone, and is made of whole pieces of faces of H as H cuts
//       itself: where O crosses such a piece or covers a part of it, on the side of X, X would lie beside O; and where
//       O only touches it from the other side, X goes on. find_holes evaluates one point of each piece: X is
//       found. A point that lies on O needs no answer: its piece does not bound X.
//
// What is found is a point beside which w_O >= 1 and w_H < 1, evaluated exactly; so what is rejected does not enclose.
// Triangles of O whose interior H does not meet lie in one region of H, together with their neighbours, if some point
// of the common edge is not on H: one evaluation answers for all of them.

namespace prohull {
namespace verify {
namespace {

/// What an evaluation says about the two sides of a piece of a triangle.
struct Sides {
  bool outside = false, inside = false;
  bool any() const { return outside || inside; }
};

class Verifier {
 public:
  Verifier(const Surface& inner, const Surface& outer, const EnclosureOptions& options)
      : inner_(inner), outer_(outer), options_(options), meter_(options.progress, "verify") {}

  EnclosureReport report() {
    check_inner_faces();
    const Holes holes = find_holes();
    report_.self_intersections = holes.self_intersections;
    report_.cavities = holes.count;
    report_.faces_outside = offenders_.size();
    report_.worst = worst_of(std::move(offenders_), options_.max_offenders);
    report_.encloses = report_.faces_outside == 0 && report_.cavities == 0;
    report_.inner_volume = inner_.volume;
    report_.outer_volume = outer_.volume;
    if (inner_.volume != 0) report_.void_ratio = (outer_.volume - inner_.volume) / inner_.volume;
    meter_.at(1);
    return report_;
  }

  /// Looks for pieces of H beside which w_H < 1, in the midst of O.
  Holes find_holes() {
    const auto pairs = self_intersections(outer_, meter_);
    std::vector<std::vector<FaceIndex>> meets(outer_.faces.size());
    for (const auto& [f, g] : pairs) meets[f].push_back(g), meets[g].push_back(f);
    Holes holes = find_holes([&](FaceIndex f) {
      Neighbours near;
      for (const FaceIndex g : meets[f]) near.add(outer_.faces[f], outer_.axis[f], outer_.faces[g]);
      return subdivide(outer_.faces[f], outer_.axis[f], near.cutters, meter_);
    });
    holes.self_intersections = pairs.size();
    return holes;
  }

  /// The same with pieces of each face that are given.
  template <class CellsOf>
  Holes find_holes(CellsOf cells_of) {
    Holes holes;
    std::vector<std::uint8_t> bounds_hole(outer_.faces.size());
    for (FaceIndex f = 0; f < outer_.faces.size(); ++f) {
      if (f % 64 == 0) meter_.at(0.8 + 0.2 * double(f) / double(outer_.faces.size()));
      for (const Cell& cell : cells_of(f)) {
        meter_.go_on();
        const auto point = beside_a_hole(f, cell);
        if (!point) continue;
        holes.point = *point;
        bounds_hole[f] = 1;
        break;
      }
    }
    Clusters clusters(outer_.faces.size());
    join_along_edges(outer_, clusters, [&](const FaceEdge& e) { return bounds_hole[e.face] != 0; });
    for (FaceIndex f = 0; f < outer_.faces.size(); ++f)
      if (bounds_hole[f] && clusters.representative(f) == f) ++holes.count;
    return holes;
  }

  /// All pieces of face f as H cuts it.
  std::vector<Cell> pieces_of(FaceIndex f) {
    return subdivide(outer_.faces[f], outer_.axis[f], neighbours(outer_, f, outer_, f).cutters, meter_);
  }

 private:
  /// The faces of a surface that cut a triangle, and the edges of the triangle that they may cover.
  struct Neighbours {
    std::vector<Triangle> cutters;
    bool touches_interior = false;
    std::uint8_t edges = 0;

    void add(const Triangle& t, int axis, const Triangle& other) {
      const TriangleContact c = interior_contact(t, axis, other);
      edges |= c.edges;
      touches_interior |= c.interior != Contact::None;
      if (c.interior == Contact::Crossing || c.interior == Contact::Covering) cutters.push_back(other);
    }
  };

  struct Sample {
    const Cell* cell;
    SurfacePoint point;
    Sides uncovered;  // w_H < 1
  };

  void check_inner_faces() {
    Clusters clusters(inner_.faces.size());
    std::vector<std::uint8_t> is_free(inner_.faces.size());        // H does not meet the interior
    std::vector<std::uint8_t> open_edges(inner_.faces.size(), 0);  // bit e: edge e is not on H
    for (FaceIndex f = 0; f < inner_.faces.size(); ++f) {
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
    for (FaceIndex f = 0; f < inner_.faces.size(); ++f) {
      if (!is_free[f]) continue;
      const FaceIndex r = clusters.representative(f);
      if (r == f)
        is_uncovered[r] = uncovered_sample(inner_, f, whole_cell(inner_.faces[f], inner_.axis[f])).uncovered.any();
      if (is_uncovered[r]) check_inner_face(f, {});
    }
  }

  /// Looks for a point beside face f of O where w_H < 1 and w_O >= 1; `cutters` are the faces of H that cut it.
  void check_inner_face(FaceIndex f, std::vector<Triangle> cutters) {
    const Triangle& t = inner_.faces[f];
    std::vector<Cell> cells = subdivide(t, inner_.axis[f], cutters, meter_);
    std::vector<Sample> suspects = uncovered_samples(f, cells);
    if (suspects.empty() || find_outside(f, suspects)) return;
    // Only where O intersects itself, w_O can differ between the points of a piece.
    const Neighbours near = neighbours(inner_, f, inner_, f);
    if (near.cutters.empty()) return;
    cutters.insert(cutters.end(), near.cutters.begin(), near.cutters.end());
    cells = subdivide(t, inner_.axis[f], cutters, meter_);
    suspects = uncovered_samples(f, cells);
    find_outside(f, suspects);
  }

  /// Whether one of the samples lies beside a point where w_H < 1 and w_O >= 1. Adds the farthest to the offenders.
  bool find_outside(FaceIndex f, std::vector<Sample>& suspects) {
    std::optional<Offender> farthest;
    for (Sample& s : suspects) {
      meter_.go_on();
      const WindingBeside w = winding_beside(inner_, s.point, *s.cell, random_);
      if ((s.uncovered.outside && w.outside >= 1) || (s.uncovered.inside && w.inside >= 1)) {
        const Offender offender = farthest_of(f, s);
        if (!farthest || offender.distance > farthest->distance) farthest = offender;
      }
    }
    if (farthest) offenders_.push_back(*farthest);
    return farthest.has_value();
  }

  std::vector<Sample> uncovered_samples(FaceIndex f, const std::vector<Cell>& cells) {
    std::vector<Sample> result;
    for (const Cell& cell : cells) {
      meter_.go_on();
      Sample s = uncovered_sample(inner_, f, cell);
      if (s.uncovered.any()) result.push_back(std::move(s));
    }
    return result;
  }

  Sample uncovered_sample(const Surface& surface, FaceIndex f, const Cell& cell) {
    Sample s{&cell, SurfacePoint(surface.faces[f], surface.axis[f], cell, random_), {}};
    const WindingBeside w = winding_beside(outer_, s.point, cell, random_);
    s.uncovered = {w.outside < 1, w.inside < 1};
    return s;
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
  static void join_along_edges(const Surface& surface, Clusters& clusters, Joins joins) {
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

  /// Of the sample and the corners of its piece, all of them outside or at the border of the outside.
  Offender farthest_of(FaceIndex f, const Sample& s) const {
    std::vector<Vec3> points{s.point.rounded()};
    for (const PlanePoint& corner : *s.cell) points.push_back(rounded(lifted(inner_.faces[f], inner_.axis[f], corner)));
    return farthest(inner_.source[f], points, outer_);
  }

  const Surface &inner_, &outer_;
  const EnclosureOptions& options_;
  ProgressMeter meter_;
  std::mt19937 random_;  // the verdict does not depend on it
  std::vector<Offender> offenders_;
  EnclosureReport report_;
};

}  // namespace

EnclosureReport verify_enclosure(const Surface& inner, const Surface& outer, const EnclosureOptions& options) {
  return Verifier(inner, outer, options).report();
}

Holes find_holes(const Surface& inner, const Surface& outer, const OpenCells& open_cells, const Progress& progress) {
  const EnclosureOptions options{.progress = progress};
  Verifier verifier(inner, outer, options);
  return verifier.find_holes([&](FaceIndex f) {
    auto cells = open_cells(f);
    return cells ? *cells : verifier.pieces_of(f);
  });
}

}  // namespace verify

EnclosureReport verify_enclosure(const TriangleMesh& inner, const TriangleMesh& outer,
                                 const EnclosureOptions& options) {
  return verify::verify_enclosure(verify::Surface(inner, "inner"), verify::Surface(outer, "outer"), options);
}

}  // namespace prohull
