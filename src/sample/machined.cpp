#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include "sample/add_quad.h"
#include "sample/generators.h"
#include "sample/index_of_key.h"

namespace prohull {
namespace {

/// A multiple of 2^-20: planes stay exactly planar, and below 8 a float32 holds it.
double dyadic(double x) { return std::round(x * 0x1p20) * 0x1p-20; }

struct Vec2 {
  double u, v;
};

/// Where an opening about the origin meets the way from a point of the boundary of its cells inwards.
using Outline = std::function<Vec2(const Vec2&)>;

Outline square(double half_side) {
  return [=](const Vec2& p) -> Vec2 {
    const double scale = half_side / std::max(std::abs(p.u), std::abs(p.v));
    return {scale * p.u, scale * p.v};
  };
}

/// Two half circles and the sides between; a circle if half_length is 0.
Outline slot(double half_length, double radius) {
  return [=](const Vec2& p) -> Vec2 {
    const double core = std::clamp(p.u, -half_length, half_length), du = p.u - core;
    const double scale = radius / std::sqrt(du * du + p.v * p.v);
    return {core + scale * du, scale * p.v};
  };
}
Outline circle(double radius) { return slot(0, radius); }

/// From one plane of the part to another.
struct CellRange {
  std::uint32_t first, last;
};

/// The outline of an opening at a height along its axis. Between two rings of equal height lies a flat shoulder.
struct Ring {
  double height;
  Outline outline;
};

/// An opening through the part along `axis`, u and v being the next two axes in cyclic order. Its surface, the ends of
/// its cells included, joins ring to ring, from the cells' boundary at the upper end to that at the lower end.
struct Bore {
  std::size_t axis;
  CellRange u, v, w;        // the cells it is cut from, w along the axis
  std::vector<Ring> rings;  // from the upper end down
};

/// Cut from a block of cells between axis-parallel planes at dyadic coordinates.
struct Part {
  std::array<std::vector<double>, 3> planes;
  std::function<bool(std::uint32_t x, std::uint32_t y, std::uint32_t z)> is_solid;
  std::vector<Bore> bores;
};

/// The surface of a part, every interval between planes and every span between rings being divided evenly.
class PartMesher {
 public:
  explicit PartMesher(const Part& part) : part_(part) {
    for (std::size_t axis = 0; axis < 3; ++axis) divisions_[axis].assign(part.planes[axis].size() - 1, 1);
    for (const Bore& bore : part.bores) bore_divisions_.emplace_back(bore.rings.size() + 1, 1);
    find_panels();
  }

  TriangleMesh mesh(std::size_t faces) {
    divide(faces);
    for (std::size_t axis = 0; axis < 3; ++axis) cut_lines(axis);
    mesh_.triangles.reserve(face_count());
    for (const Panel& panel : panels_) add_panel(panel);
    for (std::size_t b = 0; b < part_.bores.size(); ++b) add_bore(part_.bores[b], bore_divisions_[b]);
    return std::move(mesh_);
  }

 private:
  /// The side of a cell that is on the surface; outside is where the coordinate along `axis` grows, or shrinks.
  struct Panel {
    std::size_t axis;
    std::uint32_t plane, u, v;
    bool outside_grows;
  };

  /// Nothing is beyond the block's cells; what would be cell -1 wraps round to the largest number.
  bool is_solid(const std::array<std::uint32_t, 3>& cell) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (cell[axis] >= divisions_[axis].size()) return false;
    return part_.is_solid(cell[0], cell[1], cell[2]);
  }

  bool is_end_of_bore(const Panel& panel) const {
    const auto within = [](std::uint32_t cell, const CellRange& i) { return i.first <= cell && cell < i.last; };
    return std::any_of(part_.bores.begin(), part_.bores.end(), [&](const Bore& bore) {
      return bore.axis == panel.axis && within(panel.u, bore.u) && within(panel.v, bore.v) &&
             (panel.plane == bore.w.first || panel.plane == bore.w.last);
    });
  }

  void find_panels() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u_axis = (axis + 1) % 3, v_axis = (axis + 2) % 3;
      std::array<std::uint32_t, 3> cell{};
      for (std::uint32_t w = 0; w <= divisions_[axis].size(); ++w)
        for (cell[u_axis] = 0; cell[u_axis] < divisions_[u_axis].size(); ++cell[u_axis])
          for (cell[v_axis] = 0; cell[v_axis] < divisions_[v_axis].size(); ++cell[v_axis]) {
            cell[axis] = w - 1;
            const bool below = is_solid(cell);
            cell[axis] = w;
            const Panel panel{axis, w, cell[u_axis], cell[v_axis], below};
            if (below != is_solid(cell) && !is_end_of_bore(panel)) panels_.push_back(panel);
          }
    }
  }

  /// Divides whatever has the longest pieces, one step at a time, which hits any face count closely.
  void divide(std::size_t faces) {
    struct Divided {
      double length;
      std::uint32_t* pieces;
    };
    std::vector<Divided> all;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < divisions_[axis].size(); ++i)
        all.push_back({part_.planes[axis][i + 1] - part_.planes[axis][i], &divisions_[axis][i]});
    for (std::size_t b = 0; b < part_.bores.size(); ++b)
      for (std::size_t span = 0; span < bore_divisions_[b].size(); ++span)
        all.push_back({span_length(part_.bores[b], span), &bore_divisions_[b][span]});

    for (std::size_t count = face_count(); count < faces;) {
      const Divided& longest = *std::max_element(all.begin(), all.end(), [](const Divided& a, const Divided& b) {
        return a.length / *a.pieces < b.length / *b.pieces;
      });
      ++*longest.pieces;
      const std::size_t before = std::exchange(count, face_count());
      if (count > faces && count - faces > faces - before) --*longest.pieces;
    }
  }

  std::size_t face_count() const {
    std::size_t quads = 0;
    for (const Panel& p : panels_)
      quads += std::size_t(divisions_[(p.axis + 1) % 3][p.u]) * divisions_[(p.axis + 2) % 3][p.v];
    for (std::size_t b = 0; b < part_.bores.size(); ++b) {
      const Bore& bore = part_.bores[b];
      const auto pieces = [&](std::size_t axis, const CellRange& i) {
        return std::accumulate(&divisions_[axis][i.first], &divisions_[axis][0] + i.last, std::size_t(0));
      };
      const std::size_t around = 2 * (pieces((bore.axis + 1) % 3, bore.u) + pieces((bore.axis + 2) % 3, bore.v));
      quads += around * std::accumulate(bore_divisions_[b].begin(), bore_divisions_[b].end(), std::size_t(0));
    }
    return 2 * quads;
  }

  void cut_lines(std::size_t axis) {
    const std::vector<double>& planes = part_.planes[axis];
    for (std::size_t i = 0; i < divisions_[axis].size(); ++i) {
      plane_lines_[axis].push_back(std::uint32_t(lines_[axis].size()));
      for (std::uint32_t k = 0; k < divisions_[axis][i]; ++k)
        lines_[axis].push_back(dyadic(std::lerp(planes[i], planes[i + 1], double(k) / divisions_[axis][i])));
    }
    plane_lines_[axis].push_back(std::uint32_t(lines_[axis].size()));
    lines_[axis].push_back(planes.back());
  }

  void add_panel(const Panel& panel) {
    const std::size_t u_axis = (panel.axis + 1) % 3, v_axis = (panel.axis + 2) % 3;
    const std::uint32_t w = plane_lines_[panel.axis][panel.plane];
    const auto& u_lines = plane_lines_[u_axis];
    const auto& v_lines = plane_lines_[v_axis];
    for (std::uint32_t u = u_lines[panel.u]; u < u_lines[panel.u + 1]; ++u)
      for (std::uint32_t v = v_lines[panel.v]; v < v_lines[panel.v + 1]; ++v) {
        const VertexId a = lattice_vertex(panel.axis, u, v, w), b = lattice_vertex(panel.axis, u + 1, v, w);
        const VertexId c = lattice_vertex(panel.axis, u + 1, v + 1, w), d = lattice_vertex(panel.axis, u, v + 1, w);
        panel.outside_grows ? add_quad(mesh_, a, b, c, d) : add_quad(mesh_, a, d, c, b);
      }
  }

  /// From the boundary of its cells at one end, ring by ring, to that at the other end.
  void add_bore(const Bore& bore, const std::vector<std::uint32_t>& divisions) {
    const std::vector<Line> boundary = boundary_of(bore);
    std::vector<VertexId> row(boundary.size());
    for (std::size_t k = 0; k < row.size(); ++k) row[k] = end_vertex(bore, boundary[k], bore.w.last);
    for (std::size_t span = 0; span < divisions.size(); ++span)
      for (std::uint32_t i = 1; i <= divisions[span]; ++i) {
        const bool at_end = span + 1 == divisions.size() && i == divisions[span];
        std::vector<VertexId> next(row.size());
        for (std::size_t k = 0; k < row.size(); ++k)
          next[k] = at_end ? end_vertex(bore, boundary[k], bore.w.first)
                           : wall_vertex(bore, boundary[k], span, double(i) / divisions[span]);
        for (std::size_t k = 0; k < row.size(); ++k) {
          const std::size_t after = (k + 1) % row.size();
          add_quad(mesh_, row[k], row[after], next[after], next[k]);
        }
        row = std::move(next);
      }
  }

  /// A line of the refined lattice along the axis of a bore.
  struct Line {
    std::uint32_t u, v;
  };

  /// Counter-clockwise about the axis.
  std::vector<Line> boundary_of(const Bore& bore) const {
    const auto& u_lines = plane_lines_[(bore.axis + 1) % 3];
    const auto& v_lines = plane_lines_[(bore.axis + 2) % 3];
    const std::uint32_t u0 = u_lines[bore.u.first], u1 = u_lines[bore.u.last];
    const std::uint32_t v0 = v_lines[bore.v.first], v1 = v_lines[bore.v.last];
    std::vector<Line> boundary;
    for (std::uint32_t u = u0; u < u1; ++u) boundary.push_back({u, v0});
    for (std::uint32_t v = v0; v < v1; ++v) boundary.push_back({u1, v});
    for (std::uint32_t u = u1; u > u0; --u) boundary.push_back({u, v1});
    for (std::uint32_t v = v1; v > v0; --v) boundary.push_back({u0, v});
    return boundary;
  }

  VertexId end_vertex(const Bore& bore, const Line& line, std::uint32_t plane) {
    return lattice_vertex(bore.axis, line.u, line.v, plane_lines_[bore.axis][plane]);
  }

  VertexId wall_vertex(const Bore& bore, const Line& line, std::size_t span, double fraction) {
    const std::size_t u_axis = (bore.axis + 1) % 3, v_axis = (bore.axis + 2) % 3;
    const Vec2 center = center_of(bore);
    const Vec2 boundary{lines_[u_axis][line.u] - center.u, lines_[v_axis][line.v] - center.v};
    const Vec2 from = on_ring(bore, span, boundary), to = on_ring(bore, span + 1, boundary);
    Vec3 p;
    p[int(u_axis)] = dyadic(center.u + std::lerp(from.u, to.u, fraction));
    p[int(v_axis)] = dyadic(center.v + std::lerp(from.v, to.v, fraction));
    p[int(bore.axis)] = dyadic(std::lerp(height(bore, span), height(bore, span + 1), fraction));
    return mesh_.positions.push_back(p);
  }

  // Ring 0 is the boundary of the cells at the upper end, the last one that at the lower end.
  static Vec2 on_ring(const Bore& bore, std::size_t ring, const Vec2& boundary) {
    const bool at_end = ring == 0 || ring == bore.rings.size() + 1;
    return at_end ? boundary : bore.rings[ring - 1].outline(boundary);
  }
  double height(const Bore& bore, std::size_t ring) const {
    if (ring == 0) return part_.planes[bore.axis][bore.w.last];
    return ring <= bore.rings.size() ? bore.rings[ring - 1].height : part_.planes[bore.axis][bore.w.first];
  }
  Vec2 center_of(const Bore& bore) const {
    const std::vector<double>&u = part_.planes[(bore.axis + 1) % 3], &v = part_.planes[(bore.axis + 2) % 3];
    return {(u[bore.u.first] + u[bore.u.last]) / 2, (v[bore.v.first] + v[bore.v.last]) / 2};
  }

  /// The mean over the corner of the boundary and the middles of two sides.
  double span_length(const Bore& bore, std::size_t span) const {
    const Vec2 center = center_of(bore);
    const double u = part_.planes[(bore.axis + 1) % 3][bore.u.last] - center.u;
    const double v = part_.planes[(bore.axis + 2) % 3][bore.v.last] - center.v;
    double sum = 0;
    for (const Vec2& boundary : {Vec2{u, v}, Vec2{u, 0}, Vec2{0, v}}) {
      const Vec2 from = on_ring(bore, span, boundary), to = on_ring(bore, span + 1, boundary);
      sum += norm(Vec3{to.u - from.u, to.v - from.v, height(bore, span + 1) - height(bore, span)});
    }
    return sum / 3;
  }

  VertexId lattice_vertex(std::size_t axis, std::uint32_t u, std::uint32_t v, std::uint32_t w) {
    std::array<std::uint32_t, 3> line{};
    line[axis] = w, line[(axis + 1) % 3] = u, line[(axis + 2) % 3] = v;
    const auto [index, is_new] =
        lattice_.find_or_add(std::uint64_t(line[0]) << 42 | std::uint64_t(line[1]) << 21 | line[2]);
    if (is_new)
      lattice_vertices_.push_back(
          mesh_.positions.push_back({lines_[0][line[0]], lines_[1][line[1]], lines_[2][line[2]]}));
    return lattice_vertices_[index];
  }

  const Part& part_;
  std::vector<Panel> panels_;
  std::array<std::vector<std::uint32_t>, 3> divisions_;     // of each interval between planes
  std::vector<std::vector<std::uint32_t>> bore_divisions_;  // of each bore's spans between rings
  std::array<std::vector<double>, 3> lines_;                // the planes of the refined lattice
  std::array<std::vector<std::uint32_t>, 3> plane_lines_;   // which of them the part's planes are
  IndexOfKey lattice_;
  std::vector<VertexId> lattice_vertices_;
  TriangleMesh mesh_;
};

constexpr std::size_t kX = 0, kZ = 2;

}  // namespace

TriangleMesh make_box(std::size_t faces) {
  const Part box{{{{-1, 1}, {-1, 1}, {0, 1}}},
                 [](auto, auto, auto) { return true; },
                 {{kZ, {0, 1}, {0, 1}, {0, 1}, {{1, square(0.5)}, {0, square(0.5)}}}}};
  return PartMesher(box).mesh(faces);
}

/// A base plate with four counterbored holes and an upright plate with a slot.
TriangleMesh make_bracket(std::size_t faces) {
  const std::vector<double> x{0, 0.5, 1, 2.25, 3.5, 3.75}, y{0, 0.25, 1.5, 2.5, 3.75, 4}, z{0, 0.5, 1.25, 2.75, 3};
  Part bracket{{x, y, z}, [](std::uint32_t i, std::uint32_t, std::uint32_t k) { return i == 0 || k == 0; }, {}};
  for (const CellRange u : {CellRange{2, 3}, CellRange{3, 4}})
    for (const CellRange v : {CellRange{1, 2}, CellRange{3, 4}})
      bracket.bores.push_back(
          {kZ, u, v, {0, 1}, {{0.5, circle(0.4375)}, {0.25, circle(0.4375)}, {0.25, circle(0.25)}, {0, circle(0.25)}}});
  bracket.bores.push_back({kX, {1, 4}, {2, 3}, {0, 1}, {{0.5, slot(0.875, 0.5)}, {0, slot(0.875, 0.5)}}});
  return PartMesher(bracket).mesh(faces);
}

}  // namespace prohull
