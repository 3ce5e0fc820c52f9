#include "build/tightening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "build/placement.h"
#include "build/self_intersection_guard.h"
#include "build/shape_guards.h"
#include "geometry/compactness.h"
#include "geometry/float32.h"
#include "geometry/linear_program.h"
#include "geometry/predicates.h"

namespace prohull {
namespace {

constexpr double kReach = 0.5;  ///< how far a vertex moves at once, along each axis, local

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

constexpr double kTouching = 1e-10;  ///< local; the exact test decides

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

class Tightener {
 public:
  Tightener(HalfEdgeMesh& mesh, const Original& original, const HullOptions& options)
      : mesh_(mesh),
        original_(original),
        options_(options),
        rounding_(storage_rounding(original.bounds(), options.float32_coordinates)),
        guard_(mesh, faces_along_curve(mesh)) {}

  std::size_t run();

 private:
  bool improve(VertexId v);
  void gather(VertexId v);
  std::optional<Vec3> propose(double margin);
  bool add_cuts(const Vec3& apex, double margin);
  std::optional<Vec3> deepest_point(const Vec3& apex, const Vec3& a, const Vec3& b);
  bool has_good_shape(const Vec3& apex) const;
  bool keeps_enclosing(const Vec3& from, const Vec3& to) const;
  bool is_cancelled(std::size_t steps) const;
  /// Local: up to which a point of the original in a removed tetrahedron counts as outside of it.
  double allowed_depth() const { return original_.clearance() > 0 ? -original_.clearance() / scale_ : kTouching; }
  std::size_t after(std::size_t i) const { return i + 1 == link_.size() ? 0 : i + 1; }

  HalfEdgeMesh& mesh_;
  const Original& original_;
  const HullOptions& options_;
  const double rounding_;
  SelfIntersectionGuard guard_;

  // The vertex in hand, in a frame with the origin there and the farthest link vertex at distance 1.
  std::vector<VertexId> link_;
  std::vector<Vec3> local_;  ///< of link_
  double scale_ = 1;
  std::vector<Triangle> candidates_;  ///< original faces nearby, local
  Vec3 objective_;
  std::vector<HalfSpace> constraints_;
  std::vector<Triangle> near_;  ///< scratch, as the two below
  std::vector<Vec3> polygon_, clipped_;
};

std::size_t Tightener::run() {
  constexpr int kRounds = 12;
  std::size_t moves = 0, steps = 0;
  PerVertex<char> waiting(mesh_.positions().size(), 1);
  for (int round = 0; round < kRounds; ++round) {
    std::size_t moved = 0;
    for (const VertexId v : mesh_.positions().ids()) {
      if (!mesh_.has(v) || !waiting[v]) continue;
      if (is_cancelled(++steps)) return moves;
      waiting[v] = 0;
      if (!improve(v)) continue;
      ++moved;
      waiting[v] = 1;
      for (const VertexId u : link_) waiting[u] = 1;
    }
    moves += moved;
    if (moved == 0) break;
  }
  return moves;
}

bool Tightener::is_cancelled(std::size_t steps) const {
  constexpr std::size_t kInterval = 64;
  return options_.progress && steps % kInterval == 0 &&
         !options_.progress({mesh_.face_count(), mesh_.face_id_count(), options_.target_faces});
}

bool Tightener::improve(VertexId v) {
  gather(v);
  if (!(norm(objective_) > 0)) return false;
  const Vec3 from = mesh_.position(v);
  // The second margin is for what rounding and the tolerances of the proposal have got wrong.
  const double clearance = original_.clearance() / scale_;
  for (const double margin : {clearance + 1e-10 + 2 * rounding_ / scale_, clearance + 1e-7 + 8 * rounding_ / scale_}) {
    const auto apex = propose(margin);
    if (!apex) return false;
    for (const double step : {1.0, 0.5, 0.25}) {
      const Vec3 local = *apex * step;
      if (!has_good_shape(local)) continue;
      Vec3 to = from + local * scale_;
      if (options_.float32_coordinates) to = nearest_float32(to);
      if (!keeps_enclosing(from, to)) continue;
      if (guard_.would_add_intersections(mesh_, v, link_, to)) continue;
      mesh_.move(v, to);
      guard_.changed(mesh_, v);
      return true;
    }
  }
  return false;
}

void Tightener::gather(VertexId v) {
  const Vec3 origin = mesh_.position(v);
  link_.clear(), local_.clear(), candidates_.clear();
  HalfEdgeId h = mesh_.out(v);
  scale_ = 0;
  do {
    link_.push_back(mesh_.tip(h));
    local_.push_back(mesh_.position(mesh_.tip(h)) - origin);
    scale_ = std::max(scale_, norm(local_.back()));
    h = mesh_.rotated(h);
  } while (h != mesh_.out(v));
  for (Vec3& p : local_) p = p / scale_;

  objective_ = {};
  Box box{origin - Vec3{1, 1, 1} * (kReach * scale_), origin + Vec3{1, 1, 1} * (kReach * scale_)};
  for (std::size_t i = 0; i < link_.size(); ++i) {
    objective_ += cross(local_[i], local_[after(i)]);
    box.extend(mesh_.position(link_[i]));
  }
  original_.tree().visit(
      [&](const Box& b) { return b.overlaps(box); },
      [&](std::uint32_t f) {
        const Triangle t = original_.triangle(f);
        candidates_.push_back({(t.a - origin) / scale_, (t.b - origin) / scale_, (t.c - origin) / scale_});
      });
}

// Cutting planes: the linear program without the original, then again and again with the points of the original that
// its answer would leave outside.
std::optional<Vec3> Tightener::propose(double margin) {
  constexpr int kMaxPrograms = 16;
  constexpr double kLeastGain = 1e-4;  // of the objective
  constraints_.clear();
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      Vec3 normal;
      normal[axis] = sign;
      constraints_.push_back({normal, -kReach});
    }
  for (int i = 0; i < kMaxPrograms; ++i) {
    LinearProgramResult best = solve_linear_program(objective_, constraints_);
    if (best.status == LinearProgramStatus::Infeasible) return std::nullopt;
    if (best.status == LinearProgramStatus::Ambiguous) {
      const auto nearest = nearest_feasible_point({}, constraints_);
      if (!nearest) return std::nullopt;
      best.x = *nearest;
    }
    if (dot(objective_, best.x) > -kLeastGain * norm(objective_)) return std::nullopt;
    if (!add_cuts(best.x, margin)) return best.x;
  }
  return std::nullopt;
}

// For each face of the star, the point of the original that would be farthest outside.
bool Tightener::add_cuts(const Vec3& apex, double margin) {
  bool added = false;
  for (std::size_t i = 0; i < link_.size(); ++i) {
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
std::optional<Vec3> Tightener::deepest_point(const Vec3& apex, const Vec3& a, const Vec3& b) {
  const Removed removed(apex, a, b);
  const double allowed = allowed_depth();
  double deepest = allowed;
  std::optional<Vec3> point;
  near_.clear();
  for (const Triangle& t : candidates_) {
    bool is_near = false;
    for (const Vec3& p : {t.a, t.b, t.c}) {
      const double d = depth(removed.new_face, p);
      if (d <= allowed) continue;
      is_near = true;
      if (d > deepest && is_beyond(removed.others, p, allowed)) deepest = d, point = p;
    }
    if (is_near && !point && removed.box.overlaps(box_of(t))) near_.push_back(t);
  }
  if (point) return point;
  for (const Triangle& t : near_) {
    polygon_ = {t.a, t.b, t.c};
    clip(polygon_, removed.new_face, allowed, clipped_);
    for (const HalfSpace& plane : removed.others) clip(polygon_, plane, allowed, clipped_);
    for (const Vec3& p : polygon_)
      if (const double d = depth(removed.new_face, p); polygon_.size() >= 3 && d > deepest) deepest = d, point = p;
  }
  return point;
}

bool Tightener::has_good_shape(const Vec3& apex) const {
  const double least_cosine = std::cos(options_.max_normal_deviation);
  double least_before = 1, least_after = 1;
  for (std::size_t i = 0; i < link_.size(); ++i) {
    const Vec3 &a = local_[i], &b = local_[after(i)];
    const Vec3 n = cross(a, b), m = cross(a - apex, b - apex);
    if (dot(n, m) < least_cosine * norm(n) * norm(m)) return false;
    const double ab = squared_norm(b - a);
    least_before = std::min(least_before, compactness(norm(n), squared_norm(a) + squared_norm(b) + ab));
    least_after = std::min(least_after, compactness(norm(m), squared_norm(a - apex) + squared_norm(b - apex) + ab));
  }
  return least_after > std::min(options_.min_compactness_ratio * least_before, options_.sufficient_compactness);
}

bool Tightener::keeps_enclosing(const Vec3& from, const Vec3& to) const {
  for (std::size_t i = 0; i < link_.size(); ++i) {
    const Vec3 a = mesh_.position(link_[i]), b = mesh_.position(link_[after(i)]);
    if (side(from, a, b, to) != Side::Inside) continue;  // adds, or is flat
    if (!original_.lies_outside_of({from, a, b, to})) return false;
  }
  return true;
}

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
    : mesh_(std::move(mesh)),
      tree_(tree_of(mesh_)),
      bounds_(bounding_box(mesh_)),
      clearance_(clearance) {}

Original Original::closed(TriangleMesh mesh, HullSide side) {
  Original original(std::move(mesh), 0);
  original.winding_.emplace(triangles_of(original.mesh_));
  original.least_covered_ = side == HullSide::Outer ? 1 : 0;
  return original;
}

Original Original::triangles(TriangleMesh mesh, double clearance) { return {std::move(mesh), clearance}; }

bool Original::lies_outside_of(const Tetrahedron& removed) const {
  Box box;
  for (const Vec3& p : {removed.a, removed.b, removed.c, removed.d}) box.extend(p);
  bool met = false;
  tree_.visit([&](const Box& other) { return !met && other.overlaps(box); },
              [&](std::uint32_t f) {
                met = met || (winding_ ? meets_interior(triangle(f), removed) : may_touch(triangle(f), removed));
              });
  if (met || !winding_) return !met;
  const auto inside = point_inside(removed);
  return inside && winding_->at(*inside).value_or(least_covered_) < least_covered_;
}

std::size_t tighten(HalfEdgeMesh& hull, const Original& original, const HullOptions& options) {
  return Tightener(hull, original, options).run();
}

}  // namespace prohull
