#include "cover/few_vertices.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "cover/polytope.h"
#include "cover/primitives.h"
#include "cover/tightening.h"
#include "geometry/directions.h"
#include "geometry/float32.h"
#include "geometry/largest_coordinate.h"
#include "geometry/predicates.h"
#include "prohull/convex_hull.h"
#include "prohull/detail/float32_hull.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"

namespace prohull::cover {
namespace {

bool encloses(const TriangleMesh& outer, const TriangleMesh& inner) {
  for (const FaceId f : outer.triangles.ids()) {
    const auto [a, b, c] = outer.triangle(f);
    for (const Vec3& p : inner.positions)
      if (side(a, b, c, p) == Side::Outside) return false;
  }
  return true;
}

/// How coordinates are stored.
struct Storage {
  bool float32;

  Vec3 operator()(const Vec3& p) const { return float32 ? nearest_float32(p) : p; }

  /// No less than what storing a vertex near the box moves its coordinates, with the arithmetic before it.
  double rounding(const Box& box) const {
    const double largest = largest_coordinate(box);
    return float32 ? std::max(largest * 0x1.1p-24, 0x1p-149) : std::max(largest * 0x1p-49, 0x1p-1070);
  }
};

/// Encloses the box: another box, `margin` away, or a tetrahedron if it may not have 8 vertices.
std::vector<Vec3> plain_corners(const Box& box, double margin, bool may_be_box) {
  const Vec3 away{margin, margin, margin};
  const Vec3 low = box.min - away, size = (box.max - low + away) * (may_be_box ? 1.0 : 3.0);
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    if (may_be_box || i == 0 || i == 1 || i == 2 || i == 4)
      corners.push_back(low + Vec3{i & 1 ? size.x : 0, i & 2 ? size.y : 0, i & 4 ? size.z : 0});
  return corners;
}

/// Around the origin, its vertices evenly spread; turned another way for every `turn`.
TriangleMesh round_polytope(std::size_t vertices, int turn) {
  std::vector<Vec3> corners = spread_directions(vertices);
  const double c = std::cos(turn), s = std::sin(turn);
  for (Vec3& p : corners) {
    p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    p = {p[turn % 3], p[(turn + 1) % 3], p[(turn + 2) % 3]};
  }
  return convex_hull_of(std::move(corners));
}

/// Begins with several polytopes, makes each tight, and keeps the one of least volume.
class Reduction {
 public:
  Reduction(const TriangleMesh& polytope, std::size_t max_vertices, bool float32)
      : polytope_(polytope),
        max_vertices_(max_vertices),
        store_{float32},
        box_(bounding_box(polytope)),
        target_(polytope, store_.rounding(box_)) {}

  TriangleMesh run() {
    offer(collapsed());
    // Edge collapses have too little choice for very few vertices, and now and then none at all.
    constexpr std::size_t kVeryFew = 12, kTurns = 48;
    if (max_vertices_ <= kVeryFew || !best_)
      for (std::size_t turn = 0; turn < std::max<std::size_t>(kTurns / max_vertices_, 1); ++turn)
        offer(round_polytope(max_vertices_, static_cast<int>(turn)));
    if (max_vertices_ <= kVeryFew && max_vertices_ >= 8) offer(box());
    if (best_)
      if (const auto result = stored(*best_)) return *result;
    return plain();
  }

 private:
  /// By edge collapses, in the local frame; they may leave more vertices.
  TriangleMesh collapsed() const {
    TriangleMesh local = convex_hull_of(target_.points());
    if (local.vertex_count() <= max_vertices_) return local;
    constexpr ShapeGuards kNoGuards{.max_valence = 64,
                                    .min_compactness_ratio = 0,
                                    .sufficient_compactness = 0,
                                    .max_normal_deviation = std::numbers::pi / 2,
                                    .max_overhang = std::numeric_limits<double>::infinity()};
    const HullOptions options{.target_faces = 2 * max_vertices_ - 4,
                              .guards = kNoGuards,
                              .self_intersections = SelfIntersections::Allowed,
                              .threads = 1};
    return convex_hull(build_hull(local, options).hull.base());
  }

  TriangleMesh box() const {
    std::vector<Vec3> corners;
    for (const Vec3& p : mesh_of(box_around(polytope_)).positions) corners.push_back(target_.frame().to_local(p));
    return convex_hull_of(std::move(corners));
  }

  void offer(const TriangleMesh& start) {
    if (start.face_count() == 0 || start.vertex_count() > max_vertices_) return;
    auto enclosing = scaled_around(start, target_);
    if (!enclosing) return;
    keep_better(scaled_around(tightened(*enclosing, target_), target_));
    keep_better(std::move(enclosing));
  }

  void keep_better(std::optional<TriangleMesh> polytope) {
    if (!polytope) return;
    const double volume = signed_volume(*polytope);
    if (!(volume < least_volume_)) return;
    least_volume_ = volume;
    best_ = std::move(polytope);
  }

  /// With coordinates as they are asked for, enclosing exactly; nothing if rounding defeats that.
  std::optional<TriangleMesh> stored(const TriangleMesh& local) const {
    constexpr double kLeast = 0x1p-52, kMost = 0.01;
    for (double spare = 0; spare < kMost; spare = std::max(8 * spare, kLeast)) {
      std::vector<Vec3> corners;
      for (const Vec3& p : local.positions) corners.push_back(target_.frame().to_world(p * (1 + spare)));
      if (auto result = exactly_enclosing(std::move(corners))) return result;
    }
    return std::nullopt;
  }

  std::optional<TriangleMesh> exactly_enclosing(std::vector<Vec3> corners) const {
    for (Vec3& p : corners) {
      p = store_(p);
      if (!is_finite(p)) return std::nullopt;
    }
    TriangleMesh hull = convex_hull_of(std::move(corners));
    if (hull.face_count() == 0 || !encloses(hull, polytope_)) return std::nullopt;
    return hull;
  }

  TriangleMesh plain() const {
    for (double margin = store_.rounding(box_); std::isfinite(margin); margin *= 8)
      if (auto result = exactly_enclosing(plain_corners(box_, margin, max_vertices_ >= 8))) return *result;
    throw InputError(Defect::NonFiniteCoordinate,
                     "the coordinates are too large for a polytope around them; scale the mesh");
  }

  const TriangleMesh& polytope_;
  const std::size_t max_vertices_;
  const Storage store_;
  const Box box_;
  const Target target_;
  std::optional<TriangleMesh> best_;
  double least_volume_ = std::numeric_limits<double>::infinity();
};

/// The polytope, grown about its middle until it encloses the other one with float32 coordinates.
std::optional<TriangleMesh> rounded_outwards(const TriangleMesh& polytope, const TriangleMesh& enclosed) {
  const Vec3 center = middle(polytope);
  for (double growth = 0x1p-24; growth < 0.05; growth *= 2) {
    std::vector<Vec3> corners;
    for (const Vec3& p : polytope.positions) corners.push_back(nearest_float32(center + (p - center) * (1 + growth)));
    if (!std::ranges::all_of(corners, is_finite)) return std::nullopt;
    TriangleMesh hull = convex_hull_of(std::move(corners));
    if (hull.face_count() > 0 && encloses(hull, enclosed)) return hull;
  }
  return std::nullopt;
}

/// The polytope, each vertex moved outwards to float32 coordinates; nothing if that leaves out some of the enclosed
/// one.
std::optional<TriangleMesh> moved_to_float32(const TriangleMesh& polytope, const TriangleMesh& enclosed) try {
  TriangleMesh hull = convex_hull(with_float32_coordinates(polytope, HullSide::Outer, NoRoom::Round).mesh);
  return hull.face_count() > 0 && encloses(hull, enclosed) ? std::optional(std::move(hull)) : std::nullopt;
} catch (const InputError&) {  // such numbers are too far apart for its size
  return std::nullopt;
}

/// The box around the polytope; nothing if it has too many vertices.
std::optional<TriangleMesh> float32_box(const TriangleMesh& polytope, std::size_t max_vertices) {
  TriangleMesh box = mesh_of(box_around(polytope), true);
  const bool fits = box.vertex_count() <= max_vertices && box.face_count() > 0 &&
                    std::ranges::all_of(box.positions, is_finite) && encloses(box, polytope);
  return fits ? std::optional(std::move(box)) : std::nullopt;
}

}  // namespace

TriangleMesh with_few_vertices(const TriangleMesh& polytope, std::size_t max_vertices, bool float32_coordinates) {
  assert(polytope.face_count() >= 4 && max_vertices >= 4);
  const bool is_stored =
      !float32_coordinates || std::ranges::all_of(polytope.positions, [](const Vec3& p) { return is_float32(p); });
  if (is_stored && polytope.vertex_count() <= max_vertices) return polytope;
  TriangleMesh result = Reduction(polytope, max_vertices, float32_coordinates).run();
  if (!float32_coordinates) return result;
  // The search may end far outside where the rounding is large against the thickness in some direction.
  const TriangleMesh few = with_few_vertices(polytope, max_vertices, false);
  for (const auto& other :
       {rounded_outwards(few, polytope), moved_to_float32(few, polytope), float32_box(polytope, max_vertices)})
    if (other && signed_volume(*other) < signed_volume(result)) result = *other;
  return result;
}

}  // namespace prohull::cover
