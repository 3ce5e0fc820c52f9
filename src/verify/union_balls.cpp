#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "geometry/box_around_ball.h"
#include "geometry/bvh.h"
#include "geometry/largest_coordinate.h"
#include "geometry/triangle_intersection.h"
#include "geometry/triangle_predicates.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/detail/text.h"
#include "prohull/error.h"
#include "prohull/union_verification.h"
#include "verify/cell.h"
#include "verify/offenders.h"
#include "verify/original.h"
#include "verify/solid_volume.h"
#include "verify/solids.h"
#include "verify/steps.h"
#include "verify/surface.h"
#include "verify/winding.h"

// A ball is convex: a triangle of which one ball holds all corners is covered, and any other is cut in two at the
// middle of its longest side. A point that no ball holds is an answer, too. Middles of middles have fractions as
// weights whose denominators are powers of 2: doubles hold these weights without rounding, so that every answer is
// exact.
//
// The inside is cut into cubes in the same way. A cube that one ball holds is covered, and one outside of the solid is
// not asked. Where the surface passes through a cube, a ball need only hold the part of the solid there. That part lies
// within the convex hull of the triangles, clipped by the cube, and of the corners of the cube inside of the solid:
// each extreme point of it is a corner of the cube or lies on a triangle. Corners of the cubes are multiples of a power
// of 2 that doubles hold without rounding.

namespace prohull {
namespace verify {
namespace {

/// What this part of the diagonal holds is not cut further.
constexpr double kSmallest = 1e-10;
constexpr std::size_t kFewFaces = 64;  ///< in a cube; where there are more, it is cut
/// Of a triangle, and of all cubes together: some seconds.
constexpr std::size_t kMostParts = 1'000'000, kMostCubes = 4'000'000;
/// Beside a place in doubt, points outside are looked for in parts of at least this fraction of the whole.
constexpr double kCoarse = 1.0 / 16;

enum class Decision : std::uint8_t { Covered, Outside, Undecided };

using BallIndex = std::uint32_t;
using BallSet = std::vector<BallIndex>;  // sorted

template <class Field>
Field squared_distance(const std::array<Field, 3>& p, const Vec3& q) {
  const Field x = p[0] - Field(q.x), y = p[1] - Field(q.y), z = p[2] - Field(q.z);
  return x * x + y * y + z * z;
}

/// The sum of the corners of t, each times its weight.
template <class Field>
std::array<Field, 3> weighted(const Triangle& t, const Vec3& weights) {
  std::array<Field, 3> p;
  for (int i = 0; i < 3; ++i)
    p[i] = Field(t.a[i]) * Field(weights.x) + Field(t.b[i]) * Field(weights.y) + Field(t.c[i]) * Field(weights.z);
  return p;
}

/// Whether the ball holds the point of t with these weights. Exact.
bool holds(const Ball& ball, const Triangle& t, const Vec3& weights) {
  const Interval rough =
      Interval(ball.radius) * ball.radius - squared_distance(weighted<Interval>(t, weights), ball.center);
  if (rough.inf() >= 0) return true;
  if (rough.sup() < 0) return false;
  const ExactNumber radius(ball.radius);
  return radius * radius >= squared_distance(weighted<ExactNumber>(t, weights), ball.center);
}

bool holds(const Ball& ball, const Vec3& p) { return holds(ball, {p, p, p}, {1, 0, 0}); }

class Balls {
 public:
  explicit Balls(std::span<const Ball> balls) : balls_(balls) {
    for (const Ball& ball : balls) boxes_.push_back(box_around(ball));
    bvh_ = Bvh(boxes_);
  }

  const Ball& operator[](BallIndex i) const { return balls_[i]; }

  BallSet near(const Box& box) const {
    BallSet result;
    bvh_.visit([&](const Box& other) { return other.overlaps(box); }, [&](BallIndex i) { result.push_back(i); });
    std::sort(result.begin(), result.end());
    return result;
  }
  BallSet near(const Box& box, const BallSet& among) const {
    BallSet result;
    for (const BallIndex i : among)
      if (boxes_[i].overlaps(box)) result.push_back(i);
    return result;
  }

  /// From p to the nearest ball; 0 in a ball; rounded.
  double distance(const Vec3& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Ball& ball : balls_) least = std::min(least, norm(p - ball.center) - ball.radius);
    return std::max(least, 0.0);
  }

 private:
  std::span<const Ball> balls_;
  std::vector<Box> boxes_;
  Bvh bvh_;
};

/// Whether a ball holds all `points`; `holders_of` tells those of one.
template <class Points, class HoldersOf>
bool have_common(const Points& points, HoldersOf holders_of) {
  const auto is_held_by = [&](BallIndex i) {
    return [&, i](const auto& p) { return std::ranges::binary_search(std::invoke(holders_of, p), i); };
  };
  return std::ranges::any_of(std::invoke(holders_of, *points.begin()),
                             [&](BallIndex i) { return std::ranges::all_of(points, is_held_by(i)); });
}

/// One triangle that no ball holds alone.
class TriangleCutter {
 public:
  struct Corner {
    Vec3 weights, position;  ///< the position is rounded
    BallSet holders;
  };

  TriangleCutter(const Triangle& t, const Balls& balls, double smallest, Steps& steps)
      : triangle_(t), balls_(balls), largest_(largest_coordinate(box_of(t))), smallest_(smallest), steps_(steps) {}

  Decision decide() {
    const BallSet all = balls_.near(box_of(triangle_));
    std::vector<Part> parts{{{corner({1, 0, 0}, all), corner({0, 1, 0}, all), corner({0, 0, 1}, all)}, all}};
    for (const Corner& c : parts[0].corners)
      if (c.holders.empty()) return found(c, Decision::Outside);
    if (!projection_axis(triangle_)) parts[0].corners = ends_of(segment_of(triangle_), parts[0].corners);
    const double coarse = kCoarse * side(parts[0].corners, longest_side(parts[0].corners));
    Decision decision = Decision::Covered;
    for (std::size_t count = 1; !parts.empty(); count += 2) {
      const auto [part, around] = std::move(parts.back());
      parts.pop_back();
      if (have_common(part, &Corner::holders)) continue;
      const BallSet near = balls_.near(box_around(part), around);
      Cut cut = cut_of(part, near);
      for (const Corner* const c : {&cut.middle, &cut.end})
        if (c->holders.empty()) return found(*c, Decision::Outside);
      const bool is_small = cut.length < (decision == Decision::Covered ? smallest_ : std::max(smallest_, coarse));
      const bool is_over = !steps_.may_take(1 + around.size()) || count > kMostParts;
      if (is_small || is_fine(cut.middle.weights) || is_fine(cut.end.weights) || is_over) {
        if (decision == Decision::Covered) decision = found(cut.middle, Decision::Undecided);
        if (is_over) break;
        continue;
      }
      parts.push_back({std::move(cut.behind), near});
      parts.push_back({std::move(cut.before), near});
    }
    return decision;
  }

  /// That is outside, or in doubt.
  const Corner& point() const { return point_; }

 private:
  using Corners = std::vector<Corner>;  // the two of a segment, or those of a triangle or trapezium in their order

  struct Part {
    Corners corners;
    BallSet around;  ///< with all balls that may hold a point of it
  };

  /// From the middle of the longest side to `end`.
  struct Cut {
    double length;  ///< of that side
    Corner middle, end;
    Corners before, behind;
  };

  /// To the corner opposite, or to the middle of a second side that is long too: of a needle and its parts under n
  /// balls, that makes n parts. Cuts to corners alone would make the power 1.6 of n.
  Cut cut_of(const Corners& part, const BallSet& near) const {
    const std::size_t n = part.size(), first = longest_side(part);
    const auto at = [&](std::size_t k) -> const Corner& { return part[(first + k) % n]; };
    const auto length = [&](std::size_t k) { return side(part, (first + k) % n); };
    const auto middle = [&](std::size_t k) { return corner(at(k).weights * 0.5 + at(k + 1).weights * 0.5, near); };
    const std::size_t second = n == 3 && !(length(1) < length(2)) ? 1 : 2;
    const bool cuts_two = n == 4 || (n == 3 && length(second) > 2 * length(3 - second));
    Cut cut{length(0), middle(0), cuts_two ? middle(second) : at(2), {}, {}};
    cut.before = {cut.middle, at(1)};
    if (cuts_two && second == 2) cut.before.push_back(at(2));
    for (std::size_t k = cuts_two ? second + 1 : n; k <= n; ++k) cut.behind.push_back(at(k));
    cut.behind.push_back(cut.middle);
    if (n > 2) cut.before.push_back(cut.end), cut.behind.push_back(cut.end);
    return cut;
  }

  Decision found(const Corner& point, Decision decision) {
    point_ = point;
    return decision;
  }

  /// A segment is cut as one. As a triangle it would have parts without number beside a point in doubt: all those that
  /// lie on each other there.
  Corners ends_of(const Segment& segment, const Corners& corners) const {
    const auto at = [&](const Vec3& p) { return corners[p == triangle_.a ? 0 : p == triangle_.b ? 1 : 2]; };
    return {at(segment.a), at(segment.b)};
  }

  /// With all of their points, whose positions are rounded by at most 3 units in the last place of the largest number.
  Box box_around(const Corners& corners) const {
    const double rounding = 0x1p-49 * largest_ + std::numeric_limits<double>::min();
    const Vec3 all{rounding, rounding, rounding};
    Box box;
    for (const Corner& c : corners) box.extend(c.position - all), box.extend(c.position + all);
    return box;
  }

  /// `near` has all balls that may hold it.
  Corner corner(const Vec3& weights, const BallSet& near) const {
    const Triangle& t = triangle_;
    Corner result{weights, t.a * weights.x + t.b * weights.y + t.c * weights.z, {}};
    for (const BallIndex i : near)
      if (ball_holds(balls_[i], result)) result.holders.push_back(i);
    return result;
  }

  /// Decides most with doubles. With eps = 2^-53 and coordinates of at most m, the position is wrong by at most 3 eps
  /// m, its differences (x, y, z) from the center by 3 eps m + eps |x| and so on, the sum s of their squares by 6 eps m
  /// (|x| + |y| + |z|) + 5 eps s, and what is compared by eps (s + r^2) more. At least twice that is taken.
  bool ball_holds(const Ball& ball, const Corner& corner) const {
    const Vec3 d = corner.position - ball.center;
    const double square = dot(d, d), most = ball.radius * ball.radius;
    const double reach = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    const double error = 0x1p-49 * (largest_ * reach + square + most) + 0x1p-1000;
    if (most - square > error) return true;
    if (square - most > error) return false;
    return holds(ball, triangle_, corner.weights);
  }

  static double side(const Corners& corners, std::size_t i) {
    return norm(corners[(i + 1) % corners.size()].position - corners[i].position);
  }
  static std::size_t longest_side(const Corners& corners) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < corners.size(); ++i)
      if (side(corners, i) > side(corners, longest)) longest = i;
    return longest;
  }

  /// Whether half of a weight may be rounded.
  static bool is_fine(const Vec3& weights) {
    constexpr double kUnit = 0x1p50;
    return std::fmod(weights.x * kUnit, 1) != 0 || std::fmod(weights.y * kUnit, 1) != 0 ||
           std::fmod(weights.z * kUnit, 1) != 0;
  }

  const Triangle triangle_;
  const Balls& balls_;
  const double largest_;  // coordinate of the triangle
  const double smallest_;
  Steps& steps_;
  Corner point_;
};

/// Whether a triangle may touch a cube: false only if it does not. Separating axes (Akenine-Moller 2001); sums of at
/// most six products, of factors below 2 largest and 2 reach, are rounded by less than `slack`; what
/// underflows is less than kUnderflow.
bool may_touch(const Box& cube, const Triangle& t, double largest) {
  if (!cube.overlaps(box_of(t))) return false;
  const Vec3 m = cube.center(), half = (cube.max - cube.min) * 0.5;
  const std::array<Vec3, 3> v{t.a - m, t.b - m, t.c - m}, e{t.b - t.a, t.c - t.b, t.a - t.c};
  double reach = 0;
  for (const Vec3& p : v) reach = std::max(reach, norm(p));
  reach += norm(half);
  const auto is_apart = [&](const Vec3& axis, double slack) {
    const double r = half.x * std::abs(axis.x) + half.y * std::abs(axis.y) + half.z * std::abs(axis.z) + slack;
    const auto [least, greatest] = std::minmax({dot(axis, v[0]), dot(axis, v[1]), dot(axis, v[2])});
    return least > r || greatest < -r;
  };
  constexpr double kRounding = 0x1p-44, kUnderflow = 0x1p-1000;
  if (is_apart(cross(e[0], e[1]), kRounding * largest * reach * reach + kUnderflow)) return false;
  for (const Vec3& side : e)
    for (const Vec3& axis : {Vec3{0, -side.z, side.y}, Vec3{side.z, 0, -side.x}, Vec3{-side.y, side.x, 0}})
      if (is_apart(axis, kRounding * largest * reach + kUnderflow)) return false;
  return true;
}

/// The corners of what is left of t in the box.
template <class Field>
std::vector<std::array<Field, 3>> clipped(const Triangle& t, const Box& box) {
  std::vector<std::array<Field, 3>> polygon;
  for (const Vec3& p : {t.a, t.b, t.c}) polygon.push_back({Field(p.x), Field(p.y), Field(p.z)});
  for (int axis = 0; axis < 3; ++axis)
    for (const int sign : {-1, 1}) {
      const Field wall(sign < 0 ? box.min[axis] : box.max[axis]);
      const auto beyond = [&](const std::array<Field, 3>& p) { return Field((p[axis] - wall) * Field(sign)); };
      std::vector<std::array<Field, 3>> rest;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const Field here = beyond(p), next = beyond(q);
        if (!(here > Field(0))) rest.push_back(p);
        if (!((here > Field(0) && next < Field(0)) || (here < Field(0) && next > Field(0)))) continue;
        auto& x = rest.emplace_back();
        for (int k = 0; k < 3; ++k) x[k] = (here * q[k] - next * p[k]) / (here - next);
      }
      polygon = std::move(rest);
    }
  return polygon;
}

/// Cuts the solid into cubes.
class CubeCutter {
 public:
  CubeCutter(const Surface& solid, const Balls& balls, double smallest, const EnclosureOptions& options)
      : solid_(solid),
        balls_(balls),
        counter_(options.progress, "verify", kMostCubes),
        steps_(counter_.meter(), options.max_steps),
        smallest_(smallest) {}

  Decision decide() {
    Box box;
    for (const Triangle& t : solid_.faces) box.extend(box_of(t));
    if (box.is_empty()) return Decision::Covered;
    const Box root = root_cube(box);
    for (int i = 0; i < 3; ++i) largest_ = std::max({largest_, std::abs(root.min[i]), std::abs(root.max[i])});
    smallest_ = std::max(smallest_, largest_ * 0x1p-50);
    std::vector<FaceIndex> faces(solid_.faces.size());
    for (FaceIndex f = 0; f < faces.size(); ++f) faces[f] = f;
    coarse_ = kCoarse * (root.max.x - root.min.x);
    const bool has_hole = !is_free_of_holes(root, balls_.near(root), faces, false);
    counter_.finish();
    return has_hole ? Decision::Outside : decision_;
  }

  /// That no ball holds.
  const Vec3& point() const { return point_; }

 private:
  static Box root_cube(const Box& box) {
    const Vec3 size = box.max - box.min;
    const double side = std::exp2(std::ceil(std::log2(std::max({size.x, size.y, size.z}))) + 1), unit = side / 1024;
    Box root;
    for (int i = 0; i < 3; ++i) {
      root.min[i] = std::floor(box.min[i] / unit) * unit;
      root.max[i] = root.min[i] + side;
    }
    return root;
  }

  /// False if a point was found that no ball holds. `lies_inside` tells that all of the cube lies inside of the solid;
  /// else the faces are those that may touch it.
  bool is_free_of_holes(const Box& cube, const BallSet& near, const std::vector<FaceIndex>& faces, bool lies_inside) {
    counter_.next();
    ++count_;
    const Vec3 m = cube.center();
    if (is_in_one_ball(cube, m, near)) return true;
    std::vector<FaceIndex> touching;
    if (!lies_inside) {
      for (const FaceIndex f : faces)
        if (may_touch(cube, solid_.faces[f], largest_)) touching.push_back(f);
      if (touching.empty()) {
        if (winding_at(solid_, ExactPoint(m)) < 1) return true;
        lies_inside = true;
      } else if (touching.size() <= kFewFaces && is_solid_in_one_ball(cube, touching, near)) {
        return true;
      }
    }
    const bool is_held = std::any_of(near.begin(), near.end(), [&](BallIndex i) { return holds(balls_[i], m); });
    if (!is_held && (lies_inside || is_inside(m, touching))) {
      point_ = m;
      return false;
    }
    const double smallest = decision_ == Decision::Covered ? smallest_ : std::max(smallest_, coarse_);
    const bool is_over = !steps_.may_take(1 + near.size() + faces.size()) || count_ > kMostCubes;
    if (cube.max.x - cube.min.x < smallest || is_over) {
      decision_ = Decision::Undecided;
      return true;
    }
    for (int i = 0; i < 8; ++i) {
      Box eighth = cube;
      for (int axis = 0; axis < 3; ++axis) (i >> axis & 1 ? eighth.min : eighth.max)[axis] = m[axis];
      if (!is_free_of_holes(eighth, balls_.near(eighth, near), touching, lies_inside)) return false;
    }
    return true;
  }

  /// The corner farthest from the centre of a ball decides.
  bool is_in_one_ball(const Box& cube, const Vec3& middle, const BallSet& near) const {
    return std::any_of(near.begin(), near.end(), [&](BallIndex i) {
      const Ball& ball = balls_[i];
      Vec3 farthest;
      for (int axis = 0; axis < 3; ++axis)
        farthest[axis] = (ball.center[axis] >= middle[axis] ? cube.min : cube.max)[axis];
      return holds(ball, farthest);
    });
  }

  /// The part of the solid in the cube.
  bool is_solid_in_one_ball(const Box& cube, const std::vector<FaceIndex>& faces, const BallSet& near) const {
    std::vector<std::array<double, 3>> rough;
    for (const FaceIndex f : faces)
      for (const auto& p : clipped<double>(solid_.faces[f], cube)) rough.push_back(p);
    return std::any_of(near.begin(), near.end(), [&](BallIndex i) {
      constexpr double kAbout = 1 + 1e-9;
      const Ball& ball = balls_[i];
      const auto may_hold = [&](const auto& p) {
        return squared_distance(p, ball.center) <= kAbout * ball.radius * ball.radius;
      };
      return std::all_of(rough.begin(), rough.end(), may_hold) && holds_corners_inside(ball, cube, faces) &&
             std::all_of(faces.begin(), faces.end(), [&](FaceIndex f) { return holds_part(ball, f, cube); });
    });
  }

  bool holds_part(const Ball& ball, FaceIndex f, const Box& cube) const {
    const Rational radius(ball.radius);
    const auto polygon = clipped<Rational>(solid_.faces[f], cube);
    return std::all_of(polygon.begin(), polygon.end(),
                       [&](const auto& p) { return squared_distance(p, ball.center) <= radius * radius; });
  }

  bool holds_corners_inside(const Ball& ball, const Box& cube, const std::vector<FaceIndex>& faces) const {
    for (int i = 0; i < 8; ++i) {
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis) p[axis] = (i >> axis & 1 ? cube.max : cube.min)[axis];
      if (holds(ball, p)) continue;
      const auto is_on = [&](FaceIndex f) { return triangles_touch({p, p, p}, solid_.faces[f]); };
      if (std::none_of(faces.begin(), faces.end(), is_on) && winding_at(solid_, ExactPoint(p)) >= 1) return false;
    }
    return true;
  }

  /// Whether p lies inside of the solid; false in the planes of the faces around.
  bool is_inside(const Vec3& p, const std::vector<FaceIndex>& around) const {
    const auto is_in_plane = [&](FaceIndex f) { return side(solid_.faces[f], p) == Side::On; };
    return std::none_of(around.begin(), around.end(), is_in_plane) && winding_at(solid_, ExactPoint(p)) >= 1;
  }

  const Surface& solid_;
  const Balls& balls_;
  ProgressCounter counter_;
  Steps steps_;
  double smallest_, largest_ = 0, coarse_ = 0;
  std::size_t count_ = 0;
  Decision decision_ = Decision::Covered;  ///< of the cubes so far
  Vec3 point_;
};

class BallUnionJudge {
 public:
  BallUnionJudge(std::span<const Ball> balls, const TriangleMesh& original, const PreparedOriginal& prepared,
                 const VerificationOptions& options, UnionVerification& found)
      : balls_(balls),
        original_(original),
        smallest_(kSmallest * prepared.box.diagonal()),
        options_(options),
        meter_(options.progress, "verify"),
        found_(found) {}

  void cover_triangles() {
    const PerVertex<BallSet> holders = holders_of_vertices();
    std::vector<Offender> offenders;
    Steps steps(meter_, most_steps(options_, original_.face_count()));
    for (const FaceId f : original_.triangles.ids()) {
      if (index(f) % 64 == 0) meter_.at(0.5 * index(f) / static_cast<double>(original_.face_count()));
      if (have_common(original_.triangles[f], [&](VertexId v) -> const BallSet& { return holders[v]; })) continue;
      TriangleCutter cutter(original_.triangle(f), balls_, smallest_, steps);
      const Decision decision = cutter.decide();
      const auto& [weights, position, holders_there] = cutter.point();
      if (decision == Decision::Outside) {
        offenders.push_back(offender(f, position));
        if (!found_.point_outside) found_.point_outside = {f, {weights.x, weights.y, weights.z}};
      } else if (decision == Decision::Undecided) {
        ++found_.faces_undecided;
        if (found_.undecided.size() < options_.max_offenders) found_.undecided.push_back({f, position, 0});
      }
    }
    found_.faces_outside = offenders.size();
    found_.covers_triangles = !offenders.empty()           ? Answer::No
                              : found_.faces_undecided > 0 ? Answer::Undecided
                                                           : Answer::Yes;
    if (!offenders.empty()) refuse("triangles of the original lie outside of the balls, or in part");
    found_.worst = worst_of(std::move(offenders), options_.max_offenders);
  }

  void fill_inside() {
    const Surface solid(original_, "original");
    const EnclosureOptions search{.progress = meter_.part(0.5, 1),
                                  .max_steps = most_steps(options_, original_.face_count())};
    CubeCutter cutter(solid, balls_, smallest_, search);
    const Decision decision = cutter.decide();
    found_.inside_undecided = decision == Decision::Undecided;
    found_.encloses_solid = decision == Decision::Outside     ? Answer::No
                            : decision == Decision::Undecided ? Answer::Undecided
                                                              : Answer::Yes;
    if (decision != Decision::Outside) return;
    found_.holes = 1;
    const Vec3& p = cutter.point();
    std::ostringstream text;
    text.precision(17);
    text << "the balls leave a part of the inside open, for instance at (" << p.x << ", " << p.y << ", " << p.z << ')';
    refuse(text.str());
  }

  /// What is in doubt is no reason to say that something lies outside.
  void finish() {
    if (found_.faces_undecided > 0 || found_.inside_undecided) {
      std::string what = counted(found_.faces_undecided, "triangle");
      if (found_.inside_undecided) what = found_.faces_undecided > 0 ? what + " and the inside" : "the inside";
      refuse("it is undecided whether the balls cover all of " + what +
             ": they have less than 1e-9 of the diagonal to spare there, or the decision takes too long; make them a "
             "little larger");
    }
    meter_.at(1);
  }

 private:
  PerVertex<BallSet> holders_of_vertices() const {
    PerVertex<BallSet> holders(original_.vertex_count());
    for (const VertexId v : original_.positions.ids()) {
      const Vec3& p = original_.positions[v];
      if (!is_finite(p)) continue;
      for (const BallIndex i : balls_.near({p, p}))
        if (holds(balls_[i], p)) holders[v].push_back(i);
    }
    return holders;
  }

  Offender offender(FaceId f, const Vec3& found) const {
    const auto [a, b, c] = original_.triangle(f);
    Offender result{f, found, balls_.distance(found)};
    for (const Vec3& p : {a, b, c, a * 0.5 + b * 0.5, b * 0.5 + c * 0.5, c * 0.5 + a * 0.5, a / 3 + b / 3 + c / 3})
      if (const double d = balls_.distance(p); d > result.distance) result.point = p, result.distance = d;
    return result;
  }

  void refuse(const std::string& why) {
    found_.certified = false;
    if (found_.why_not.empty()) found_.why_not = why;
  }

  const Balls balls_;
  const TriangleMesh& original_;
  const double smallest_;
  const VerificationOptions& options_;
  ProgressMeter meter_;
  UnionVerification& found_;
};

void check(std::span<const Ball> balls) {
  if (balls.empty()) throw InputError(Defect::EmptyMesh, "there is no ball: a union needs at least one");
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const auto& [center, radius] = balls[i];
    if (!is_finite(center) || !(radius >= 0) || !std::isfinite(radius))
      throw InputError(Defect::NonFiniteCoordinate,
                       "ball " + std::to_string(i + 1) +
                           ": its centre and radius must be finite, and its radius not negative; remove it");
  }
  Box box;
  for (const Ball& ball : balls) box.extend(box_around(ball));
  require_usable_reach(box, "coordinates of the balls");
}

}  // namespace
}  // namespace verify

UnionVerification verify_union(std::span<const Ball> balls, TriangleMesh original, bool inside,
                               const VerificationOptions& options) {
  UnionVerification found;
  const verify::PreparedOriginal prepared = verify::prepare_original(original, found.notes);
  if (!prepared.closed) found.notes.emplace_back(verify::kNotClosed);
  verify::check(balls);
  verify::take_facts(prepared, found);
  found.certified = true;
  verify::BallUnionJudge judge(balls, original, prepared, options, found);
  if (!options.solid_only || !prepared.closed) judge.cover_triangles();
  const bool asks_inside = prepared.closed && (inside || options.solid_only);
  if (asks_inside && found.faces_outside == 0)
    judge.fill_inside();
  else if (asks_inside)
    found.encloses_solid = Answer::Undecided;
  found.union_volume = union_volume(balls);
  if (prepared.closed) {
    ProgressMeter meter(options.progress, "verify");
    found.original_volume = verify::solid_volume(original, meter);
  }
  if (found.original_volume > 0) found.void_ratio = found.union_volume / found.original_volume - 1;
  verify::refuse_non_finite_faces(prepared.non_finite_faces, options, found.certified, found.why_not);
  judge.finish();
  return found;
}

}  // namespace prohull
