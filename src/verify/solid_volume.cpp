#include "verify/solid_volume.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <utility>

#include "geometry/triangle_predicates.h"
#include "prohull/detail/disjoint_sets.h"
#include "verify/arrangement.h"
#include "verify/cell.h"
#include "verify/known_solid.h"
#include "verify/winding.h"

namespace prohull::verify {
namespace {

/// By how much the volume of the solid grows where its boundary passes a piece of a face from inside to outside.
int steps_out(int outside, int inside) { return int(inside >= 1) - int(outside >= 1); }

constexpr std::size_t kMostSteps = 5'000'000;  // some seconds

/// Visits the boundary of the solid.
class Boundary {
 public:
  using Visit = std::function<void(const BoundaryPiece&)>;

  /// Throws OutOfSteps.
  Boundary(const Surface& surface, const FacePairs& pairs, ProgressMeter& meter, Visit visit)
      : surface_(surface),
        meter_(meter),
        visit_(std::move(visit)),
        meets_(surface.faces.size()),
        steps_(meter, kMostSteps) {
    for (const auto& [f, g] : pairs) meets_[f].push_back(g), meets_[g].push_back(f);
    std::size_t segments = 0;  // that are looked at beside each other
    for (const std::vector<FaceIndex>& meets : meets_) segments += meets.size() * meets.size();
    if (segments > kMostSteps) throw OutOfSteps();
    add_free_faces();
    std::size_t seen = 0;
    for (FaceIndex f = 0; f < meets_.size(); ++f)
      if (!meets_[f].empty()) {
        add_parts(f);
        seen += meets_[f].size() * meets_[f].size();
        if (are_too_many(double(seen), double(segments))) throw OutOfSteps();
      }
  }

 private:
  /// Steps go with segments, about: of 10,000 overlapping icosahedra 1.35 to 1.36 each, from the first faces on.
  bool are_too_many(double seen, double segments) const {
    constexpr double kEnough = 0.05 * kMostSteps, kFarTooMany = 1.25 * kMostSteps;
    return seen > kEnough && double(steps_.taken()) * segments > kFarTooMany * seen;
  }

  /// Faces that meet no others are joined where an edge has two of them and no third.
  void add_free_faces() {
    DisjointSets clusters(meets_.size());
    const std::vector<FaceEdge> sides = edges(surface_);
    for (std::size_t i = 0, end; i < sides.size(); i = end) {
      for (end = i; end < sides.size() && sides[end].key == sides[i].key;) ++end;
      const FaceIndex f = sides[i].face, g = sides[end - 1].face;
      if (end - i == 2 && meets_[f].empty() && meets_[g].empty()) clusters.join(f, g);
    }
    std::vector<int> steps(meets_.size());  // by representative, which comes first in its cluster
    for (FaceIndex f = 0; f < meets_.size(); ++f) {
      meter_.go_on();
      if (!meets_[f].empty()) continue;
      const FaceIndex r = clusters.find(f);
      const Triangle& t = surface_.faces[f];
      if (r == f) steps[f] = steps_at(f);
      add(t.a, t.b, t.c, steps[r]);
    }
  }

  /// Where faces of one plane lie on each other, the first of them counts.
  void add_parts(FaceIndex f) {
    const Triangle& t = surface_.faces[f];
    std::vector<Triangle> crossing, holders;
    for (const FaceIndex g : meets_[f]) {
      const Triangle& h = surface_.faces[g];
      if (!coplanar(t, h))
        crossing.push_back(h);
      else if (g < f)
        holders.push_back(h);
    }
    Arrangement parts(t, surface_.axis[f], random_, steps_);
    parts.add(0, surface_, crossing);
    if (!holders.empty()) parts.add_holders(holders);
    parts.visit_parts([](const Windings& w) { return w.holders > 0 ? 0 : steps_out(w.outside[0], w.inside[0]); },
                      [&](const Triangle& part, int times) { add(part.a, part.b, part.c, times); });
  }

  int steps_at(FaceIndex f) {
    const Cell cell = whole_cell(surface_.faces[f], surface_.axis[f]);
    SurfacePoint p(surface_.faces[f], surface_.axis[f], cell, random_);
    const WindingBeside w = winding_beside(surface_, p, cell, random_);
    return steps_out(w.outside, w.inside);
  }

  void add(const Vec3& a, const Vec3& b, const Vec3& c, int times) { visit_({{a, b, c}, times}); }

  const Surface& surface_;
  ProgressMeter& meter_;
  Visit visit_;
  std::vector<std::vector<FaceIndex>> meets_;
  Steps steps_;
  std::mt19937 random_;  // the volume depends on it by rounding only, and it always starts the same
};

}  // namespace

double solid_volume(const TriangleMesh& mesh, ProgressMeter& meter) { return KnownSolid(mesh, "given").volume(meter); }

double solid_volume(const Surface& surface, const FacePairs& pairs, ProgressMeter& meter) {
  Box box;
  for (const Triangle& t : surface.faces)
    for (const Vec3& p : {t.a, t.b, t.c}) box.extend(p);
  const Vec3 origin = box.center();
  double sum = 0;
  try {
    Boundary(surface, pairs, meter, [&](const BoundaryPiece& piece) {
      const auto& [a, b, c] = piece.triangle;
      sum += piece.times * dot(a - origin, cross(b - origin, c - origin)) / 6;
    });
  } catch (const OutOfSteps&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return sum;
}

std::optional<std::vector<BoundaryPiece>> solid_boundary(const TriangleMesh& mesh, ProgressMeter& meter) {
  KnownSolid solid(mesh, "given");
  std::vector<BoundaryPiece> pieces;
  try {
    Boundary(solid.surface(), solid.pairs_of_surface(meter), meter,
             [&](const BoundaryPiece& piece) { pieces.push_back(piece); });
  } catch (const OutOfSteps&) {
    return std::nullopt;
  }
  return pieces;
}

}  // namespace prohull::verify

namespace prohull {

std::optional<double> solid_volume(const TriangleMesh& mesh, const Progress& progress) {
  ProgressMeter meter(progress, "verify");
  const double volume = verify::solid_volume(mesh, meter);
  return std::isnan(volume) ? std::nullopt : std::optional(volume);
}

}  // namespace prohull
