#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/largest_coordinate.h"
#include "geometry/winding_number.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/enclosure.h"
#include "prohull/union_verification.h"
#include "verify/exposed_surface.h"
#include "verify/nearest_face.h"
#include "verify/surface.h"

// The surfaces of the pieces are cut into parts, the one with the greatest bound first, as by distance_bounds. Two
// bounds hold for the points of a part that are outside of the solid:
//
//   (1) The distance to a triangle is a convex function: within the convex hull of some corners, a corner is farthest.
//   (2) Let the part lie in the ball (m, r), and m inside of the solid, at the depth s. On the way from m to a point
//       outside, the surface of the solid is not met before s: the rest of the way is at most r - s.
//
// What holds for a part holds for what it is cut into.

namespace prohull {
namespace {

/// The triangles from which distances count, and the solid if they bound one. What lies in cavities reaches nowhere
/// out.
class Target {
 public:
  explicit Target(TriangleMesh original) : is_closed_(is_closed(original)), mesh_(std::move(original)) {
    if (is_closed_) {
      decltype(mesh_.triangles) outer;
      std::vector<Triangle> triangles;
      for (const FaceId f : verify::turn_outwards_and_fill(mesh_, "original"))
        outer.push_back(mesh_.triangles[f]), triangles.push_back(mesh_.triangle(f));
      mesh_.triangles = std::move(outer);
      winding_.emplace(std::move(triangles));
    }
    faces_.emplace(mesh_);
  }

  bool is_closed_mesh() const { return is_closed_; }
  const verify::NearestFace& faces() const { return *faces_; }
  double diagonal() const { return bounding_box(mesh_).diagonal(); }

  // Both are false for points on the surface, and for a few in the planes of triangles.
  bool is_inside(const Vec3& p) const { return winding_ && winding_->at(p).value_or(0) >= 1; }
  bool is_outside(const Vec3& p) const { return !winding_ || winding_->at(p).value_or(1) < 1; }

 private:
  const bool is_closed_;
  TriangleMesh mesh_;
  std::optional<verify::NearestFace> faces_;
  std::optional<WindingNumber> winding_;
};

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
    const int i = verify::longest_side(corners), j = (i + 1) % 3, k = (i + 2) % 3;
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
  /// The triangle between the directions, and the same moved outwards until the sphere is beneath it: a point between
  /// directions whose cosines with their middle are at least c is no nearer to the centre than c.
  std::array<Vec3, 6> hull() const {
    const Vec3 sum = directions[0] + directions[1] + directions[2];
    double cosine = 1;
    for (const Vec3& direction : directions) cosine = std::min(cosine, dot(direction, sum) / norm(sum));
    std::array<Vec3, 6> corners;
    for (int i = 0; i < 3; ++i) {
      corners[i] = ball.center + directions[i] * ball.radius;
      corners[i + 3] = ball.center + directions[i] * (ball.radius / cosine);
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
    const int i = verify::longest_side(directions), j = (i + 1) % 3, k = (i + 2) % 3;
    const Vec3 sum = directions[i] + directions[j], middle = sum / norm(sum);
    return {SpherePart{ball, {directions[i], middle, directions[k]}},
            SpherePart{ball, {middle, directions[j], directions[k]}}};
  }
};

/// A part of the pieces' surfaces, and the triangle nearest to the middle of what it was cut from.
template <class Shape>
struct PartOfUnion {
  Shape shape;
  std::uint32_t nearest = 0;
  double most = std::numeric_limits<double>::infinity();  ///< none of its points that count is farther away
};

/// How far points of the surfaces are that lie outside of the solid.
template <class Shape>
class FarFromSolid {
 public:
  using Part = PartOfUnion<Shape>;
  using Search = verify::GreatestDistance<FarFromSolid>;
  /// No point counts of what lies between corners that are hidden.
  using IsHidden = std::function<bool(const Shape&, std::span<const Vec3> corners)>;

  FarFromSolid(const Target& target, IsHidden is_hidden) : target_(target), is_hidden_(std::move(is_hidden)) {}

  void add(Part part, Search& search) const {
    if (!search.is_enough(part.most)) part.most = std::min(part.most, upper(part, search));
    search.add(part, part.most);
  }

  void cut(const Part& part, Search& search) const {
    for (const Shape& half : part.shape.halves()) add({half, part.nearest, part.most}, search);
  }

  /// A point of the shape that may be far away.
  void look_at(const Shape& shape, const Vec3& p, double distance, Search& search) const {
    if (distance > search.lower() && target_.is_outside(p) && !is_hidden_(shape, {&p, 1})) search.reaches(p, distance);
  }

 private:
  /// Any bound that search.is_enough() will do.
  double upper(Part& part, Search& search) const {
    const double by_guess = farthest_corner(part);
    if (search.is_enough(by_guess)) return by_guess;
    if (is_hidden_(part.shape, part.shape.hull())) return 0;
    const Vec3 middle = part.shape.center();
    const auto [face, distance] = target_.faces().nearest(middle, part.nearest);
    part.nearest = face;
    const double by_corners = farthest_corner(part);
    if (search.is_enough(by_corners)) return by_corners;
    if (target_.is_inside(middle)) return std::min(by_corners, part.shape.radius() - distance);
    look_at(part.shape, middle, distance, search);
    return by_corners;
  }

  double farthest_corner(const Part& part) const {
    double farthest = 0;
    for (const Vec3& p : part.shape.hull()) farthest = std::max(farthest, target_.faces().distance(p, part.nearest));
    return farthest;
  }

  const Target& target_;
  const IsHidden is_hidden_;
};

/// Else a reach of 0 would never be found.
constexpr double kAbsoluteGap = 1e-4;  // of the diagonal

verify::SearchLimits limits_of(const DistanceOptions& options, const Target& target) {
  return {.relative_gap = options.relative_gap,
          .absolute_gap = kAbsoluteGap * target.diagonal(),
          .max_parts = options.max_cells};
}

/// Twice that of distances: the parts of spheres are rounded, too. Parts of faces are halved at most 106 times, 53 in
/// each direction of a plane: then no number is left between corners.
double rounding_of(double largest) { return 2 * verify::rounding_of_distances(largest); }

/// Ends the search.
template <class Search>
DistanceBounds reach_of(Search& search, const Target& target, ProgressCounter& counter, double largest) {
  const DistanceBounds found = search.run([&] { counter.next(); });
  counter.finish();
  return verify::proven(found, target.faces(), rounding_of(largest));
}

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

/// With `rounding` to spare.
bool holds_all(const Ball& ball, std::span<const Vec3> points, double rounding) {
  return std::ranges::all_of(points, [&](const Vec3& p) { return norm(p - ball.center) + rounding < ball.radius; });
}

double largest_coordinate(const Ball& ball) {
  const Vec3 all{ball.radius, ball.radius, ball.radius};
  return largest_coordinate(Box{ball.center - all, ball.center + all});
}

DistanceBounds reach_from_solid(std::span<const TriangleMesh> pieces, const Target& target, double largest,
                                const DistanceOptions& options) {
  using Rule = FarFromSolid<FlatPart>;
  const Rule rule(target, [](const FlatPart&, std::span<const Vec3>) { return false; });
  Rule::Search search(rule, limits_of(options, target));
  ProgressCounter counter(options.progress, "measure", options.max_cells);
  std::uint32_t last = 0;
  for (const TriangleMesh& piece : pieces)
    for (const Vec3& p : piece.positions) {
      counter.next();
      const auto [face, distance] = target.faces().nearest(p, last);
      rule.look_at({}, p, distance, search);
      last = face;
    }
  for (const TriangleMesh& piece : pieces)
    for (const FaceId f : piece.triangles.ids()) {
      counter.next();
      const Triangle t = piece.triangle(f);
      rule.add({{{t.a, t.b, t.c}}, last}, search);
    }
  return reach_of(search, target, counter, largest);
}

}  // namespace

DistanceBounds union_reach(std::span<const TriangleMesh> pieces, const TriangleMesh& original,
                           const DistanceOptions& options) {
  verify::require_distances(original);
  double largest = verify::largest_coordinate(original);
  for (const TriangleMesh& piece : pieces) largest = std::max(largest, verify::largest_coordinate(piece));
  if (const double unit = verify::usable_unit(largest); unit != 1) {
    std::vector<TriangleMesh> all;
    for (const TriangleMesh& piece : pieces) all.push_back(verify::scaled(piece, unit));
    return verify::unscaled(union_reach(all, verify::scaled(original, unit), options), unit);
  }
  const Target target(original);
  if (target.is_closed_mesh()) return reach_from_solid(pieces, target, largest, options);
  if (!std::ranges::all_of(pieces, verify::is_about_convex)) {
    TriangleMesh surfaces;
    for (const TriangleMesh& piece : pieces) append(surfaces, piece);
    return distance_bounds(surfaces, original, options);
  }
  DistanceBounds bounds = distance_bounds(verify::exposed_surface(pieces), original, options);
  Box box;
  for (const TriangleMesh& piece : pieces) box.extend(bounding_box(piece));
  bounds.upper += verify::kExposedSurfaceRounding * box.diagonal();
  return bounds;
}

DistanceBounds union_reach(std::span<const Ball> balls, const TriangleMesh& original, const DistanceOptions& options) {
  verify::require_distances(original);
  double largest = verify::largest_coordinate(original);
  for (const Ball& ball : balls) largest = std::max(largest, largest_coordinate(ball));
  if (const double unit = verify::usable_unit(largest); unit != 1) {
    std::vector<Ball> all;
    for (const Ball& ball : balls) all.push_back({ball.center * unit, ball.radius * unit});
    return verify::unscaled(union_reach(all, verify::scaled(original, unit), options), unit);
  }
  const Target target(original);
  using Rule = FarFromSolid<SpherePart>;
  // Without a solid, spheres within other balls would count, far from all triangles.
  const Rule rule(target, [&](const SpherePart& part, std::span<const Vec3> corners) {
    return !target.is_closed_mesh() && std::ranges::any_of(balls, [&](const Ball& other) {
      return other != part.ball && holds_all(other, corners, rounding_of(largest));
    });
  });
  Rule::Search search(rule, limits_of(options, target));
  ProgressCounter counter(options.progress, "measure", options.max_cells);
  for (const Ball& ball : balls) {
    const auto [nearest, depth] = target.faces().nearest(ball.center, 0);
    Rule::Part part;
    part.nearest = nearest;
    if (target.is_inside(ball.center)) part.most = std::max(0.0, ball.radius - depth);
    for (const SpherePart& eighth : parts_of(ball)) counter.next(), part.shape = eighth, rule.add(part, search);
  }
  return reach_of(search, target, counter, largest);
}

}  // namespace prohull
