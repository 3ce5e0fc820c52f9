#include "construct/tight/original.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/predicates.h"
#include "geometry/triangle_distance.h"

namespace prohull {
namespace {

std::vector<Triangle> triangles_of(const TriangleMesh& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.face_count());
  for (const FaceId f : mesh.triangles.ids()) triangles.push_back(mesh.triangle(f));
  return triangles;
}

Bvh tree_of(const TriangleMesh& mesh) {
  std::vector<Box> boxes;
  boxes.reserve(mesh.face_count());
  for (const FaceId f : mesh.triangles.ids()) boxes.push_back(box_of(mesh.triangle(f)));
  return Bvh(boxes);
}

/// Finds boxes that lie beside a tetrahedron, most of them, also where its box overlaps them.
class Beside {
 public:
  explicit Beside(const Tetrahedron& t) {
    const std::array corners{t.a, t.b, t.c, t.d};
    for (const Vec3& p : corners) {
      box_.extend(p);
      largest_ = std::max({largest_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 &p = corners[i], &q = corners[(i + 1) % 4], &r = corners[(i + 2) % 4], &inside = corners[(i + 3) % 4];
      const Vec3 n = cross(q - p, r - p);
      planes_[i] = dot(n, inside - p) > 0 ? -n : n;
      offsets_[i] = dot(planes_[i], p);
    }
  }

  bool operator()(const Box& other) const {
    if (!other.overlaps(box_)) return true;
    constexpr double kRounding = 1e-13;  // far more than what the sums below are wrong by
    const Vec3 &a = other.min, &b = other.max;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& n = planes_[i];
      double least = -offsets_[i], size = 0;
      for (int axis = 0; axis < 3; ++axis) {
        least += std::min(n[axis] * a[axis], n[axis] * b[axis]);
        size += std::abs(n[axis]) * std::max({largest_, std::abs(a[axis]), std::abs(b[axis])});
      }
      if (least > kRounding * size && is_certain(n)) return true;
    }
    return false;
  }

 private:
  /// The normal of a needle may be rounded away.
  bool is_certain(const Vec3& n) const {
    const double diagonal = box_.diagonal();
    return norm(n) > 1e-6 * diagonal * diagonal && diagonal > 1e-6 * largest_;
  }

  Box box_;
  double largest_ = 0;
  std::array<Vec3, 4> planes_;  ///< normals outwards
  std::array<double, 4> offsets_{};
};

/// How far a box is from a triangle, at least, but for rounding.
class Beyond {
 public:
  explicit Beyond(const Triangle& t) : corner_(t.a), box_(box_of(t)) {
    const Vec3 n = cross(t.b - t.a, t.c - t.a);
    const double length = norm(n);
    if (length > 0) normal_ = n / length;
  }

  double operator()(const Box& box) const {
    const Vec3 a = box.min - corner_, b = box.max - corner_;
    double squared = 0, least = 0, most = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double gap = std::max({0.0, box.min[axis] - box_.max[axis], box_.min[axis] - box.max[axis]});
      squared += gap * gap;
      least += std::min(normal_[axis] * a[axis], normal_[axis] * b[axis]);
      most += std::max(normal_[axis] * a[axis], normal_[axis] * b[axis]);
    }
    return std::max({std::sqrt(squared), least, -most});
  }

  /// Whether a triangle is so far away; false for some that are.
  bool is_certain(const Triangle& t, double distance) const {
    constexpr double kLittleMore = 1 + 1e-9;
    const double a = dot(normal_, t.a - corner_), b = dot(normal_, t.b - corner_), c = dot(normal_, t.c - corner_);
    return std::max(std::min({a, b, c}), -std::max({a, b, c})) >= kLittleMore * distance;
  }

 private:
  Vec3 corner_, normal_;
  Box box_;
};

/// A point in the inside of the tetrahedron, if rounding leaves one there.
std::optional<Vec3> point_inside(const Tetrahedron& t) {
  const Vec3 center = t.a * 0.25 + t.b * 0.25 + t.c * 0.25 + t.d * 0.25;
  const bool is_inside = side(t.a, t.b, t.c, center) == Side::Inside && side(t.d, t.c, t.b, center) == Side::Inside &&
                         side(t.a, t.d, t.b, center) == Side::Inside && side(t.a, t.c, t.d, center) == Side::Inside;
  if (!is_inside) return std::nullopt;
  return center;
}

}  // namespace

Original::Original(TriangleMesh mesh, double clearance)
    : mesh_(std::move(mesh)), tree_(tree_of(mesh_)), bounds_(bounding_box(mesh_)), clearance_(clearance) {}

Original Original::closed(TriangleMesh mesh, HullSide side) {
  Original original(std::move(mesh), 0);
  original.winding_.emplace(triangles_of(original.mesh_));
  original.least_covered_ = side == HullSide::Outer ? 1 : 0;
  return original;
}

Original Original::triangles(TriangleMesh mesh, double clearance) { return {std::move(mesh), clearance}; }

Original Original::padded_triangles(TriangleMesh mesh, double padding) {
  constexpr double kLittleMore = 1 + 1e-9;  // for what proposals have rounded
  Original original(std::move(mesh), kLittleMore * padding);
  original.padding_ = padding;
  return original;
}

bool Original::keeps_padding(const Triangle& face) const {
  if (padding_ == 0) return true;
  bool keeps = true;
  const Beyond beyond(face);
  tree_.visit([&](const Box& box) { return keeps && beyond(box) < padding_; },
              [&](std::uint32_t f) {
                const Triangle t = mesh_.triangle(FaceId{f});
                keeps = keeps && (beyond.is_certain(t, padding_) || triangle_distance(face, t).lower >= padding_);
              });
  return keeps;
}

bool Original::lies_outside_of(const Tetrahedron& removed) const {
  const Beside is_beside(removed);
  bool met = false;
  tree_.visit([&](const Box& box) { return !met && !is_beside(box); },
              [&](std::uint32_t f) {
                met = met || (winding_ ? meets_interior(mesh_.triangle(FaceId{f}), removed)
                                       : may_touch(mesh_.triangle(FaceId{f}), removed));
              });
  if (met || !winding_) return !met;
  const auto inside = point_inside(removed);
  return inside && winding_->at(*inside).value_or(least_covered_) < least_covered_;
}

}  // namespace prohull
