#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "geometry/bvh.h"
#include "geometry/closest_point.h"
#include "geometry/largest_coordinate.h"
#include "geometry/winding_number.h"
#include "parallel/progress_meter.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/union_verification.h"
#include "verify/distance.h"
#include "verify/exposed_surface.h"

// The surfaces of the pieces are cut into parts, the one with the greatest bound first, as by distance_bounds. Two
// bounds hold for the points of a part that are outside of the solid:
//
//   (1) The distance to a triangle is a convex function: within the convex hull of some corners, a corner is farthest.
//   (2) Let the part lie in the ball (m, r), and m inside of the solid, at the depth s. On the way from m to a point
//       outside, the surface of the solid is not met before s: the rest of the way is at most r - s.

namespace prohull {
namespace {

/// The triangles from which distances count, and the solid if they bound one.
class Target {
 public:
  explicit Target(const TriangleMesh& original) {
    if (original.face_count() == 0) throw InputError(Defect::EmptyMesh, "there is no distance without faces");
    for (const Vec3& p : original.positions)
      largest_ = std::max({largest_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    closed_ = is_closed(original);
    const TriangleMesh mesh = closed_ ? turned_outwards(original) : original;
    std::vector<Box> boxes;
    for (const FaceId f : mesh.triangles.ids()) {
      triangles_.push_back(mesh.triangle(f));
      boxes.push_back(box_of(triangles_.back()));
    }
    tree_ = Bvh(std::move(boxes));
    if (closed_) winding_.emplace(triangles_);
    diagonal_ = bounding_box(mesh).diagonal();
  }

  bool is_closed_mesh() const { return closed_; }
  double diagonal() const { return diagonal_; }
  double largest_coordinate() const { return largest_; }

  double distance(const Vec3& p, std::uint32_t f) const { return norm(p - closest_point(p, triangles_[f])); }

  /// The triangle nearest to p; `guess` is one that may be near.
  std::uint32_t nearest(const Vec3& p, std::uint32_t guess) const {
    double known = distance(p, guess);
    tree_.least([&](const Box& box) { return verify::distance(p, box); },
                [&](std::uint32_t f) {
                  const double d = distance(p, f);
                  if (d < known) known = d, guess = f;
                  return d;
                },
                known);
    return guess;
  }

  // Both are false for points on the surface, and for a few in the planes of triangles.
  bool is_inside(const Vec3& p) const { return winding_ && winding_->at(p).value_or(0) >= 1; }
  bool is_outside(const Vec3& p) const { return !winding_ || winding_->at(p).value_or(1) < 1; }

 private:
  std::vector<Triangle> triangles_;
  Bvh tree_;
  std::optional<WindingNumber> winding_;
  bool closed_ = false;
  double diagonal_ = 0, largest_ = 0;
};

int longest_side(const std::array<Vec3, 3>& corners) {
  int longest = 0;
  double length = -1;
  for (int i = 0; i < 3; ++i)
    if (const double l = squared_norm(corners[(i + 1) % 3] - corners[i]); l > length) length = l, longest = i;
  return longest;
}

/// A part of a face.
struct FlatPart {
  std::array<Vec3, 3> corners;

  Vec3 center() const { return corners[0] / 3 + corners[1] / 3 + corners[2] / 3; }
  const std::array<Vec3, 3>& hull() const { return corners; }
  double radius() const {
    const Vec3 m = center();
    return std::max({norm(corners[0] - m), norm(corners[1] - m), norm(corners[2] - m)});
  }
  std::array<FlatPart, 2> halves() const {
    const int i = longest_side(corners), j = (i + 1) % 3, k = (i + 2) % 3;
    const Vec3 middle = corners[i] * 0.5 + corners[j] * 0.5;
    return {FlatPart{{corners[i], middle, corners[k]}}, FlatPart{{middle, corners[j], corners[k]}}};
  }
};

/// A part of a sphere between three directions.
struct SpherePart {
  Ball ball;
  std::array<Vec3, 3> directions;

  Vec3 at(const Vec3& direction) const { return ball.center + direction * (ball.radius / norm(direction)); }
  Vec3 center() const { return at(directions[0] + directions[1] + directions[2]); }
  /// The triangle between the directions, and the same moved outwards until the sphere is beneath it.
  std::array<Vec3, 6> hull() const {
    const auto& [a, b, c] = directions;
    const Vec3 n = cross(b - a, c - a);
    const double outwards = norm(n) / dot(n, a);
    std::array<Vec3, 6> corners;
    for (int i = 0; i < 3; ++i) {
      corners[i] = ball.center + directions[i] * ball.radius;
      corners[i + 3] = ball.center + directions[i] * (ball.radius * outwards);
    }
    return corners;
  }
  double radius() const {
    const Vec3 m = center();
    double largest = 0;
    for (const Vec3& direction : directions) largest = std::max(largest, norm(at(direction) - m));
    return largest;
  }
  std::array<SpherePart, 2> halves() const {
    const int i = longest_side(directions), j = (i + 1) % 3, k = (i + 2) % 3;
    const Vec3 sum = directions[i] + directions[j], middle = sum / norm(sum);
    return {SpherePart{ball, {directions[i], middle, directions[k]}},
            SpherePart{ball, {middle, directions[j], directions[k]}}};
  }
};

template <class Part>
class ReachSearch {
 public:
  /// No point counts of what lies between corners that are hidden.
  using IsHidden = std::function<bool(const Part&, std::span<const Vec3> corners)>;

  ReachSearch(const Target& target, double largest_coordinate, const DistanceOptions& options, IsHidden is_hidden)
      : target_(target),
        options_(options),
        is_hidden_(std::move(is_hidden)),
        counter_(options.progress, "measure", options.max_cells),
        // As in distance_bounds: closest points are computed within 16 eps of the largest coordinate for each of
        // theirs.
        rounding_(128 * 0x1p-53 * std::max(largest_coordinate, target.largest_coordinate())),
        absolute_gap_(kAbsoluteGap * target.diagonal()) {}

  /// A point of the part that may be far away.
  void look_at(const Part& part, const Vec3& p) {
    look_at(part, p, target_.distance(p, last_ = target_.nearest(p, last_)));
  }

  void add(const Part& part) { push(part, last_); }

  DistanceBounds run() {
    while (!cells_.empty() && cells_.top().upper > enough() && seen_ < options_.max_cells) {
      const Cell cell = cells_.top();
      cells_.pop();
      for (const Part& half : cell.part.halves()) push(half, cell.nearest);
    }
    const double left = cells_.empty() ? 0 : cells_.top().upper;
    bounds_.upper = std::max({left, settled_, bounds_.lower}) + rounding_;
    counter_.finish();
    return bounds_;
  }

 private:
  static constexpr double kAbsoluteGap = 1e-4;  ///< of the diagonal: else a reach of 0 would never be found

  struct Cell {
    Part part;
    std::uint32_t nearest;  ///< to its centre
    double upper;
    bool operator<(const Cell& other) const { return upper < other.upper; }
  };

  double enough() const { return (1 + options_.relative_gap) * bounds_.lower + absolute_gap_; }

  double farthest_corner(const Part& part, std::uint32_t f) const {
    double farthest = 0;
    for (const Vec3& p : part.hull()) farthest = std::max(farthest, target_.distance(p, f));
    return farthest;
  }

  void look_at(const Part& part, const Vec3& p, double distance) {
    if (distance > bounds_.lower && target_.is_outside(p) && !is_hidden_(part, {&p, 1}))
      bounds_.lower = distance, bounds_.farthest = p;
  }

  /// True if a bound settles the part.
  bool settle(double upper) {
    if (upper > enough()) return false;
    settled_ = std::max(settled_, upper);
    return true;
  }

  void push(const Part& part, std::uint32_t guess) {
    ++seen_;
    counter_.next();
    if (settle(farthest_corner(part, guess)) || is_hidden_(part, part.hull())) return;
    const Vec3 middle = part.center();
    last_ = target_.nearest(middle, guess);
    const double distance = target_.distance(middle, last_);
    double upper = farthest_corner(part, last_);
    if (settle(upper)) return;
    if (target_.is_inside(middle)) {
      upper = std::min(upper, part.radius() - distance);
      if (settle(upper)) return;
    } else {
      look_at(part, middle, distance);
    }
    cells_.push({part, last_, upper});
  }

  const Target& target_;
  const DistanceOptions& options_;
  const IsHidden is_hidden_;
  ProgressCounter counter_;
  const double rounding_, absolute_gap_;
  std::uint32_t last_ = 0;  // the triangle that was nearest last
  std::priority_queue<Cell> cells_;
  double settled_ = 0;
  std::size_t seen_ = 0;
  DistanceBounds bounds_;
};

/// The eighths of a sphere.
std::vector<SpherePart> parts_of(const Ball& ball) {
  std::vector<SpherePart> parts;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) {
        SpherePart part{ball, {Vec3{x, 0, 0}, Vec3{0, y, 0}, Vec3{0, 0, z}}};
        if (x * y * z < 0) std::swap(part.directions[0], part.directions[1]);
        parts.push_back(part);
      }
  return parts;
}

bool holds_all(const Ball& ball, std::span<const Vec3> points) {
  return std::ranges::all_of(points, [&](const Vec3& p) { return norm(p - ball.center) < ball.radius; });
}

}  // namespace

DistanceBounds union_reach(std::span<const TriangleMesh> pieces, const TriangleMesh& original,
                           const DistanceOptions& options) {
  const Target target(original);
  if (!target.is_closed_mesh()) {
    DistanceBounds bounds = distance_bounds(verify::exposed_surface(pieces), original, options);
    Box box;
    for (const TriangleMesh& piece : pieces) box.extend(bounding_box(piece));
    bounds.upper += verify::kExposedSurfaceRounding * box.diagonal();
    return bounds;
  }
  double largest = 0;
  for (const TriangleMesh& piece : pieces) largest = std::max(largest, largest_coordinate(bounding_box(piece)));
  ReachSearch<FlatPart> search(target, largest, options, [](const FlatPart&, std::span<const Vec3>) { return false; });
  for (const TriangleMesh& piece : pieces)
    for (const Vec3& p : piece.positions) search.look_at({}, p);
  for (const TriangleMesh& piece : pieces)
    for (const FaceId f : piece.triangles.ids()) {
      const Triangle t = piece.triangle(f);
      search.add({{t.a, t.b, t.c}});
    }
  return search.run();
}

DistanceBounds union_reach(std::span<const Ball> balls, const TriangleMesh& original, const DistanceOptions& options) {
  const Target target(original);
  // Without a solid, spheres within other balls would count, far from all triangles.
  const auto is_hidden = [&](const SpherePart& part, std::span<const Vec3> corners) {
    return !target.is_closed_mesh() && std::ranges::any_of(balls, [&](const Ball& other) {
      return other != part.ball && holds_all(other, corners);
    });
  };
  double largest = 0;
  for (const Ball& ball : balls) {
    const Vec3 all{ball.radius, ball.radius, ball.radius};
    largest = std::max(largest, largest_coordinate({ball.center - all, ball.center + all}));
  }
  ReachSearch<SpherePart> search(target, largest, options, is_hidden);
  for (const Ball& ball : balls)
    for (const SpherePart& part : parts_of(ball)) search.add(part);
  return search.run();
}

}  // namespace prohull
