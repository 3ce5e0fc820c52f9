#include "construct/tight/tight_placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "construct/placement.h"
#include "geometry/float32.h"
#include "geometry/predicates.h"

namespace prohull {
namespace {

constexpr double kReach = 0.5;  ///< how far a vertex moves at once, along each axis, local

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(a, cross(b, c)); }

/// Of the tetrahedron (0, apex, a, b) that moving a vertex from 0 to `apex` removes: planes with unit normals, which
/// have it on their inner sides.
struct Removed {
  Removed(const Vec3& apex, const Vec3& a, const Vec3& b)
      : new_face(plane(apex, a, b, Vec3{})),
        others{plane(Vec3{}, a, b, apex), plane(Vec3{}, apex, a, b), plane(Vec3{}, apex, b, a)} {
    for (const Vec3& p : {Vec3{}, apex, a, b}) box.extend(p);
  }
  static HalfSpace plane(const Vec3& u, const Vec3& v, const Vec3& w, const Vec3& inside) {
    const Vec3 n = cross(v - u, w - u);
    const double length = norm(n);
    const Vec3 unit = length > 0 ? n / length : Vec3{};
    return dot(unit, inside - u) > 0 ? HalfSpace{unit, dot(unit, u)} : HalfSpace{-unit, -dot(unit, u)};
  }
  HalfSpace new_face;
  std::array<HalfSpace, 3> others;
  Box box;
};

double depth(const HalfSpace& plane, const Vec3& p) { return dot(plane.normal, p) - plane.offset; }

/// Of the points of a box.
double greatest_depth(const HalfSpace& plane, const Box& box) {
  double sum = -plane.offset;
  for (int axis = 0; axis < 3; ++axis)
    sum += std::max(plane.normal[axis] * box.min[axis], plane.normal[axis] * box.max[axis]);
  return sum;
}

bool is_beyond(const std::array<HalfSpace, 3>& planes, const Vec3& p, double least_depth) {
  return std::ranges::all_of(planes, [&](const HalfSpace& plane) { return depth(plane, p) > least_depth; });
}

/// Keeps what is deeper than that.
void clip(std::vector<Vec3>& polygon, const HalfSpace& plane, double least_depth, std::vector<Vec3>& result) {
  result.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const double dp = depth(plane, p) - least_depth, dq = depth(plane, q) - least_depth;
    if (dp >= 0) result.push_back(p);
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) result.push_back(p + (q - p) * (dp / (dp - dq)));
  }
  std::swap(polygon, result);
}

}  // namespace

TightPlacement::TightPlacement(const Original& original, bool float32_coordinates)
    : original_(original),
      float32_coordinates_(float32_coordinates),
      rounding_(storage_rounding(original.bounds(), float32_coordinates)) {}

Vec3 TightPlacement::as_stored(const Vec3& p) const { return float32_coordinates_ ? nearest_float32(p) : p; }

void TightPlacement::set(const Vec3& from, const HalfEdgeMesh& mesh, const std::vector<VertexId>& link) {
  from_ = from;
  link_.clear(), local_.clear();
  for (const VertexId v : link) link_.push_back(mesh.position(v));
  scale_ = 0;
  for (const Vec3& p : link_) scale_ = std::max(scale_, norm(p - from));
  for (const Vec3& p : link_) local_.push_back(to_local(p));
  objective_ = {};
  for (std::size_t i = 0; i < link_.size(); ++i) objective_ += cross(local_[i], local_[after(i)]);
}

/// Up to which depth a point of the original in a removed tetrahedron counts as outside of it; local.
double TightPlacement::allowed_depth() const {
  constexpr double kTouching = 1e-10;  // the exact test decides
  return original_.clearance() > 0 ? -original_.clearance() / scale_ : kTouching;
}

// Cutting planes: the linear program without the original, then again and again with the points of the original that
// its answer would leave outside.
std::optional<Vec3> TightPlacement::propose(double margin) {
  constexpr int kMaxPrograms = 16;
  constexpr double kLeastGain = 1e-4;  // of the objective
  if (!(norm(objective_) > 0)) return std::nullopt;
  constraints_.clear();
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      Vec3 normal;
      normal[axis] = sign;
      constraints_.push_back({normal, -kReach});
    }
  for (int i = 0; i < kMaxPrograms; ++i) {
    const auto best = optimum_or_nearest(objective_, constraints_);
    if (!best || dot(objective_, *best) > -kLeastGain * norm(objective_)) return std::nullopt;
    if (!add_cuts(*best, margin)) return best;
  }
  return std::nullopt;
}

// For each face of the star, the point of the original that would be farthest outside.
bool TightPlacement::add_cuts(const Vec3& apex, double margin) {
  bool added = false;
  for (std::size_t i = 0; i < local_.size(); ++i) {
    const Vec3 &a = local_[i], &b = local_[after(i)];
    if (determinant(a, b, apex) >= 0) continue;  // adds
    const auto cut = deepest_point(apex, a, b);
    if (!cut) continue;
    // The face (x, a, b) has q inside where dot(x - q, (a - q) cross (b - q)) is positive: linear in x.
    const Vec3 n = cross(a - *cut, b - *cut);
    const double length = norm(n);
    if (!(length > 0)) continue;
    constraints_.push_back({n / length, dot(n, *cut) / length + margin});
    added = true;
  }
  return added;
}

// Of the original, in the removed tetrahedron, the point farthest outside of the new face (apex, a, b): a corner, or
// where there is none a point of an edge or face.
std::optional<Vec3> TightPlacement::deepest_point(const Vec3& apex, const Vec3& a, const Vec3& b) {
  const Removed removed(apex, a, b);
  const double allowed = allowed_depth();
  const double padding = original_.padding() > 0 ? -allowed : 0;
  const Vec3 margin{padding, padding, padding};
  const Box near{removed.box.min - margin, removed.box.max + margin};
  double deepest = allowed;
  std::optional<Vec3> point;
  const auto take = [&](const Vec3& p) {
    if (const double d = depth(removed.new_face, p); d > deepest) deepest = d, point = p;
  };
  const auto bound = [&](const Box& box) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    const Box here{to_local(box.min), to_local(box.max)};
    if (!here.overlaps(near)) return kNone;
    for (const HalfSpace& plane : removed.others)
      if (greatest_depth(plane, here) <= allowed) return kNone;
    return -greatest_depth(removed.new_face, here);
  };
  const auto local = [&](std::uint32_t f) {
    const Triangle t = original_.mesh().triangle(FaceId{f});
    return Triangle{to_local(t.a), to_local(t.b), to_local(t.c)};
  };
  original_.tree().least(
      bound,
      [&](std::uint32_t f) {
        const Triangle t = local(f);
        for (const Vec3& p : {t.a, t.b, t.c})
          if (is_beyond(removed.others, p, allowed)) take(p);
        return -deepest;
      },
      -allowed);
  if (point) return point;
  original_.tree().least(
      bound,
      [&](std::uint32_t f) {
        const Triangle t = local(f);
        polygon_ = {t.a, t.b, t.c};
        clip(polygon_, removed.new_face, allowed, clipped_);
        for (const HalfSpace& plane : removed.others) clip(polygon_, plane, allowed, clipped_);
        if (polygon_.size() >= 3)
          for (const Vec3& p : polygon_) take(p);
        return -deepest;
      },
      -allowed);
  return point;
}

bool TightPlacement::keeps_enclosing(const Vec3& to) const {
  for (std::size_t i = 0; i < link_.size(); ++i) {
    const Vec3 &a = link_[i], &b = link_[after(i)];
    if (side(from_, a, b, to) != Side::Inside) continue;  // adds, or is flat
    if (!original_.lies_outside_of({from_, a, b, to})) return false;
  }
  for (std::size_t i = 0; i < link_.size(); ++i)
    if (!original_.keeps_padding({to, link_[i], link_[after(i)]})) return false;
  return true;
}

}  // namespace prohull
