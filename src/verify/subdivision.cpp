#include "verify/subdivision.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace prohull::verify {
namespace {

using LineId = std::uint32_t;

struct Line {
  Number a, b, c;  // a u + b v + c = 0

  Line(const PlanePoint& p, const PlanePoint& q) : a(p.v - q.v), b(q.u - p.u), c(-(a * p.u + b * p.v)) {}
  int side(const PlanePoint& p) const { return int(CGAL::sign(a * p.u + b * p.v + c)); }
};

PlanePoint meet(const Line& l, const Line& m) {
  const Number w = l.a * m.b - m.a * l.b;
  return {(l.b * m.c - m.b * l.c) / w, (m.a * l.c - l.a * m.c) / w};
}

PlanePoint projected(int axis, const Vec3& p) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

/// The exact difference of a coordinate.
Number along(const Vec3& from, const Vec3& to, int coordinate) {
  return Number(to[coordinate]) - Number(from[coordinate]);
}

/// A segment of a line that remains to be cut along.
struct Piece {
  LineId line;
  PlanePoint begin, end;
};

struct Region {
  Cell corners;
  std::vector<LineId> lines;  // lines[i] holds the edge from corner i to the next
  std::vector<Piece> pieces;  // in the closed region, none of them on its boundary
};

class Subdivision {
 public:
  Subdivision(const Triangle& t, int axis) : t_(t), axis_(axis) {
    start_.corners = whole_cell(t, axis);
    for (int e = 0; e < 3; ++e) start_.lines.push_back(add_line(start_.corners[e], start_.corners[(e + 1) % 3]));
    orientation_ = lines_[0].side(start_.corners[2]);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      normal_[i] = along(t.a, t.b, j) * along(t.a, t.c, k) - along(t.a, t.b, k) * along(t.a, t.c, j);
    }
  }

  void cut_by(const Triangle& h) {
    const std::array<Vec3, 3> corner{h.a, h.b, h.c};
    std::array<Number, 3> height;
    std::array<int, 3> side;
    for (int i = 0; i < 3; ++i) height[i] = height_of(corner[i]), side[i] = int(CGAL::sign(height[i]));
    const bool coplanar = side[0] == 0 && side[1] == 0 && side[2] == 0;
    std::vector<PlanePoint> ends;  // of the segment in which h meets the plane of t
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const PlanePoint p = projected(axis_, corner[i]), q = projected(axis_, corner[j]);
      if (coplanar) add_piece(p, q);
      if (side[i] == 0) ends.push_back(p);
      if (side[i] * side[j] < 0) {
        const Number s = height[i] / (height[i] - height[j]);
        ends.push_back({p.u + s * (q.u - p.u), p.v + s * (q.v - p.v)});
      }
    }
    if (!coplanar && ends.size() == 2) add_piece(ends[0], ends[1]);
  }

  std::vector<Cell> cells() {
    std::vector<Cell> done;
    std::vector<Region> open;
    open.push_back(std::move(start_));
    while (!open.empty()) {
      Region region = std::move(open.back());
      open.pop_back();
      if (region.pieces.empty()) {
        done.push_back(std::move(region.corners));
        continue;
      }
      auto [left, right] = halves(region, region.pieces[region.pieces.size() / 2].line);
      open.push_back(std::move(left));
      open.push_back(std::move(right));
    }
    return done;
  }

 private:
  Number height_of(const Vec3& p) const {
    return normal_[0] * along(t_.a, p, 0) + normal_[1] * along(t_.a, p, 1) + normal_[2] * along(t_.a, p, 2);
  }

  LineId add_line(const PlanePoint& p, const PlanePoint& q) {
    lines_.emplace_back(p, q);
    return static_cast<LineId>(lines_.size() - 1);
  }

  /// The part of the segment within t, unless it lies on an edge.
  void add_piece(const PlanePoint& p, const PlanePoint& q) {
    Piece piece{add_line(p, q), p, q};
    for (int e = 0; e < 3; ++e) {
      const Line& edge = lines_[e];
      const int begin = edge.side(piece.begin) * orientation_, end = edge.side(piece.end) * orientation_;
      if (begin <= 0 && end <= 0) return;
      if (begin < 0) piece.begin = meet(edge, lines_[piece.line]);
      if (end < 0) piece.end = meet(edge, lines_[piece.line]);
    }
    start_.pieces.push_back(std::move(piece));
  }

  std::pair<Region, Region> halves(const Region& region, LineId cut) const {
    Region left, right;
    const Line& line = lines_[cut];
    const std::size_t n = region.corners.size();
    std::vector<int> side(n);
    for (std::size_t i = 0; i < n; ++i) side[i] = line.side(region.corners[i]);
    const auto add = [](Region& to, const PlanePoint& corner, LineId edge) {
      to.corners.push_back(corner);
      to.lines.push_back(edge);
    };
    for (std::size_t i = 0; i < n; ++i) {
      const int here = side[i], next = side[(i + 1) % n];
      const LineId edge = region.lines[i];
      // A region leaves the other side through a corner on the cut, whose edge is then the cut itself.
      if (here > 0 || (here == 0 && next > 0)) add(left, region.corners[i], edge);
      if (here < 0 || (here == 0 && next < 0)) add(right, region.corners[i], edge);
      if (here == 0 && next <= 0) add(left, region.corners[i], cut);
      if (here == 0 && next >= 0) add(right, region.corners[i], cut);
      if (here * next < 0) {
        const PlanePoint crossing = meet(lines_[edge], line);
        add(left, crossing, here > 0 ? cut : edge);
        add(right, crossing, here < 0 ? cut : edge);
      }
    }
    for (const Piece& piece : region.pieces) {
      const int begin = line.side(piece.begin), end = line.side(piece.end);
      if (begin * end < 0) {
        const PlanePoint crossing = meet(lines_[piece.line], line);
        (begin > 0 ? left : right).pieces.push_back({piece.line, piece.begin, crossing});
        (end > 0 ? left : right).pieces.push_back({piece.line, crossing, piece.end});
      } else if (begin > 0 || end > 0) {
        left.pieces.push_back(piece);
      } else if (begin < 0 || end < 0) {
        right.pieces.push_back(piece);
      }
    }
    return {std::move(left), std::move(right)};
  }

  const Triangle t_;
  const int axis_;
  std::vector<Line> lines_;
  Region start_;
  int orientation_;
  std::array<Number, 3> normal_;
};

}  // namespace

Cell whole_cell(const Triangle& t, int axis) {
  return {projected(axis, t.a), projected(axis, t.b), projected(axis, t.c)};
}

std::array<Number, 3> lifted(const Triangle& t, int axis, const PlanePoint& p) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Number bu = along(t.a, t.b, u), bv = along(t.a, t.b, v), bw = along(t.a, t.b, axis);
  const Number cu = along(t.a, t.c, u), cv = along(t.a, t.c, v), cw = along(t.a, t.c, axis);
  const Number du = p.u - t.a[u], dv = p.v - t.a[v];
  std::array<Number, 3> point;
  point[u] = p.u;
  point[v] = p.v;
  point[axis] = t.a[axis] + (bw * (du * cv - dv * cu) + cw * (bu * dv - bv * du)) / (bu * cv - bv * cu);
  return point;
}

std::vector<Cell> subdivide(const Triangle& t, int axis, std::span<const Triangle> cutters) {
  if (cutters.empty()) return {whole_cell(t, axis)};
  Subdivision subdivision(t, axis);
  for (const Triangle& h : cutters) subdivision.cut_by(h);
  return subdivision.cells();
}

}  // namespace prohull::verify
