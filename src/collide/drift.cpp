#include "prohull/detail/drift.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collide/collision_mesh.h"
#include "collide/drift_bound.h"
#include "collide/tree_pair.h"
#include "geometry/triangle_distance.h"

namespace prohull {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One of two meshes that drift.
class DriftingMesh {
 public:
  DriftingMesh(const CollisionMesh& mesh, const Drift& drift) : mesh_(mesh), bound_(drift) {}

  /// In the frame of the mesh, about of length 1.
  void set_direction(const Vec3& direction) {
    direction_ = direction;
    last_ = nullptr;
  }

  struct OfBox {
    double any_way = 0, bend = 0;
    double along = 0;  ///< the direction
  };
  /// Of two pairs of boxes that are bounded one after the other, mostly one box is the same.
  const OfBox& of_box(const ObbNode& box) {
    if (last_ == &box) return of_last_;
    const auto [any_way, bend] = bound_.of_box(mesh_.tree, box);
    of_last_ = {any_way, bend, bend + bound_.straight(mesh_.tree, box, direction_)};
    last_ = &box;
    return of_last_;
  }

  /// Along another direction.
  double along(const ObbNode& box, const Vec3& direction) {
    return of_box(box).bend + bound_.straight(mesh_.tree, box, direction);
  }

  double any_way(std::size_t i) const {
    const Triangle t = mesh_.triangle(i);
    return std::max({bound_.of_ball(t.a, 0).any_way, bound_.of_ball(t.b, 0).any_way, bound_.of_ball(t.c, 0).any_way});
  }

  /// How far each corner goes along the direction, but for what bends.
  Vec3 straight(std::size_t i) const {
    const Triangle t = mesh_.triangle(i);
    return {bound_.straight(t.a, direction_), bound_.straight(t.b, direction_), bound_.straight(t.c, direction_)};
  }

 private:
  const CollisionMesh& mesh_;
  const DriftBound bound_;
  Vec3 direction_;
  const ObbNode* last_ = nullptr;
  OfBox of_last_;
};

class NearSearch {
 public:
  NearSearch(const CollisionMesh& a, const Pose& pose_a, const Drift& drift_a, const CollisionMesh& b,
             const Pose& pose_b, const Drift& drift_b, double gap)
      : a_(a),
        b_(b),
        pose_a_(pose_a),
        pose_b_(pose_b),
        drift_a_(a, drift_a),
        drift_b_(b, drift_b),
        boxes_(a.tree, pose_a, b.tree, pose_b),
        gap_(gap) {}

  std::size_t leaf_pairs() const { return leaf_pairs_; }

  std::optional<NearFaces> run(const NearFaces* first) {
    const auto measure = [this](const ObbNode& in_a, const ObbNode& in_b) { return are_near(in_a, in_b); };
    if (first) {
      set_direction(rotated(pose_a_, first->way));
      if (measure(a_.tree.boxes()[first->leaf_a], b_.tree.boxes()[first->leaf_b])) return found_;
    }
    struct Bounded {
      NodePair nodes;
      double bound;
    };
    const auto bounded = [this](NodePair nodes) {
      return Bounded{nodes, bound_of(a_.tree.boxes()[nodes.a], b_.tree.boxes()[nodes.b])};
    };
    const auto is_nearer = [](const Bounded& one, const Bounded& other) { return one.bound <= other.bound; };
    const auto may_be_near = [this](const Bounded& at) { return at.bound <= gap_; };
    const bool is_near = visit_open_leaves(a_.tree, b_.tree, boxes_, bounded, is_nearer, may_be_near, measure);
    if (!is_near && one_is_inside(a_, pose_a_, b_, pose_b_))
      found_ = {last_leaf(a_.tree), last_leaf(b_.tree), {}, {}, {}};
    return found_;
  }

 private:
  void set_direction(const Vec3& way) {
    if (!(norm(way) > 0)) return;
    direction_ = boxes_.direction(pose_a_, way), has_direction_ = true;
    const Vec3 own{direction_[0], direction_[1], direction_[2]};
    along_ = rotated(pose_a_, own);
    drift_a_.set_direction(own), drift_b_.set_direction(transposed_rotated(pose_b_, along_));
  }

  /// Of the distance of what is in the boxes, after all drifted.
  double bound_of(const ObbNode& in_a, const ObbNode& in_b) {
    const DriftingMesh::OfBox &a = drift_a_.of_box(in_a), &b = drift_b_.of_box(in_b);
    const double along = has_direction_ ? boxes_.gap_along(in_a, in_b, direction_) - (a.along + b.along) : -kInfinity;
    if (along > gap_) return along;
    const double bound = std::max(along, boxes_.distance_bound(in_a, in_b, direction_) - (a.any_way + b.any_way));
    if (bound > gap_) return bound;
    const Float4 between = boxes_.direction_between(in_a, in_b);
    const double apart = boxes_.gap_along(in_a, in_b, between);
    if (apart <= gap_) return bound;
    const Vec3 own{between[0], between[1], between[2]};
    const Vec3 of_b = transposed_rotated(pose_b_, rotated(pose_a_, own));
    return std::max(bound, apart - (drift_a_.along(in_a, own) + drift_b_.along(in_b, of_b)));
  }

  bool are_near(const ObbNode& in_a, const ObbNode& in_b) {
    ++leaf_pairs_;
    bend_ = drift_a_.of_box(in_a).bend + drift_b_.of_box(in_b).bend;
    const auto are_near = [&](std::size_t i, const Triangle& s, std::size_t j, const Triangle& t) {
      if (has_direction_ && are_apart_along(i, s, j, t)) return false;
      const TriangleDistance distance = triangle_distance(s, t);
      if (distance.lower - drift_a_.any_way(i) - drift_b_.any_way(j) > gap_) return false;
      const Vec3 way = distance.t - distance.s;
      if (distance.lower > 0) set_direction(way);
      if (distance.lower > 0 && are_apart_along(i, s, j, t)) return false;
      found_ = {leaf_number(a_.tree, in_a), leaf_number(b_.tree, in_b),
                transposed_rotated(pose_a_, distance.s - pose_a_.translation),
                transposed_rotated(pose_b_, distance.t - pose_b_.translation), transposed_rotated(pose_a_, way)};
      return true;
    };
    return visit_pairs(a_, pose_a_, in_a, b_, pose_b_, in_b, are_near);
  }

  static std::uint32_t last_leaf(const ObbTree& tree) { return static_cast<std::uint32_t>(tree.boxes().size() - 1); }
  static std::uint32_t leaf_number(const ObbTree& tree, const ObbNode& leaf) {
    return static_cast<std::uint32_t>(&leaf - tree.boxes().data());
  }

  /// Whether triangle i of a, which is placed as s, and triangle j of b stay apart along the direction.
  bool are_apart_along(std::size_t i, const Triangle& s, std::size_t j, const Triangle& t) const {
    constexpr double kRelative = 0x1p-44, kLength = 1 + 0x1p-20;  // the direction is no longer
    const Vec3 drift_s = drift_a_.straight(i), drift_t = drift_b_.straight(j);
    const double end = std::max({drift_s.x, dot(along_, s.b - s.a) + drift_s.y, dot(along_, s.c - s.a) + drift_s.z});
    const double begin = std::min(
        {dot(along_, t.a - s.a) - drift_t.x, dot(along_, t.b - s.a) - drift_t.y, dot(along_, t.c - s.a) - drift_t.z});
    const double size = std::max({norm(s.b - s.a), norm(s.c - s.a), norm(t.a - s.a), norm(t.b - s.a), norm(t.c - s.a)});
    return begin - end - kRelative * size > (gap_ + bend_) * kLength;
  }

  const CollisionMesh &a_, &b_;
  const Pose &pose_a_, &pose_b_;
  DriftingMesh drift_a_, drift_b_;
  const BoxPair boxes_;
  const double gap_;
  Float4 direction_{};  // between faces that were measured, in the frame of a
  Vec3 along_;          // the same in the frame of both
  bool has_direction_ = false;
  double bend_ = 0;  // of what lies in the leaves that are measured
  std::optional<NearFaces> found_;
  std::size_t leaf_pairs_ = 0;
};

double largest_norm(std::span<const Vec3> points) {
  double largest = 0;
  for (const Vec3& p : points) largest = std::max(largest, dot(p, p));
  return std::sqrt(largest);
}

}  // namespace

bool stay_apart_along(const Vec3& direction, std::span<const Vec3> a, const Drift& drift_a, std::span<const Vec3> b,
                      const Pose& pose_b, const Drift& drift_b, double gap) {
  const double length = norm(direction);
  if (!(length > 0x1p-400)) return false;
  const Vec3 along_a = direction * (1 / length), along_b = transposed_rotated(pose_b, along_a);
  const DriftBound of_a(drift_a), of_b(drift_b);
  double end = -kInfinity, begin = kInfinity;
  for (const Vec3& p : a) end = std::max(end, dot(along_a, p) + of_a.straight(p, along_a) + of_a.of_ball(p, 0).bend);
  for (const Vec3& p : b)
    begin = std::min(begin, dot(along_b, p) - of_b.straight(p, along_b) - of_b.of_ball(p, 0).bend);
  const double size = largest_norm(a) + largest_norm(b) + norm(pose_b.translation);
  const double rounding = (0x1p-40 + 4 * rotation_defect(pose_b)) * size;
  return begin + dot(along_a, pose_b.translation) - end - rounding > gap;
}

std::optional<NearFaces> may_come_near(const CollisionIndex& a, const Pose& pose_a, const Drift& drift_a,
                                       const CollisionIndex& b, const Pose& pose_b, const Drift& drift_b, double gap,
                                       const NearFaces* first, std::size_t& leaf_pairs) {
  require_rigid(pose_a), require_rigid(pose_b);
  NearSearch search(CollisionAccess::of(a), pose_a, drift_a, CollisionAccess::of(b), pose_b, drift_b, gap);
  auto found = search.run(first);
  leaf_pairs += search.leaf_pairs();
  return found;
}

}  // namespace prohull
