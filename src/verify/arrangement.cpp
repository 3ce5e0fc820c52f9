#include "verify/arrangement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>

#include "geometry/bvh.h"
#include "geometry/triangle_predicates.h"
#include "geometry/vector_of.h"
#include "verify/cell.h"
#include "verify/winding.h"

// Why windings follow from segments. Move t outwards by a distance smaller than all others: a plane that meets no
// corner of any face. It meets a closed surface in closed lines, around which the winding numbers of the surface are
// those of the lines; and the faces that it meets, it meets in segments, the ends of which lie on edges. As the
// distance goes to 0, the ends go to where these edges meet the plane of t, if they cross it, or else to their ends in
// it. So the winding outside of t changes at these limits alone, by 1 for each face; likewise inside. A face in the
// plane of t is met by neither.
//
// A path beside a segment, or from one point to another, is thought of as moved to the left (or to the right) by a
// distance that is smaller than all others but the one above: then it meets no end of a segment. It crosses a segment
// that has one end on its left and another one that is not, and the windings change by the segment's jump.

namespace prohull::verify {
namespace arranged {

constexpr std::size_t kStepsOfExactSign = 100;

using LineId = std::uint32_t;
using PointId = std::uint32_t;
using PieceId = std::uint32_t;

/// In the projection of a triangle, from its first corner on.
template <class Field>
struct Planar {
  Field u, v;
};

struct Corner {
  Vec3 at;
};
/// Where an edge crosses the plane of the triangle.
struct Piercing {
  Vec3 from, to;
};
struct Meeting {
  LineId l, m;
};
struct Between {
  PointId p, q;
  double fraction;
};

struct ArrangedPoint {
  std::variant<PlanePoint, Corner, Piercing, Meeting, Between> origin;
  Planar<Interval> near{};
  std::optional<Planar<Rational>> exact{};  // once it was asked for
  std::vector<LineId> lines{};              // that are known to hold it
};

struct ArrangedLine {
  PointId p, q;
};

constexpr double kEpsilon = 0x1p-53;

/// A number and how far from it the exact one may be.
struct Rough {
  double value, error;
  /// 0 if it is not certain.
  int sign() const { return (value > error) - (-value > error); }
};

/// No coordinate is farther than `error` from that of the point.
struct RoughPoint {
  double u, v, error;

  explicit RoughPoint(const Planar<Interval>& p) : u(p.u.middle()), v(p.v.middle()) {
    const auto reach = [](const Interval& x, double from) {
      constexpr double kInfinity = std::numeric_limits<double>::infinity();
      if (!std::isfinite(from)) return kInfinity;
      const Interval d = x - Interval(from);
      return std::max(-d.inf(), d.sup());
    };
    error = (Interval(reach(p.u, u)) + Interval(reach(p.v, v))).sup();
  }
};

/// Decides most sides with doubles. Let (u, v) and (x, y) be rounded differences of rough points, of sizes |u| + |v|
/// and |x| + |y|, and d and e the sums of the errors of those points. With eps = 2^-53, the differences have errors of
/// at most d + eps |u|, and so on; the two products and their difference are rounded three times. To first order, the
/// determinant is wrong by at most d (|x| + |y|) + e (|u| + |v|) + 2 d e + 5 eps (|u| + |v|) (|x| + |y|). More is taken
/// for what is of higher order and for underflow; sums that overflow decide nothing.
class RoughLine {
 public:
  RoughLine(const RoughPoint& p, const RoughPoint& q)
      : p_(p), u_(q.u - p.u), v_(q.v - p.v), size_(std::abs(u_) + std::abs(v_)), error_(p.error + q.error) {}

  /// Positive on the left.
  Rough beside(const RoughPoint& p) const {
    const double x = p.u - p_.u, y = p.v - p_.v, size = std::abs(x) + std::abs(y), error = p.error + p_.error;
    const double bound =
        (error_ * size + size_ * error + 2 * error_ * error + 16 * kEpsilon * size_ * size) * (1 + 16 * kEpsilon) +
        0x1p-1000;
    return {u_ * y - v_ * x, bound};
  }

 private:
  RoughPoint p_;
  double u_, v_, size_, error_;
};

/// A segment of contact with faces, within the triangle.
struct ContactPiece {
  PointId begin, end;
  LineId line;
  Windings jump{};  // how much greater windings are on its left than on its right
};

/// Where one piece crosses another one, or ends on it.
struct Event {
  PieceId by;
  std::uint32_t number;  // of those along the other piece, in any order
  int side_of_begin;     // where the begin of the other piece lies
  int left, right;       // how often the jump is added to windings on the left, and on the right, of the other piece
  Rough place;           // 0 at the begin of the other piece, 1 at the end
};

/// A point, and the windings on both sides of a line through it, or around it.
struct KnownPoint {
  PointId point;
  std::optional<LineId> line;
  Windings left, right;
};

/// Along a piece: where something happens, or a point on its line.
struct Place {
  const Event* event;
  PointId point;  // if there is no event
};

/// A part of a piece between two events, or ends.
struct Stretch {
  PieceId piece;
  Place from, to;
  const Windings &left, &right;
};

void add_jumps(Windings& w, const Windings& jump, int times) {
  for (std::size_t i = 0; i < w.outside.size(); ++i) {
    w.outside[i] += times * jump.outside[i];
    w.inside[i] += times * jump.inside[i];
  }
  w.holders += times * jump.holders;
}

bool has_jump(const ContactPiece& piece) {
  const auto is_zero = [](int jump) { return jump == 0; };
  return piece.jump.holders != 0 || !std::ranges::all_of(piece.jump.outside, is_zero) ||
         !std::ranges::all_of(piece.jump.inside, is_zero);
}

template <class Field>
Field across(const Planar<Field>& from, const Planar<Field>& to, const Planar<Field>& p) {
  return (to.u - from.u) * (p.v - from.v) - (to.v - from.v) * (p.u - from.u);
}

template <class Field>
Planar<Field> way_point(const Planar<Field>& from, const Planar<Field>& to, const Field& fraction) {
  return {from.u + fraction * (to.u - from.u), from.v + fraction * (to.v - from.v)};
}

/// Where the line on which two points have these values is 0.
Interval zero_between(const Interval& from, const Interval& to) { return from / (from - to); }

class Segments {
 public:
  Segments(const Triangle& t, int axis, std::mt19937& random, Steps& steps)
      : t_(t), axis_(axis), random_(random), steps_(steps), orientation_(turn(axis, t.a, t.b, t.c)) {
    const std::array corners{corner_point(t.a), corner_point(t.b), corner_point(t.c)};
    for (int e = 0; e < kEdges; ++e) {
      const PointId begin = corners[e], end = corners[(e + 1) % 3];
      pieces_.push_back({begin, end, add_line(begin, end)});
    }
    find_base();
  }

  void add(std::size_t number, const Surface& surface, std::span<const Triangle> faces) {
    surfaces_[number] = &surface;
    for (const Triangle& h : faces) {
      steps_.take(1);
      add_contact(h, number);
    }
    sort_pieces();
  }

  void add_holders(std::span<const Triangle> coplanar) {
    holders_ = coplanar;
    for (const Triangle& h : holders_) {
      Windings jump;
      jump.holders = turn(axis_, h.a, h.b, h.c);
      for (const auto& [from, to] : edges_of(h)) add_jump(corner_point(from), corner_point(to), jump);
    }
    find_base();
    sort_pieces();
  }

  bool has_part(const Arrangement::Sought& sought) {
    if (sought(around_base())) return true;
    return visit_stretches(tour_, [&](const Stretch& s) { return sought(s.left) || sought(s.right); });
  }

  bool has_part_at(const ExactPoint& p, const Arrangement::Sought& sought) {
    const PointId x = point_of([&](int i) -> const Number& { return p[i]; });
    around_base();
    Windings here = base_windings_;
    add_jumps(here, crossed(base_point_, x), 1);
    if (sought(here)) return true;
    std::vector<PieceId> through;
    for (const PieceId i : tour_)
      if (side(pieces_[i].line, x) == 0 && order_along(i, pieces_[i].begin, x) <= 0 &&
          order_along(i, x, pieces_[i].end) <= 0)
        through.push_back(i);
    return visit_stretches(
        through, [&](const Stretch& s) { return (sought(s.left) || sought(s.right)) && closure_holds(s, x); });
  }

  std::vector<Vec3> points_of_parts(const Arrangement::Sought& sought) {
    constexpr int kMostStretches = 16;  // of pieces; a distance is measured from each point
    std::vector<Vec3> points;
    std::optional<Vec3> inner;
    const auto add_ends = [&](const Stretch& s) {
      for (const Place& end : {s.from, s.to})
        points.push_back(end.event ? place_of(s.piece, *end.event) : in_space(end.point));
    };
    if (sought(around_base())) inner = base_->rounded();
    if (tour_.empty()) return inner ? std::vector{*inner, t_.a, t_.b, t_.c} : points;
    visit_stretches(edges_, [&](const Stretch& s) {
      if (sought(orientation_ > 0 ? s.left : s.right)) add_ends(s);
      return false;
    });
    int count = 0;
    visit_stretches(tour_, [&](const Stretch& s) {
      const bool is_left = sought(s.left);
      if (!is_left && !sought(s.right)) return false;
      if (!inner) inner = point_beside(s, is_left);
      add_ends(s);
      return ++count == kMostStretches;
    });
    if (inner) points.insert(points.begin(), *inner);
    return points;
  }

  // By Green's theorem: seen from outside of t, parts are on the left of the edges of t, and on either side of
  // segments. Where segments lie on each other, the windings beside each of them are the same, and one of them counts.
  void visit_parts(const Arrangement::Value& value, const Arrangement::Visit& visit) {
    if (const int all = value(around_base()); tour_.empty()) {
      if (all != 0) visit(t_, all);
      return;
    }
    const auto see = [&](const Stretch& s, int times) {
      if (times == 0) return;
      const ContactPiece& piece = pieces_[s.piece];
      const auto end = [&](const Place& p) { return in_t(p.event ? about(piece, *p.event) : about(p.point)); };
      for (const auto& [from, to] : first_on(s)) visit({t_.a, end(from), end(to)}, times);
    };
    visit_stretches(edges_, [&](const Stretch& s) {
      see(s, value(orientation_ > 0 ? s.left : s.right));
      return false;
    });
    visit_stretches(tour_, [&](const Stretch& s) {
      see(s, orientation_ * (value(s.left) - value(s.right)));
      return false;
    });
  }

 private:
  static constexpr int kEdges = 3;  // of the triangle: the first pieces, without jumps, and the first lines

  // Numbers: intervals at first, exact ones where these do not tell.

  template <class Field>
  Planar<Field> relative(const Vec3& p) const {
    const int u = (axis_ + 1) % 3, v = (axis_ + 2) % 3;
    return {Field(p[u]) - Field(t_.a[u]), Field(p[v]) - Field(t_.a[v])};
  }

  template <class Field>
  Planar<Field> made(const Corner& corner) {
    return relative<Field>(corner.at);
  }

  template <class Field>
  Planar<Field> made(const Piercing& edge) {
    const VectorOf<Field> n = cross(between<Field>(t_.a, t_.b), between<Field>(t_.a, t_.c));
    const auto height = [&](const Vec3& p) { return dot(n, between<Field>(t_.a, p)); };
    return way_point<Field>(relative<Field>(edge.from), relative<Field>(edge.to),
                            zero_between(height(edge.from), height(edge.to)));
  }

  template <class Field>
  Planar<Field> made(const Meeting& lines) {
    const ArrangedLine l = lines_[lines.l];
    return way_point<Field>(at<Field>(l.p), at<Field>(l.q), fraction_at<Field>(l.p, l.q, lines.m));
  }

  template <class Field>
  Planar<Field> made(const Between& between) {
    return way_point<Field>(at<Field>(between.p), at<Field>(between.q), Field(between.fraction));
  }

  template <class Field>
  Planar<Field> made(const PlanePoint& p) {
    if constexpr (std::is_same_v<Field, Interval>)
      return {p.u.approx(), p.v.approx()};
    else
      return {p.u.exact(), p.v.exact()};
  }

  template <class Field>
  const Planar<Field>& at(PointId p) {
    ArrangedPoint& point = points_[p];
    if constexpr (std::is_same_v<Field, Interval>) {
      return point.near;
    } else {
      if (!point.exact)
        point.exact = std::visit([&](const auto& origin) { return made<Rational>(origin); }, point.origin);
      return *point.exact;
    }
  }

  /// Positive on the left of the line.
  template <class Field>
  Field beside(LineId l, PointId p) {
    return across<Field>(at<Field>(lines_[l].p), at<Field>(lines_[l].q), at<Field>(p));
  }

  /// How far from p to q the line is met.
  template <class Field>
  Field fraction_at(PointId p, PointId q, LineId l) {
    return zero_between(beside<Field>(l, p), beside<Field>(l, q));
  }

  template <class Origin>
  PointId add_point(Origin origin) {
    ArrangedPoint& point = points_.emplace_back(ArrangedPoint{origin});
    point.near = made<Interval>(origin);
    rough_points_.emplace_back(point.near);
    return static_cast<PointId>(points_.size() - 1);
  }

  PointId corner_point(const Vec3& p) {
    const Position at{p.x, p.y, p.z};
    const auto [known, is_new] = at_edge_.try_emplace({at, at});
    if (is_new) known->second = add_point(Corner{p});
    return known->second;
  }

  PointId edge_point(const Vec3& from, const Vec3& to) {
    const auto [low, high] = std::minmax({Position{from.x, from.y, from.z}, Position{to.x, to.y, to.z}});
    const auto [known, is_new] = at_edge_.try_emplace({low, high});
    if (is_new) known->second = add_point(Piercing{from, to});
    return known->second;
  }

  template <class Coordinate>
  PointId point_of(Coordinate coordinate) {
    const int u = (axis_ + 1) % 3, v = (axis_ + 2) % 3;
    return add_point(PlanePoint{coordinate(u) - t_.a[u], coordinate(v) - t_.a[v]});
  }

  LineId add_line(PointId p, PointId q) {
    const auto line = static_cast<LineId>(lines_.size());
    lines_.push_back({p, q});
    rough_lines_.emplace_back(rough_points_[p], rough_points_[q]);
    for (const PointId end : {p, q}) points_[end].lines.push_back(line);
    return line;
  }

  /// 1 on the left of the line, -1 on its right, 0 on it.
  int side(LineId l, PointId p) {
    const int sign = rough_lines_[l].beside(rough_points_[p]).sign();
    return sign != 0 ? sign : exact_side(l, p);
  }

  int exact_side(LineId l, PointId p) {
    std::vector<LineId>& lines = points_[p].lines;
    if (std::ranges::find(lines, l) != lines.end()) return 0;
    steps_.take(kStepsOfExactSign);
    const int exact = sign(beside<Rational>(l, p));
    if (exact == 0) lines.push_back(l);
    return exact;
  }

  /// Of points on the line of a piece: negative if p comes before q.
  int order_along(PieceId i, PointId p, PointId q) {
    if (p == q) return 0;
    const ContactPiece& piece = pieces_[i];
    if (const auto certain = certain_sign(way<Interval>(q, p, piece))) return *certain;
    steps_.take(kStepsOfExactSign);
    return sign(way<Rational>(q, p, piece));
  }

  template <class Field>
  Field way(PointId from, PointId to, const ContactPiece& piece) {
    const Planar<Field>&a = at<Field>(from), &b = at<Field>(to), &p = at<Field>(piece.begin), &q = at<Field>(piece.end);
    return (b.u - a.u) * (q.u - p.u) + (b.v - a.v) * (q.v - p.v);
  }

  // Segments.

  void add_contact(const Triangle& h, std::size_t surface) {
    const std::array<Vec3, 3> corners{h.a, h.b, h.c};
    std::array<Side, 3> sides;
    for (int i = 0; i < 3; ++i) sides[i] = prohull::side(t_, corners[i]);
    add_limit(corners, sides, Side::Outside, surface);
    add_limit(corners, sides, Side::Inside, surface);
  }

  /// The limit of the segment in which a plane on that side of t meets the face.
  void add_limit(const std::array<Vec3, 3>& corners, const std::array<Side, 3>& sides, Side plane,
                 std::size_t surface) {
    const auto is_beyond = [&](int i) { return sides[i % 3] == plane; };
    const int beyond = is_beyond(0) + is_beyond(1) + is_beyond(2);
    if (beyond == 0 || beyond == 3) return;
    int alone = 0;
    while (is_beyond(alone) != (beyond == 1)) ++alone;
    const auto end = [&](int other) {
      const int i = alone, j = other % 3;
      if (sides[i] == Side::On) return corner_point(corners[i]);
      return sides[j] == Side::On ? corner_point(corners[j]) : edge_point(corners[i], corners[j]);
    };
    const PointId from = end(alone + 1), to = end(alone + 2);
    if (from == to) return;
    // Seen from outside of t, with the corner that is alone above it, the inside of the face is on the left of the way.
    const bool is_above = (plane == Side::Outside) == (beyond == 1);
    Windings jump;
    (plane == Side::Outside ? jump.outside : jump.inside)[surface] = is_above ? orientation_ : -orientation_;
    add_jump(from, to, jump);
  }

  void add_jump(PointId from, PointId to, const Windings& jump) {
    const auto [known, is_new] = at_ends_.try_emplace(std::minmax({from, to}));
    if (is_new) known->second = add_piece(known->first.first, known->first.second);
    if (known->second) add_jumps(pieces_[*known->second].jump, jump, from < to ? 1 : -1);
  }

  /// The part of the segment within t, unless it lies on an edge.
  std::optional<PieceId> add_piece(PointId begin, PointId end) {
    const LineId line = add_line(begin, end);
    for (LineId edge = 0; edge < kEdges; ++edge) {
      const int at_begin = side(edge, begin) * orientation_, at_end = side(edge, end) * orientation_;
      if (at_begin <= 0 && at_end <= 0) return std::nullopt;
      if (at_begin >= 0 && at_end >= 0) continue;
      const PointId meeting = add_point(Meeting{line, edge});
      points_[meeting].lines = {line, edge};
      (at_begin < 0 ? begin : end) = meeting;
    }
    pieces_.push_back({begin, end, line});
    return static_cast<PieceId>(pieces_.size() - 1);
  }

  /// Puts those with jumps into the tree, and near ones after each other on the tour.
  void sort_pieces() {
    with_jumps_.clear();
    tour_.clear();
    std::vector<Box> boxes;
    for (PieceId i = kEdges; i < pieces_.size(); ++i) {
      if (!has_jump(pieces_[i])) continue;
      with_jumps_.push_back(i);
      boxes.push_back(box_around(pieces_[i].begin, pieces_[i].end));
    }
    tree_ = Bvh(std::move(boxes));
    tree_.visit([](const Box&) { return true; }, [&](std::uint32_t i) { tour_.push_back(with_jumps_[i]); });
  }

  Box box_around(PointId p, PointId q) const {
    Box box;
    for (const PointId i : {p, q}) {
      const auto& [u, v] = points_[i].near;
      box.extend(Vec3{u.inf(), v.inf(), 0});
      box.extend(Vec3{u.sup(), v.sup(), 0});
    }
    return box;
  }

  // Windings.

  void find_base() {
    do {
      base_.emplace(t_, axis_, whole_cell(t_, axis_), random_);
      base_windings_.holders = 0;
    } while (!std::ranges::all_of(holders_, [&](const Triangle& h) { return is_beside_base(h); }));
    base_point_ = point_of([&](int i) -> const Number& { return (*base_)[i]; });
    is_known_ = {};
  }

  /// False if an edge of it is on a line through the base; otherwise it is counted if it holds the base.
  bool is_beside_base(const Triangle& holder) {
    const std::array<int, 3> turns = base_->turns(holder);
    const auto are_all = [&](int turn) { return turns == std::array{turn, turn, turn}; };
    base_windings_.holders += are_all(1) || are_all(-1);
    return std::ranges::find(turns, 0) == turns.end();
  }

  /// Moves the base if a ray from it meets an edge.
  const Windings& around_base() {
    constexpr int kTries = 1000;  // two are rare
    for (int i = 0; i < kTries; ++i) {
      const std::size_t unknown = is_known_[0] || surfaces_[0] == nullptr ? 1 : 0;
      if (is_known_[unknown] || surfaces_[unknown] == nullptr) return base_windings_;
      const auto w = winding_beside(*surfaces_[unknown], *base_);
      if (!w) {
        find_base();
        continue;
      }
      base_windings_.outside[unknown] = w->outside;
      base_windings_.inside[unknown] = w->inside;
      is_known_[unknown] = true;
    }
    throw std::logic_error("Arrangement: no ray misses the edges");
  }

  /// What is added to windings on the way.
  Windings crossed(PointId from, PointId to) {
    Windings sum;
    const LineId way = add_line(from, to);
    const Box box = box_around(from, to);
    tree_.visit([&](const Box& other) { return box.overlaps(other); },
                [&](std::uint32_t i) {
                  const ContactPiece& piece = pieces_[with_jumps_[i]];
                  steps_.take(1);
                  if (side(piece.line, from) * side(piece.line, to) >= 0) return;
                  const bool from_left = side(way, piece.begin) > 0, to_left = side(way, piece.end) > 0;
                  if (from_left != to_left) add_jumps(sum, piece.jump, from_left ? 1 : -1);
                });
    return sum;
  }

  /// The windings at a point of a piece, on the side of it that the way from the known point ends on; none if one of
  /// the two lines holds both points.
  std::optional<KnownPoint> arrived(const KnownPoint& known, PointId to, PieceId i) {
    const int end_side = side(pieces_[i].line, known.point), start_side = known.line ? side(*known.line, to) : 1;
    if (start_side == 0 || end_side == 0) return std::nullopt;
    Windings w = start_side > 0 ? known.left : known.right;
    add_jumps(w, crossed(known.point, to), 1);
    KnownPoint result{to, pieces_[i].line, w, w};
    add_jumps(end_side > 0 ? result.right : result.left, jump_at(i, to), -end_side);
    return result;
  }

  /// Of all pieces on the line of a piece that hold a point of it; those on that line are known.
  Windings jump_at(PieceId i, PointId p) {
    Windings sum = pieces_[i].jump;
    for (const PieceId j : collinear_) {
      const int before = order_along(i, pieces_[j].begin, p), after = order_along(i, p, pieces_[j].end);
      if (before * after > 0) add_jumps(sum, pieces_[j].jump, -before);
    }
    return sum;
  }

  /// Sets what happens along a piece, in order.
  void find_events(PieceId i) {
    const ContactPiece piece = pieces_[i];
    const Box box = box_around(piece.begin, piece.end);
    events_.clear();
    exact_places_.clear();
    collinear_.clear();
    tree_.visit([&](const Box& other) { return box.overlaps(other); },
                [&](std::uint32_t k) {
                  steps_.take(1);
                  if (with_jumps_[k] != i) add_event(piece, with_jumps_[k]);
                });
    std::sort(events_.begin(), events_.end(), [&](const Event& e, const Event& f) { return order(piece, e, f) < 0; });
  }

  void add_event(const ContactPiece& piece, PieceId j) {
    const ContactPiece& other = pieces_[j];
    const int begin = side(piece.line, other.begin), end = side(piece.line, other.end);
    if (begin == end) {
      if (begin == 0) collinear_.push_back(j);
      return;
    }
    const int side_of_begin = side(other.line, piece.begin);
    if (side_of_begin * side(other.line, piece.end) >= 0) return;
    events_.push_back({j, static_cast<std::uint32_t>(events_.size()), side_of_begin, (begin > 0) - (end > 0),
                       (end < 0) - (begin < 0), rough_place(piece, other.line)});
  }

  /// Let a and b be the distances of the ends, wrong by at most d in sum. Where 2 d < a + b, a / (a + b) is wrong by at
  /// most d / (a + b - d) < 2 d / (a + b); and by as much more if rounding gave a the wrong sign.
  Rough rough_place(const ContactPiece& piece, LineId l) const {
    const RoughLine& line = rough_lines_[l];
    const Rough from = line.beside(rough_points_[piece.begin]), to = line.beside(rough_points_[piece.end]);
    const double size = std::abs(from.value - to.value), error = from.error + to.error;
    if (!(size > 2 * error)) return {0.5, std::numeric_limits<double>::infinity()};
    return {std::abs(from.value) / size, 4 * error / size + 16 * kEpsilon};
  }

  /// Negative if e comes before f.
  int order(const ContactPiece& piece, const Event& e, const Event& f) {
    const double apart = e.place.error + f.place.error;
    if (f.place.value - e.place.value > apart) return -1;
    if (e.place.value - f.place.value > apart) return 1;
    if (e.by == f.by) return 0;
    steps_.take(kStepsOfExactSign);
    const auto exact = exact_place(piece, e) <=> exact_place(piece, f);
    return int{std::is_gt(exact)} - int{std::is_lt(exact)};
  }

  const Rational& exact_place(const ContactPiece& piece, const Event& e) {
    exact_places_.resize(events_.size());
    std::optional<Rational>& place = exact_places_[e.number];
    if (!place) place = fraction_at<Rational>(piece.begin, piece.end, pieces_[e.by].line);
    return *place;
  }

  /// A point of the piece where nothing happens, and how many events come before it.
  std::pair<PointId, std::size_t> quiet_point(PieceId i) {
    for (;;) {
      const double fraction = 0x1p-16 * random_number(random_, 1 << 14, 3 << 14);
      const PointId p = add_point(Between{pieces_[i].begin, pieces_[i].end, fraction});
      points_[p].lines.push_back(pieces_[i].line);
      std::size_t before = 0;
      bool is_quiet = true;
      for (const Event& e : events_) {
        const int there = side(pieces_[e.by].line, p);
        before += there == -e.side_of_begin;
        is_quiet &= there != 0;
      }
      for (const PieceId j : collinear_)
        is_quiet &= order_along(i, pieces_[j].begin, p) != 0 && order_along(i, pieces_[j].end, p) != 0;
      if (is_quiet) return {p, before};
    }
  }

  /// visit(stretch) for all stretches of the pieces, until it returns true; then this does.
  template <class Visit>
  bool visit_stretches(const std::vector<PieceId>& pieces, Visit visit) {
    std::optional<KnownPoint> known;
    for (const PieceId i : pieces) {
      find_events(i);
      const auto [point, before] = quiet_point(i);
      if (known) known = arrived(*known, point, i);
      while (!known) {
        around_base();
        known = arrived({base_point_, {}, base_windings_, base_windings_}, point, i);
        if (!known) find_base();
      }
      if (visit_stretches(i, *known, before, visit)) return true;
    }
    return false;
  }

  template <class Visit>
  bool visit_stretches(PieceId i, const KnownPoint& known, std::size_t before, Visit visit) {
    Windings left = known.left, right = known.right;
    const auto pass = [&](const Event& e, int direction) {
      add_jumps(left, pieces_[e.by].jump, direction * e.left);
      add_jumps(right, pieces_[e.by].jump, direction * e.right);
    };
    for (std::size_t k = 0; k < before; ++k) pass(events_[k], -1);
    Place from{nullptr, pieces_[i].begin};
    for (std::size_t k = 0; k < events_.size(); ++k) {
      const bool is_same_place = k > 0 && order(pieces_[i], events_[k - 1], events_[k]) == 0;
      if (!is_same_place && visit(Stretch{i, from, {&events_[k], 0}, left, right})) return true;
      pass(events_[k], 1);
      from = {&events_[k], 0};
    }
    return visit(Stretch{i, from, {nullptr, pieces_[i].end}, left, right});
  }

  /// Negative if p, on the line of a piece, comes before a place along it.
  int order_beside(PieceId i, PointId p, const Place& place) {
    if (!place.event) return order_along(i, p, place.point);
    return -place.event->side_of_begin * side(pieces_[place.event->by].line, p);
  }

  /// The parts of a stretch of the piece at hand on which no piece before it lies.
  std::vector<std::pair<Place, Place>> first_on(const Stretch& s) {
    const PieceId i = s.piece;
    std::vector<std::pair<PointId, PointId>> taken;
    for (const PieceId j : collinear_) {
      if (j >= i) continue;
      const auto& [begin, end, line, jump] = pieces_[j];
      taken.push_back(order_along(i, begin, end) < 0 ? std::pair{begin, end} : std::pair{end, begin});
    }
    std::ranges::sort(taken, [&](const auto& a, const auto& b) { return order_along(i, a.first, b.first) < 0; });
    Place from = s.from;
    std::vector<std::pair<Place, Place>> parts;
    for (const auto& [first, last] : taken) {
      if (order_beside(i, last, from) <= 0) continue;
      if (order_beside(i, first, s.to) >= 0) break;
      if (order_beside(i, first, from) > 0) parts.push_back({from, {nullptr, first}});
      from = {nullptr, last};
      if (order_beside(i, last, s.to) >= 0) return parts;
    }
    parts.push_back({from, s.to});
    return parts;
  }

  /// Of a point on the line of the piece.
  bool closure_holds(const Stretch& s, PointId p) {
    return order_beside(s.piece, p, s.from) >= 0 && order_beside(s.piece, p, s.to) <= 0;
  }

  // Rounded points of t.

  static std::array<std::pair<Vec3, Vec3>, 3> edges_of(const Triangle& h) {
    return {{{h.a, h.b}, {h.b, h.c}, {h.c, h.a}}};
  }

  static constexpr double kFine = 1e-14;  ///< of coordinates from the first corner on, and of stretches

  Planar<double> about(PointId p) {
    const RoughPoint& rough = rough_points_[p];
    if (rough.error <= kFine * (std::abs(rough.u) + std::abs(rough.v))) return {rough.u, rough.v};
    return rounded_point(p);
  }

  Planar<double> about(const ContactPiece& piece, const Event& e) {
    const double place = e.place.error <= kFine ? e.place.value : exact_place(piece, e).rounded();
    return way_point<double>(about(piece.begin), about(piece.end), place);
  }

  /// By its shares of two sides of t: their rounding leaves it in the plane. A needle whose area is rounded to 0 has
  /// none to share.
  Vec3 in_t(const Planar<double>& p) const {
    const Planar<double> b = relative<double>(t_.b), c = relative<double>(t_.c);
    const double area = b.u * c.v - b.v * c.u;
    const auto share = [&](double part) { return area == 0 ? 0.0 : std::clamp(part / area, 0.0, 1.0); };
    const double to_b = share(p.u * c.v - p.v * c.u), to_c = share(b.u * p.v - b.v * p.u);
    return t_.a + (t_.b - t_.a) * to_b + (t_.c - t_.a) * to_c;
  }

  // Points to show.

  Vec3 in_space(const Planar<Rational>& p) const {
    const int u = (axis_ + 1) % 3, v = (axis_ + 2) % 3;
    return rounded(lifted(t_, axis_, {Number(p.u) + t_.a[u], Number(p.v) + t_.a[v]}));
  }

  Vec3 in_space(PointId p) {
    if (const auto* corner = std::get_if<Corner>(&points_[p].origin)) return corner->at;
    return in_space(at<Rational>(p));
  }

  Vec3 place_of(PieceId i, const Event& e) {
    const ContactPiece& piece = pieces_[i];
    return in_space(way_point<Rational>(at<Rational>(piece.begin), at<Rational>(piece.end), exact_place(piece, e)));
  }

  Planar<double> rounded_point(PointId p) {
    const Planar<Rational>& exact = at<Rational>(p);
    return {exact.u.rounded(), exact.v.rounded()};
  }

  /// Halfway from the middle of a stretch to what bounds the part on that side.
  Vec3 point_beside(const Stretch& s, bool left) {
    const ContactPiece piece = pieces_[s.piece];
    const double from = s.from.event ? exact_place(piece, *s.from.event).rounded() : 0;
    const double to = s.to.event ? exact_place(piece, *s.to.event).rounded() : 1;
    const Planar<double> begin = rounded_point(piece.begin), end = rounded_point(piece.end);
    const Planar<double> p = way_point<double>(begin, end, (from + to) / 2);
    const double u = end.u - begin.u, v = end.v - begin.v;
    const Planar<double> q{left ? p.u - v : p.u + v, left ? p.v + u : p.v - u};
    double nearest = std::numeric_limits<double>::infinity();
    for (PieceId i = 0; i < pieces_.size(); ++i) {
      if (i == s.piece || (i >= kEdges && !has_jump(pieces_[i]))) continue;
      const Planar<double> a = rounded_point(pieces_[i].begin), b = rounded_point(pieces_[i].end);
      if ((across<double>(p, q, a) > 0) == (across<double>(p, q, b) > 0)) continue;
      const double at = across<double>(a, b, p) / (across<double>(a, b, p) - across<double>(a, b, q));
      if (at > 0) nearest = std::min(nearest, at);
    }
    const Planar<double> shown = std::isfinite(nearest) ? way_point<double>(p, q, nearest / 2) : p;
    if (!std::isfinite(shown.u) || !std::isfinite(shown.v)) return in_space(piece.begin);
    return in_space(Planar<Rational>{Rational(shown.u), Rational(shown.v)});
  }

  using Position = std::array<double, 3>;

  const Triangle t_;
  const int axis_;
  std::mt19937& random_;
  Steps& steps_;
  const int orientation_;  // of t in the projection
  std::array<const Surface*, 2> surfaces_{};
  std::span<const Triangle> holders_;
  std::deque<ArrangedPoint> points_;
  std::vector<ArrangedLine> lines_;
  std::vector<RoughPoint> rough_points_;
  std::vector<RoughLine> rough_lines_;
  std::map<std::pair<Position, Position>, PointId> at_edge_;  // the ends of the edge; of a corner, it twice
  std::map<std::pair<PointId, PointId>, std::optional<PieceId>>
      at_ends_;  // before t cuts them off, the lesser one first
  std::vector<ContactPiece> pieces_;
  std::vector<PieceId> with_jumps_, tour_;
  const std::vector<PieceId> edges_{0, 1, 2};
  Bvh tree_;  // of with_jumps_
  std::optional<SurfacePoint> base_;
  PointId base_point_ = 0;
  std::array<bool, 2> is_known_{};  // of the windings of each surface around the base
  Windings base_windings_;
  std::vector<Event> events_;                          // along the piece at hand
  std::vector<std::optional<Rational>> exact_places_;  // of those of which they were asked for, by number
  std::vector<PieceId> collinear_;                     // with the piece at hand
};

}  // namespace arranged

Arrangement::Arrangement(const Triangle& t, int axis, std::mt19937& random, Steps& steps)
    : segments_(std::make_unique<arranged::Segments>(t, axis, random, steps)) {}

Arrangement::~Arrangement() = default;

void Arrangement::add(std::size_t number, const Surface& surface, std::span<const Triangle> faces) {
  segments_->add(number, surface, faces);
}

void Arrangement::add_holders(std::span<const Triangle> coplanar) { segments_->add_holders(coplanar); }

bool Arrangement::has_part(const Sought& sought) { return segments_->has_part(sought); }

bool Arrangement::has_part_at(const ExactPoint& p, const Sought& sought) { return segments_->has_part_at(p, sought); }

std::vector<Vec3> Arrangement::points_of_parts(const Sought& sought) { return segments_->points_of_parts(sought); }

void Arrangement::visit_parts(const Value& value, const Visit& visit) { segments_->visit_parts(value, visit); }

}  // namespace prohull::verify
