#include "prohull/collide.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "collide/collision_mesh.h"
#include "collide/tree_pair.h"
#include "geometry/bvh.h"
#include "geometry/largest_coordinate.h"
#include "geometry/triangle_distance.h"
#include "geometry/triangle_intersection.h"
#include "parallel/arena.h"
#include "prohull/detail/collision_levels.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/error.h"

namespace prohull {
namespace {

/// A lower bound of the distance between two triangles: that of the boxes around them, less what it was rounded up.
double box_distance(const Triangle& s, const Triangle& t) {
  const Box a = box_of(s), b = box_of(t);
  Vec3 gap;
  for (int k = 0; k < 3; ++k) gap[k] = std::max({0.0, a.min[k] - b.max[k], b.min[k] - a.max[k]});
  return norm(gap) * (1 - 0x1p-48) - 0x1p-500;
}

/// A lower bound of the distance between two triangles: how far apart they are along a vector. The products have errors
/// of 12 eps of the product of the largest entries, as in geometry/triangle_intersection.cpp, with eps = 2^-53.
double distance_along(const Vec3& way, const Triangle& s, const Triangle& t) {
  const std::array from{dot(way, s.b - s.a), dot(way, s.c - s.a)};
  const std::array to{dot(way, t.a - s.a), dot(way, t.b - s.a), dot(way, t.c - s.a)};
  const double length = norm(way);
  const double gap = std::min({to[0], to[1], to[2]}) - std::max({0.0, from[0], from[1]});
  const double largest =
      std::max({norm(s.b - s.a), norm(s.c - s.a), norm(t.a - s.a), norm(t.b - s.a), norm(t.c - s.a)});
  return length > 0x1p-400 ? gap / length - 0x1p-47 * largest : 0;
}

/// Two meshes in their poses.
class Scene {
 public:
  /// With a margin, meshes are apart if they are farther from each other.
  Scene(const CollisionMesh& a, const Pose& pose_a, const CollisionMesh& b, const Pose& pose_b, double margin = 0)
      : a_(a),
        b_(b),
        pose_a_(pose_a),
        pose_b_(pose_b),
        margin_(margin),
        boxes_(a.tree, pose_a, b.tree, pose_b, margin) {
    require_sharpness();
  }

  bool collides() const { return !boxes_.are_far_apart() && (surfaces_meet() || one_is_inside()); }

  std::vector<FacePair> intersecting_faces() const {
    std::vector<FacePair> pairs;
    if (boxes_.are_far_apart()) return pairs;
    visit_meeting_leaves(a_.tree, b_.tree, boxes_, [&](const ObbNode& in_a, const ObbNode& in_b) {
      visit_touching(in_a, in_b, [&](std::size_t i, std::size_t j) {
        pairs.push_back({a_.face(i), b_.face(j)});
        return false;
      });
      return false;
    });
    std::ranges::sort(pairs, {}, [](const FacePair& pair) { return std::pair(pair.a, pair.b); });
    return pairs;
  }

  /// Faces that have no point in common tell that the surfaces do not meet; only otherwise is that decided first.
  Separation separation(double limit) const {
    if (const auto apart = separation_of_surfaces(limit, true))
      return !boxes_.are_far_apart() && one_is_inside() ? Separation{} : *apart;
    return collides() ? Separation{} : *separation_of_surfaces(limit, false);
  }

 private:
  /// Where rounding moves vertices as far as the meshes are large, every face may meet every other one.
  void require_sharpness() const {
    constexpr double kManyPairs = 1e8;
    const double rounding = rounding_bound(pose_a_, a_.tree.reach()) + rounding_bound(pose_b_, b_.tree.reach());
    const double pairs = static_cast<double>(a_.mesh.face_count()) * static_cast<double>(b_.mesh.face_count());
    if (8 * rounding > std::max(a_.tree.radius(), b_.tree.radius()) && pairs > kManyPairs)
      throw InputError(Defect::NonFiniteCoordinate,
                       "the meshes are so far from the origin that rounding leaves little of their shape; move both");
  }

  /// Nothing if two faces may touch and that is to end it.
  std::optional<Separation> separation_of_surfaces(double limit, bool ends_at_touch) const {
    Separation result;
    result.lower = result.upper = limit;
    double nearest = std::numeric_limits<double>::infinity();
    Vec3 way;  // between the nearest faces so far, within the limit or not
    Float4 direction{};
    const auto measure = [&](std::size_t i, const Triangle& s, std::size_t j, const Triangle& t) {
      if (distance_along(way, s, t) >= result.upper) return false;
      const TriangleDistance distance = triangle_distance(s, t);
      if (ends_at_touch && !(distance.lower > 0)) return true;
      result.lower = std::min(result.lower, distance.lower);
      if (distance.upper >= nearest) return false;
      nearest = distance.upper;
      way = distance.t - distance.s, direction = boxes_.direction(pose_a_, way);
      if (distance.upper < result.upper)
        result = {result.lower, distance.upper, distance.s, distance.t, a_.face(i), b_.face(j)};
      return false;
    };
    if (visit_near_leaves(a_.tree, b_.tree, boxes_, result.upper, direction,
                          [&](const ObbNode& in_a, const ObbNode& in_b) {
                            return visit_pairs(a_, pose_a_, in_a, b_, pose_b_, in_b, measure);
                          }))
      return std::nullopt;
    if (result.upper == limit) result.upper = std::numeric_limits<double>::infinity();
    return result;
  }

  bool surfaces_meet() const {
    return visit_meeting_leaves(a_.tree, b_.tree, boxes_, [&](const ObbNode& in_a, const ObbNode& in_b) {
      return visit_touching(in_a, in_b, [](std::size_t, std::size_t) { return true; });
    });
  }

  /// visit(i, j) for the triangles of two leaves that have a point in common, until it returns true.
  template <class Visit>
  bool visit_touching(const ObbNode& in_a, const ObbNode& in_b, Visit visit) const {
    return visit_pairs(a_, pose_a_, in_a, b_, pose_b_, in_b,
                       [&](std::size_t i, const Triangle& s, std::size_t j, const Triangle& t) {
                         return are_near(s, t) && visit(i, j);
                       });
  }

  /// Whether they have a point in common, or may be within the margin.
  bool are_near(const Triangle& s, const Triangle& t) const {
    if (margin_ == 0) return triangles_touch(s, t);
    return box_distance(s, t) <= margin_ && triangle_distance(s, t).lower <= margin_;
  }

  /// For surfaces that do not meet.
  bool one_is_inside() const { return prohull::one_is_inside(a_, pose_a_, b_, pose_b_); }

  const CollisionMesh &a_, &b_;
  const Pose &pose_a_, &pose_b_;
  const double margin_;
  BoxPair boxes_;
};

/// Rounding moves each point of a placed mesh by at most r = rounding_bound, and so does it with the hull around it. So
/// what a hull encloses reaches at most 2 r beyond the hull: a point farther from both surfaces than they are moved is
/// not passed by them, and keeps its winding numbers.
bool may_collide(const CollisionMesh& a, const PosePair& at, const CollisionMesh& b) {
  const double margin = 2 * (rounding_bound(at.a, a.tree.reach()) + rounding_bound(at.b, b.tree.reach()));
  return Scene(a, at.a, b, at.b, margin * (1 + 0x1p-40)).collides();
}

void require_closed(const CollisionIndex& a, const CollisionIndex& b) {
  if (!a.is_solid() || !b.is_solid())
    throw InputError(
        Defect::OpenEdge,
        "a mesh is not closed, or is inside out, so that it encloses nothing: ask for the exact answer, or mend it "
        "(`prohull repair`)");
}

/// answer(pose) for each of them.
template <class T, class Answer>
std::vector<T> answers(std::span<const PosePair> poses, const CollisionOptions& options, Answer answer) {
  for (std::size_t i = 0; i < poses.size(); ++i) try {
      require_rigid(poses[i].a), require_rigid(poses[i].b);
    } catch (const InputError& error) {
      throw InputError(error.defect(), fmt::format("pose {}: {}", i, error.what()));
    }
  std::vector<T> result(poses.size());
  ProgressMeter meter(options.progress, "collide");
  std::atomic<std::size_t> done = 0;
  arena_of(options.threads).execute([&] {
    oneapi::tbb::parallel_for(std::size_t{0}, poses.size(), [&](std::size_t i) {
      result[i] = answer(poses[i]);
      meter.at(++done, poses.size());
    });
  });
  return result;
}

std::vector<bool> truths(const std::vector<char>& answers) { return {answers.begin(), answers.end()}; }

}  // namespace

void require_rigid(const Pose& pose) {
  const auto& [x, y, z] = pose.rotation;
  // Three times the tolerance, as rotation_defect has it.
  if (!(rotation_defect(pose) <= 3 * kRotationTolerance) || !(dot(cross(x, y), z) > 0))
    throw InputError(
        Defect::InvalidOption,
        fmt::format("a pose is not rigid: the matrix times its transpose must be the identity within {:g}, "
                    "without mirroring",
                    kRotationTolerance));
  const Vec3& t = pose.translation;
  if (!(std::max({std::abs(t.x), std::abs(t.y), std::abs(t.z)}) <= kLargestCoordinate) || !is_finite(t))
    throw InputError(Defect::NonFiniteCoordinate, "a pose has a translation that is not finite, or beyond 1e100");
}

Pose pose_of_quaternion(double w, double x, double y, double z, const Vec3& translation) {
  const double largest = std::max({std::abs(w), std::abs(x), std::abs(y), std::abs(z)});
  if (!is_finite(Vec3{w, x, y}) || !std::isfinite(z) || largest == 0)
    throw InputError(Defect::InvalidOption, "a quaternion of a pose must be finite, and not 0");
  const double unit = std::ldexp(1, -std::max(std::ilogb(largest), -1000));  // squares neither overflow nor underflow
  w *= unit, x *= unit, y *= unit, z *= unit;
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  w /= length, x /= length, y /= length, z /= length;
  return {{Vec3{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
           {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
           {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}},
          translation};
}

Vec3 placed(const Pose& pose, const Vec3& point) { return at_pose(pose, point); }

TriangleMesh placed(const Pose& pose, TriangleMesh mesh) {
  for (Vec3& p : mesh.positions) p = at_pose(pose, p);
  return mesh;
}

CollisionIndex::CollisionIndex(const TriangleMesh& mesh, StandsFor what)
    : mesh_(std::make_shared<const CollisionMesh>(mesh, what)) {}

CollisionIndex collision_index(const ProgressiveHull& levels, bool conservative) {
  if (conservative && levels.side() == HullSide::Inner)
    throw InputError(Defect::InvalidOption, "it holds inner hulls; conservative answers need outer ones");
  return CollisionIndex(conservative ? levels.base() : levels.original());
}

bool CollisionIndex::is_solid() const { return mesh_->is_solid; }
std::size_t CollisionIndex::face_count() const { return mesh_->mesh.face_count(); }
std::size_t CollisionIndex::memory_bytes() const {
  return sizeof(CollisionMesh) + mesh_->tree.memory_bytes() + mesh_->mesh.vertex_count() * sizeof(Vec3) +
         mesh_->mesh.face_count() * sizeof(mesh_->mesh.triangles[FaceId{}]) +
         mesh_->component_ends.size() * sizeof(Segment);
}

bool collide(const CollisionIndex& a, const Pose& pose_a, const CollisionIndex& b, const Pose& pose_b) {
  require_rigid(pose_a), require_rigid(pose_b);
  return Scene(CollisionAccess::of(a), pose_a, CollisionAccess::of(b), pose_b).collides();
}

bool may_collide(const CollisionIndex& a, const Pose& pose_a, const CollisionIndex& b, const Pose& pose_b) {
  require_rigid(pose_a), require_rigid(pose_b);
  require_closed(a, b);
  return may_collide(CollisionAccess::of(a), {pose_a, pose_b}, CollisionAccess::of(b));
}

std::vector<FacePair> intersecting_faces(const CollisionIndex& a, const Pose& pose_a, const CollisionIndex& b,
                                         const Pose& pose_b) {
  require_rigid(pose_a), require_rigid(pose_b);
  return Scene(CollisionAccess::of(a), pose_a, CollisionAccess::of(b), pose_b).intersecting_faces();
}

Separation separation(const CollisionIndex& a, const Pose& pose_a, const CollisionIndex& b, const Pose& pose_b,
                      double limit) {
  require_rigid(pose_a), require_rigid(pose_b);
  return Scene(CollisionAccess::of(a), pose_a, CollisionAccess::of(b), pose_b).separation(limit);
}

std::vector<bool> collide(const CollisionIndex& a, const CollisionIndex& b, std::span<const PosePair> poses,
                          const CollisionOptions& options) {
  return truths(answers<char>(poses, options, [&](const PosePair& at) { return collide(a, at.a, b, at.b); }));
}

std::vector<bool> may_collide(const CollisionIndex& a, const CollisionIndex& b, std::span<const PosePair> poses,
                              const CollisionOptions& options) {
  require_closed(a, b);
  return truths(answers<char>(poses, options, [&](const PosePair& at) {
    return may_collide(CollisionAccess::of(a), at, CollisionAccess::of(b));
  }));
}

std::vector<Separation> separation(const CollisionIndex& a, const CollisionIndex& b, std::span<const PosePair> poses,
                                   const CollisionOptions& options) {
  return answers<Separation>(poses, options, [&](const PosePair& at) { return separation(a, at.a, b, at.b); });
}

FacePairBatch intersecting_faces(const CollisionIndex& a, const CollisionIndex& b, std::span<const PosePair> poses,
                                 const CollisionOptions& options) {
  const auto all = answers<std::vector<FacePair>>(
      poses, options, [&](const PosePair& at) { return intersecting_faces(a, at.a, b, at.b); });
  FacePairBatch batch{{0}, {}};
  for (const std::vector<FacePair>& pairs : all) {
    batch.pairs.insert(batch.pairs.end(), pairs.begin(), pairs.end());
    batch.offsets.push_back(batch.pairs.size());
  }
  return batch;
}

}  // namespace prohull
