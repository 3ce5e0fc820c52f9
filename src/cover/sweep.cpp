#include "prohull/sweep.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <utility>

#include "cover/farthest.h"
#include "cover/polytope.h"
#include "cover/volume_estimate.h"
#include "geometry/float32.h"
#include "geometry/largest_coordinate.h"
#include "geometry/predicates.h"
#include "parallel/arena.h"
#include "prohull/convex_hull.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/detail/refuse.h"
#include "prohull/detail/stopwatch.h"
#include "prohull/detail/verdict_parts.h"
#include "prohull/error.h"

namespace prohull {
namespace {

constexpr double kFarthest = 1e100;
constexpr double kWidestHalfAngle = std::numbers::pi / 8;  // of a slice
constexpr double kUsualDistance = 0.02;                    // of the diagonal

// Polytopes that enclose in spite of rounding

/// A radius of which the ball around `center` is inside, decided exactly: six points are, and so is their octahedron.
double proven_depth(const Vec3& center, const TriangleMesh& polytope) {
  const double most = cover::depth(center, polytope) * 0.99;  // the octahedron of these corners is in the ball
  if (!(most > 0)) return 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double offset : {-most, most}) {
      Vec3 corner = center;
      corner[axis] += offset;
      for (const FaceId f : polytope.triangles.ids()) {
        const auto [a, b, c] = polytope.triangle(f);
        if (side(a, b, c, corner) == Side::Outside) return 0;
      }
    }
  return most * 0.57;  // less than 1 / sqrt(3), by more than the corners are rounded
}

/// What may happen to a point that is computed by a few sums and products, and stored.
double rounding_of(double largest, bool float32_coordinates) {
  return float32_coordinates ? 0x1p-23 * largest + 0x1p-147 : 0x1p-48 * largest + 0x1p-1000;
}

std::span<const Vec3> vertices_of(const TriangleMesh& mesh) { return {mesh.positions.data(), mesh.positions.size()}; }

// Motion

bool is_bounded(const Vec3& v) { return is_finite(v) && norm(v) <= kFarthest; }

void require_motion(const RigidMotion& motion) {
  require_rigid(motion.start);
  if (!is_bounded(motion.start.translation) || !is_bounded(motion.through) || !is_bounded(motion.axis) ||
      !is_bounded(motion.shift) || !(std::abs(motion.angle) <= 1e6))
    throw InputError(Defect::NonFiniteCoordinate,
                     "the motion has a number that is not finite or too large: lengths are at most 1e100, and angles "
                     "at most 1e6 radians");
  if (motion.angle != 0 && !(norm(motion.axis) >= 1 / kFarthest))
    refuse("the axis has no length: name a direction other than 0,0,0");
}

/// A piece of the mesh in the pose in which a motion starts, and how the motion moves it.
class MovedPiece {
 public:
  MovedPiece(const RigidMotion& motion, const TriangleMesh& piece) : shift_(motion.shift), through_(motion.through) {
    if (motion.angle != 0) axis_ = motion.axis / norm(motion.axis);
    const bool is_closed = shift_ == Vec3{};  // then what follows the first turn is the same again
    constexpr double kTurn = 2 * std::numbers::pi;
    angle_ = is_closed ? std::clamp(motion.angle, -kTurn, kTurn) : motion.angle;
    for (const Vec3& p : piece.positions) {
      corners_.push_back(placed(motion.start, p) - through_);
      extent_ = std::max(extent_, norm(p));
      arm_ = std::max(arm_, arm(corners_.back()));
    }
    const Vec3 center = placed(motion.start, cover::middle(piece)) - through_;
    radius_ = cover::farthest(center, corners_);
    arm_of_center_ = arm(center);
    extent_ += norm(through_) + norm(motion.start.translation) + norm(shift_);
  }

  /// As few as keep the distance.
  std::size_t slices(double max_distance) const {
    double count = std::max(1.0, std::ceil(std::abs(angle_) / (2 * kWidestHalfAngle)));
    while (spread(count) > max_distance && count <= kMostSweptPieces)
      count = std::ceil(std::max(count + 1, count * std::min(2.0, 0.9 * spread(count) / max_distance)));
    return static_cast<std::size_t>(count);
  }

  // How far a point x of the convex hull of a slice's points is from the piece, at one of its moments. x is the sum of
  // points x_i with weights w_i. Each is, up to `off`, a point of the piece at the beginning, middle or end: v_i at
  // t_i. Let s be the sum of w_i t_i. The sum of the w_i v_i at s belongs to the piece. For the middle c of the piece,
  // the sum of the w_i c(t_i) differs from c(s) by at most half of the second derivative times the variance of the t_i,
  // and v_i - c turns by |t_i - s|, of which the mean is at most the half angle h. 1 / cos h - 1 <= 0.54 h^2 up to pi /
  // 8, and tan h - h <= 0.36 h^3: both ratios increase with h.
  double spread(double count) const {
    const double h = std::abs(angle_) / (2 * count);
    const double off = 0.54 * h * h * arm_ + bow(count);
    return (radius_ * h + 0.5 * h * h * arm_of_center_ + off) * (1 + 0x1p-40);
  }

  /// Around all positions of the piece from the fraction i / count to (i + 1) / count of the motion.
  EnclosingPolytope slice(std::size_t i, std::size_t count, bool float32_coordinates) const {
    const auto at = [&](double place) { return place / static_cast<double>(count); };
    const double begin = at(double(i)), middle = at(double(i) + 0.5), end = at(double(i) + 1);
    const double half = angle_ / (2 * static_cast<double>(count));
    std::vector<Vec3> points;
    add_points(points, begin, 1, {});
    if (angle_ != 0 || shift_ != Vec3{}) add_points(points, end, 1, {});
    if (angle_ != 0) {
      const Vec3 bow = shift_ == Vec3{} ? Vec3{} : shift_ * (this->bow(double(count)) / norm(shift_));
      add_points(points, middle, 1 / std::cos(half), bow);
      if (bow != Vec3{}) add_points(points, middle, 1 / std::cos(half), -bow);
    }
    return polytope_around(std::move(points), rounding(), float32_coordinates);
  }

 private:
  double arm(const Vec3& p) const { return norm(cross(p, axis_)); }

  // While the axis goes straight, the arc of the unit circle becomes (cos s, sin s) + s d, with s from -h to h and d
  // the shift for an angle of 1. It lies in the convex hull of its ends and of the tangents' meeting point moved by w d
  // for all |w| <= tan h - h: with the weights of the arc, the meeting point has to move by w(s) = -sin h / cos h times
  // (h sin s - s sin h) / (cos s - cos h). Both parts of the fraction are 0 at h, and the ratio of their derivatives,
  // (sin h - h cos s) / sin s, increases up to h; so does the fraction (the monotone form of l'Hospital's rule). Its
  // limit there is (sin h - h cos h) / sin h.
  double bow(double count) const {
    const double h = std::abs(angle_) / (2 * count);
    return 0.18 * h * h * norm(shift_) / count * (1 + 0x1p-40);  // 0.36 h^3 |d|, and |d| = |shift| / count / (2 h)
  }

  /// A point takes less than 60 roundings of 2^-53 of the extent; the angle and the direction of the axis are rounded
  /// by 2^-51 of themselves, and move it by so much times the angle.
  double rounding() const { return 0x1p-46 * (1 + std::abs(angle_)) * extent_; }

  void add_points(std::vector<Vec3>& points, double place, double lengthened, const Vec3& offset) const {
    const double c = std::cos(place * angle_) * lengthened, s = std::sin(place * angle_) * lengthened;
    const Vec3 moved = through_ + shift_ * place + offset;
    for (const Vec3& p : corners_) {
      const Vec3 along = axis_ * dot(axis_, p), across = p - along;
      points.push_back(angle_ == 0 ? p + moved : along + across * c + cross(axis_, p) * s + moved);
    }
  }

  Vec3 shift_, through_, axis_;
  double angle_ = 0, extent_ = 0, radius_ = 0, arm_ = 0, arm_of_center_ = 0;
  std::vector<Vec3> corners_;  // from `through_`
};

struct Slice {
  std::size_t moved = 0, number = 0, count = 0;
};

void require_few(std::size_t pieces) {
  if (pieces > kMostSweptPieces)
    refuse(
        fmt::format("the sweep takes more than {} convex pieces: allow a larger distance or fewer "
                    "pieces, or divide the motion",
                    kMostSweptPieces));
}

std::vector<MovedPiece> moved_pieces(std::span<const RigidMotion> motions, std::span<const TriangleMesh> pieces) {
  require_few(motions.size() * pieces.size());
  if (pieces.empty()) throw InputError(Defect::EmptyMesh, "there is no polytope to sweep");
  std::vector<MovedPiece> moved;
  for (const RigidMotion& motion : motions)
    for (const TriangleMesh& piece : pieces) moved.emplace_back(motion, piece);
  return moved;
}

std::vector<Slice> slices_of(std::span<const MovedPiece> moved, double max_distance) {
  std::vector<Slice> slices;
  for (std::size_t m = 0; m < moved.size(); ++m) {
    const std::size_t count = moved[m].slices(max_distance);
    require_few(slices.size() + count);
    for (std::size_t i = 0; i < count; ++i) slices.push_back({m, i, count});
  }
  return slices;
}

/// Throws InputError for what no sweep is made of.
void check(std::span<const RigidMotion> motions, const SweepOptions& options) {
  if (motions.empty()) refuse("there is no motion");
  if (!(options.max_distance >= 0)) refuse("the largest distance is at least 0");
  for (const RigidMotion& motion : motions) require_motion(motion);
  require_few(motions.size());
}

}  // namespace

// Of convex sets, the one encloses the other if it reaches as far in each direction. Scaled about a point of depth d by
// 1 + g, a polytope reaches at least g d farther in each direction, and rounding its vertices takes away no more than
// they are moved.
EnclosingPolytope polytope_around(std::vector<Vec3> points, double distance, bool float32_coordinates) {
  constexpr double kUnseen = 1e-4;  // by so much of its size a polytope may grow, so that it gets no vertices
  constexpr double kLargestFloat32 = 1e38, kSmallest = 1e-60;
  Box box;
  for (const Vec3& p : points) box.extend(p);
  const double largest = largest_coordinate(box) + distance;
  if (!(largest <= (float32_coordinates ? kLargestFloat32 : kFarthest)))
    throw InputError(Defect::NonFiniteCoordinate, "the sweep goes beyond the numbers that can be stored");
  if (!(largest >= kSmallest))
    throw InputError(Defect::NoVolume,
                     fmt::format("no coordinate of what is swept is larger than {:g}, so that products of them vanish; "
                                 "scale it",
                                 kSmallest));
  const double rounding = rounding_of(largest, float32_coordinates), room = distance + rounding;
  TriangleMesh hull = convex_hull(cover::fan_of(points));
  const bool is_flat = hull.face_count() == 0;
  const Vec3 center = is_flat ? Vec3{} : cover::middle(hull);
  const double depth = is_flat ? 0 : proven_depth(center, hull);
  double growth = std::numbers::sqrt3 * room;
  if (room < kUnseen * depth) {
    const double factor = room / depth * (1 + 0x1p-40);
    growth = factor * cover::farthest(center, vertices_of(hull));
    for (Vec3& p : hull.positions) p += (p - center) * factor;
  } else {
    hull = slab_around(is_flat ? cover::fan_of(std::move(points)) : hull, room);
  }
  if (float32_coordinates)
    for (Vec3& p : hull.positions) p = nearest_float32(p);
  return {convex_hull(hull), growth + 2 * rounding};
}

Sweep sweep(std::span<const TriangleMesh> polytopes, std::span<const RigidMotion> motions,
            const SweepOptions& options) {
  const Stopwatch watch;
  check(motions, options);
  Box box;
  for (const TriangleMesh& polytope : polytopes)
    for (const Vec3& p : polytope.positions) box.extend(p);
  const std::vector<MovedPiece> moved = moved_pieces(motions, polytopes);
  const std::vector<Slice> slices =
      slices_of(moved, options.max_distance > 0 ? options.max_distance : kUsualDistance * box.diagonal());
  Sweep result;
  result.cover_pieces = polytopes.size();
  result.pieces.resize(slices.size());
  std::vector<double> reach(slices.size());
  ProgressMeter meter(options.progress, "sweep");
  std::atomic<std::size_t> done = 0;
  arena_of(options.threads).execute([&] {
    oneapi::tbb::parallel_for(std::size_t{0}, slices.size(), [&](std::size_t i) {
      const auto& [m, number, count] = slices[i];
      EnclosingPolytope polytope = moved[m].slice(number, count, options.float32_coordinates);
      result.pieces[i] = std::move(polytope.mesh);
      reach[i] = moved[m].spread(double(count)) + polytope.growth;
      meter.at(++done, slices.size());
    });
    const auto [volume, error] = cover::estimated_volume(result.pieces);
    result.volume = volume, result.volume_error = error;
  });
  result.verdict = {.certified = true,
                    .proof = "sweep",
                    .covers_triangles = Answer::Yes,
                    .encloses_solid = Answer::Yes,
                    .distance_to_solid = DistanceBounds{},
                    .original_closed = true};
  result.verdict = farther_by(std::move(result.verdict), std::ranges::max(reach));
  result.seconds = watch.seconds();
  return result;
}

Sweep sweep(TriangleMesh mesh, std::span<const RigidMotion> motions, const SweepOptions& options) {
  const Stopwatch watch;
  check(motions, options);
  SweepOptions how = options;
  if (how.max_distance == 0) how.max_distance = kUsualDistance * finite_bounding_box(mesh).diagonal();
  ConvexCover cover = convex_cover(
      std::move(mesh), {.max_pieces = options.max_pieces, .threads = options.threads, .progress = options.progress});
  std::vector<TriangleMesh> polytopes;
  for (ConvexPiece& piece : cover.pieces) polytopes.push_back(std::move(piece.mesh));
  Sweep result = sweep(polytopes, motions, how);
  result.verdict = farther_by(std::move(cover.verdict), result.verdict.distance().upper);
  result.verdict.proof = "sweep";
  result.fills_cavities = cover.fills_cavities;
  result.notes = std::move(cover.notes);
  result.seconds = watch.seconds();
  return result;
}

}  // namespace prohull
