#include "verify/subdivision.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace prohull::verify {
namespace {

using LineId = std::uint32_t;
using PointId = std::uint32_t;

/// a u + b v + c = 0
struct Line {
  Number a, b, c;
  Interval near_a, near_b, near_c;

  Line(const PlanePoint& p, const PlanePoint& q)
      : a(p.v - q.v),
        b(q.u - p.u),
        c(-(a * p.u + b * p.v)),
        near_a(a.approx()),
        near_b(b.approx()),
        near_c(c.approx()) {}
};

PlanePoint meet(const Line& l, const Line& m) {
  const Number w = l.a * m.b - m.a * l.b;
  return {(l.b * m.c - m.b * l.c) / w, (m.a * l.c - l.a * m.c) / w};
}

/// A point, and the lines that are known to hold it. Most signs that are 0 are known in this way: to find them by exact
/// arithmetic would take nearly all of the time.
struct Point {
  PlanePoint exact;
  Interval near_u, near_v;
  std::vector<LineId> lines;

  explicit Point(PlanePoint p) : exact(std::move(p)), near_u(exact.u.approx()), near_v(exact.v.approx()) {}
};

PlanePoint projected(int axis, const Vec3& p) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

/// The exact difference of a coordinate.
Number along(const Vec3& from, const Vec3& to, int coordinate) {
  return Number(to[coordinate]) - Number(from[coordinate]);
}

/// A segment of a line that remains to be cut along.
struct Piece {
  LineId line;
  PointId begin, end;
};

struct Region {
  std::vector<PointId> corners;
  std::vector<LineId> lines;  // lines[i] holds the edge from corner i to the next
  std::vector<Piece> pieces;  // in the closed region, none of them on its boundary
};

class Subdivision {
 public:
  Subdivision(const Triangle& t, int axis) : t_(t), axis_(axis) {
    for (const Vec3& corner : {t.a, t.b, t.c}) start_.corners.push_back(corner_point(corner));
    for (int e = 0; e < 3; ++e) start_.lines.push_back(add_line(start_.corners[e], start_.corners[(e + 1) % 3]));
    orientation_ = side(0, start_.corners[2]);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      normal_[i] = along(t.a, t.b, j) * along(t.a, t.c, k) - along(t.a, t.b, k) * along(t.a, t.c, j);
    }
  }

  void cut_by(const Triangle& h) {
    const std::array<Vec3, 3> corner{h.a, h.b, h.c};
    std::array<Number, 3> height;
    std::array<int, 3> side_of;
    for (int i = 0; i < 3; ++i) height[i] = height_of(corner[i]), side_of[i] = int(CGAL::sign(height[i]));
    const bool coplanar = side_of[0] == 0 && side_of[1] == 0 && side_of[2] == 0;
    std::vector<PointId> ends;  // of the segment in which h meets the plane of t
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      if (coplanar) add_piece(corner_point(corner[i]), corner_point(corner[j]));
      if (side_of[i] == 0) ends.push_back(corner_point(corner[i]));
      if (side_of[i] * side_of[j] < 0) ends.push_back(edge_point(corner[i], corner[j], height[i], height[j]));
    }
    if (!coplanar && ends.size() == 2) add_piece(ends[0], ends[1]);
  }

  std::vector<Cell> cells(ProgressMeter& meter) {
    std::vector<Cell> done;
    std::vector<Region> open;
    open.push_back(std::move(start_));
    while (!open.empty()) {
      meter.go_on();
      Region region = std::move(open.back());
      open.pop_back();
      if (region.pieces.empty()) {
        Cell& cell = done.emplace_back();
        for (const PointId corner : region.corners) cell.push_back(points_[corner].exact);
        continue;
      }
      auto [left, right] = halves(region, region.pieces[region.pieces.size() / 2].line);
      open.push_back(std::move(left));
      open.push_back(std::move(right));
    }
    return done;
  }

 private:
  using Position = std::array<double, 3>;

  Number height_of(const Vec3& p) const {
    return normal_[0] * along(t_.a, p, 0) + normal_[1] * along(t_.a, p, 1) + normal_[2] * along(t_.a, p, 2);
  }

  PointId add_point(PlanePoint p) {
    points_.emplace_back(std::move(p));
    return static_cast<PointId>(points_.size() - 1);
  }

  /// A corner in the plane of t.
  PointId corner_point(const Vec3& p) {
    const Position at{p.x, p.y, p.z};
    const auto [known, is_new] = at_edge_.try_emplace({at, at});
    if (is_new) known->second = add_point(projected(axis_, p));
    return known->second;
  }

  /// Where an edge, with ends at these heights above and below, crosses the plane of t.
  PointId edge_point(const Vec3& from, const Vec3& to, const Number& from_height, const Number& to_height) {
    const auto [low, high] = std::minmax({Position{from.x, from.y, from.z}, Position{to.x, to.y, to.z}});
    const auto [known, is_new] = at_edge_.try_emplace({low, high});
    if (is_new) {
      const PlanePoint p = projected(axis_, from), q = projected(axis_, to);
      const Number s = from_height / (from_height - to_height);
      known->second = add_point({p.u + s * (q.u - p.u), p.v + s * (q.v - p.v)});
    }
    return known->second;
  }

  PointId meeting_point(LineId l, LineId m) {
    const auto [known, is_new] = at_lines_.try_emplace(std::uint64_t{std::min(l, m)} << 32 | std::max(l, m));
    if (is_new) {
      known->second = add_point(meet(lines_[l], lines_[m]));
      points_.back().lines = {l, m};
    }
    return known->second;
  }

  LineId add_line(PointId p, PointId q) {
    lines_.emplace_back(points_[p].exact, points_[q].exact);
    const auto line = static_cast<LineId>(lines_.size() - 1);
    for (const PointId end : {p, q}) points_[end].lines.push_back(line);
    return line;
  }

  /// On which side of the line the point lies; exact.
  int side(LineId l, PointId p) {
    const Line& line = lines_[l];
    Point& point = points_[p];
    if (std::ranges::find(point.lines, l) != point.lines.end()) return 0;
    {
      const CGAL::Protect_FPU_rounding<true> upwards;
      const Interval sum = line.near_a * point.near_u + line.near_b * point.near_v + line.near_c;
      if (sum.inf() > 0) return 1;
      if (sum.sup() < 0) return -1;
    }
    const auto exact = int(CGAL::sign(line.a * point.exact.u + line.b * point.exact.v + line.c));
    if (exact == 0) point.lines.push_back(l);
    return exact;
  }

  /// The part of the segment within t, unless it lies on an edge.
  void add_piece(PointId p, PointId q) {
    if (!segments_.insert(std::minmax({p, q})).second) return;
    Piece piece{add_line(p, q), p, q};
    for (LineId edge = 0; edge < 3; ++edge) {
      const int begin = side(edge, piece.begin) * orientation_, end = side(edge, piece.end) * orientation_;
      if (begin <= 0 && end <= 0) return;
      if (begin < 0) piece.begin = meeting_point(edge, piece.line);
      if (end < 0) piece.end = meeting_point(edge, piece.line);
    }
    start_.pieces.push_back(piece);
  }

  std::pair<Region, Region> halves(const Region& region, LineId cut) {
    Region left, right;
    const std::size_t n = region.corners.size();
    std::vector<int> sides(n);
    for (std::size_t i = 0; i < n; ++i) sides[i] = side(cut, region.corners[i]);
    const auto add = [](Region& to, PointId corner, LineId edge) {
      to.corners.push_back(corner);
      to.lines.push_back(edge);
    };
    for (std::size_t i = 0; i < n; ++i) {
      const int here = sides[i], next = sides[(i + 1) % n];
      const LineId edge = region.lines[i];
      // A region leaves the other side through a corner on the cut, whose edge is then the cut itself.
      if (here > 0 || (here == 0 && next > 0)) add(left, region.corners[i], edge);
      if (here < 0 || (here == 0 && next < 0)) add(right, region.corners[i], edge);
      if (here == 0 && next <= 0) add(left, region.corners[i], cut);
      if (here == 0 && next >= 0) add(right, region.corners[i], cut);
      if (here * next < 0) {
        const PointId crossing = meeting_point(edge, cut);
        add(left, crossing, here > 0 ? cut : edge);
        add(right, crossing, here < 0 ? cut : edge);
      }
    }
    for (const Piece& piece : region.pieces) {
      const int begin = side(cut, piece.begin), end = side(cut, piece.end);
      if (begin * end < 0) {
        const PointId crossing = meeting_point(piece.line, cut);
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
  std::vector<Line> lines_;  // first those of the edges of t
  std::vector<Point> points_;
  std::map<std::pair<Position, Position>, PointId> at_edge_;  // the ends of the edge; of a corner, it twice
  std::unordered_map<std::uint64_t, PointId> at_lines_;       // both lines, the first one in the upper half
  std::set<std::pair<PointId, PointId>> segments_;            // that were added, lesser end first
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

std::vector<Cell> subdivide(const Triangle& t, int axis, std::span<const Triangle> cutters, ProgressMeter& meter) {
  if (cutters.empty()) return {whole_cell(t, axis)};
  Subdivision subdivision(t, axis);
  for (const Triangle& h : cutters) {
    meter.go_on();
    subdivision.cut_by(h);
  }
  return subdivision.cells(meter);
}

}  // namespace prohull::verify
