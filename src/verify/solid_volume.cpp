#include "verify/solid_volume.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "geometry/triangle_predicates.h"
#include "verify/cell.h"
#include "verify/known_solid.h"
#include "verify/surface.h"
#include "verify/winding.h"

namespace prohull::verify {
namespace {

/// By how much the volume of the solid grows where its boundary passes a piece of a face from inside to outside.
int steps_out(const WindingBeside& w) { return int(w.inside >= 1) - int(w.outside >= 1); }

using FlatCell = std::vector<Vec3>;

struct TooManyCells {};
constexpr std::size_t kMostCells = 100'000;  // some seconds

Vec3 doubled_area(const FlatCell& cell) {
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < cell.size(); ++i) sum += cross(cell[i] - cell[0], cell[i + 1] - cell[0]);
  return sum;
}

/// Visits the boundary of the solid, in pieces beside which the winding numbers are constant.
class Boundary {
 public:
  using Visit = std::function<void(const BoundaryPiece&)>;

  /// Throws TooManyCells.
  Boundary(const Surface& surface, const FacePairs& pairs, ProgressMeter& meter, Visit visit)
      : surface_(surface), meter_(meter), visit_(std::move(visit)), meets_(surface.faces.size()) {
    if (2 * pairs.size() > kMostCells) throw TooManyCells();  // nearly all of them cut cells
    for (const auto& [f, g] : pairs) meets_[f].push_back(g), meets_[g].push_back(f);
    add_free_faces();
    for (FaceIndex f = 0; f < meets_.size(); ++f)
      if (!meets_[f].empty()) add_cells(f);
  }

 private:
  /// Faces that meet no others are joined where an edge has two of them and no third.
  void add_free_faces() {
    Clusters clusters(meets_.size());
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
      const FaceIndex r = clusters.representative(f);
      const Triangle& t = surface_.faces[f];
      if (r == f) steps[f] = steps_at(f, whole_cell(t, surface_.axis[f])).first;
      add(t.a, t.b, t.c, steps[r]);
    }
  }

  void add_cells(FaceIndex f) {
    const int axis = surface_.axis[f], u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const FlatCell& cell : cells_of(f)) {
      meter_.go_on();
      Cell projected;
      for (const Vec3& p : cell) projected.push_back({Number(p[u]), Number(p[v])});
      const auto [steps, holders] = steps_at(f, projected);
      for (std::size_t i = 1; i + 1 < cell.size(); ++i)
        add(cell[0], cell[i], cell[i + 1], static_cast<double>(steps) / holders);
    }
  }

  /// Pieces of face f, rounded, that no other face crosses in more than rounding.
  std::vector<FlatCell> cells_of(FaceIndex f) {
    const Triangle& t = surface_.faces[f];
    const Vec3 normal = cross(t.b - t.a, t.c - t.a);
    std::vector<FlatCell> cells{{t.a, t.b, t.c}};
    for (const FaceIndex g : meets_[f]) {
      const Triangle& h = surface_.faces[g];
      if (!coplanar(t, h)) {
        cut(cells, h, cross(h.b - h.a, h.c - h.a), h.a);
      } else {
        for (const auto& [p, q] : {std::pair(h.a, h.b), std::pair(h.b, h.c), std::pair(h.c, h.a)})
          cut(cells, h, cross(q - p, normal), p);
      }
    }
    constexpr double kSliver = 1e-12;  // of the face's area: nothing but rounding
    std::erase_if(cells, [&](const FlatCell& cell) { return norm(doubled_area(cell)) <= kSliver * norm(normal); });
    return cells;
  }

  /// Cuts the cells near h by the plane through p.
  void cut(std::vector<FlatCell>& cells, const Triangle& h, const Vec3& normal, const Vec3& p) {
    for (std::size_t i = 0, count = cells.size(); i < count; ++i) {
      Box box;
      for (const Vec3& corner : cells[i]) box.extend(corner);
      if (!box.overlaps(box_of(h))) continue;
      FlatCell above, below;
      bool is_above = false, is_below = false;  // anywhere; a needle whose normal vanishes cuts nothing
      for (std::size_t c = 0; c < cells[i].size(); ++c) {
        const Vec3 &from = cells[i][c], &to = cells[i][(c + 1) % cells[i].size()];
        const double d = dot(normal, from - p), e = dot(normal, to - p);
        is_above |= d > 0, is_below |= d < 0;
        if (d >= 0) above.push_back(from);
        if (d <= 0) below.push_back(from);
        if ((d < 0 && e > 0) || (d > 0 && e < 0)) {
          const Vec3 middle = from + (to - from) * (d / (d - e));
          above.push_back(middle), below.push_back(middle);
        }
      }
      if (!is_above || !is_below) continue;
      if (++cells_ > kMostCells) throw TooManyCells();
      cells[i] = std::move(above);
      cells.push_back(std::move(below));
    }
  }

  /// At a random point of the cell; and how many faces of one plane hold it, which all have this cell.
  std::pair<int, int> steps_at(FaceIndex f, const Cell& cell) {
    SurfacePoint p(surface_.faces[f], surface_.axis[f], cell, random_);
    WindingBeside w;
    try {
      w = winding_beside(surface_, p, cell, random_);
    } catch (const std::logic_error&) {  // the rounded cell is a sliver along another face, and has no volume
      return {0, 1};
    }
    int holders = 1;
    for (const FaceIndex g : meets_[f]) {
      if (!coplanar(surface_.faces[f], surface_.faces[g])) continue;
      const auto turns = p.turns(surface_.faces[g]);
      holders += std::ranges::all_of(turns, [](int turn) { return turn > 0; }) ||
                 std::ranges::all_of(turns, [](int turn) { return turn < 0; });
    }
    return {steps_out(w), holders};
  }

  void add(const Vec3& a, const Vec3& b, const Vec3& c, double times) { visit_({{a, b, c}, times}); }

  const Surface& surface_;
  ProgressMeter& meter_;
  Visit visit_;
  std::vector<std::vector<FaceIndex>> meets_;
  std::size_t cells_ = 0;
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
  } catch (const TooManyCells&) {
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
  } catch (const TooManyCells&) {
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
