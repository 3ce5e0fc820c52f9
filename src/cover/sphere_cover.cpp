#include "prohull/sphere_cover.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "cover/ball_search.h"
#include "cover/depth.h"
#include "cover/inside_cubes.h"
#include "cover/mesh_to_cover.h"
#include "cover/patches.h"
#include "enclose/known_void.h"
#include "geometry/largest_coordinate.h"
#include "mesh/area.h"
#include "parallel/arena.h"
#include "prohull/closed_solid.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/detail/refuse.h"
#include "prohull/detail/rounded.h"
#include "prohull/detail/stopwatch.h"
#include "prohull/detail/text.h"
#include "prohull/enclosure.h"
#include "prohull/union_verification.h"
#include "verify/known_solid.h"
#include "verify/original.h"

namespace prohull {
namespace {

using cover::BallCover;
using cover::BallTask;
using cover::CubeGrid;
using cover::Depth;
using cover::enclosing_options;
using cover::Patches;
using cover::Place;

void check(const SphereCoverOptions& options) {
  if (options.max_balls == 0) refuse("max_balls is 0; a cover has at least one ball");
  if (options.max_balls > kMostCoverBalls)
    refuse(fmt::format("a cover has at most {} spheres, not {}", grouped(kMostCoverBalls), options.max_balls));
  if (!(options.max_distance > 0))
    refuse(fmt::format("max_distance is {}; it must be greater than 0", options.max_distance));
}

/// What is to be covered, cut into patches, and places for balls.
struct Cut {
  double size;  ///< of a cube
  Patches patches;
  std::vector<Place> places = {};
};

/// As many as a float32 has, of any exponent.
double of_24_bits(double x, double (&round)(double)) {
  constexpr int kBits = std::numeric_limits<float>::digits;
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  return std::ldexp(round(std::ldexp(fraction, kBits)), exponent - kBits);
}

class SphereCoverer {
 public:
  SphereCoverer(TriangleMesh triangles, const SphereCoverOptions& options)
      : options_(options),
        input_(prepared_for_hulls(std::move(triangles), enclosing_options(options.threads, options.progress))),
        diagonal_(bounding_box(input_.original).diagonal()) {
    constexpr double kOfDiagonal = 1e-7, kOfCoordinate = 1e-14;
    least_margin_ =
        std::max({kOfDiagonal * diagonal_, kOfCoordinate * largest_coordinate(bounding_box(input_.original)),
                  std::numeric_limits<double>::min()});
  }

  SphereCover run() {
    const Stopwatch all;
    find_solid();
    SphereCover cover = best_cover();
    cover::add_notes_of_repairs(input_.repairs, cover.notes);
    cover.seconds = all.seconds();
    return cover;
  }

 private:
  void find_solid() {
    TriangleMesh sheets;
    if (input_.closed) {
      solid_ = input_.closed->mesh, sheets = input_.dropped;
      append(sheets, faces_beside(solid_));
      made_.verdict.cap_faces = verify::stand_in(solid_, input_.original).caps;
      const InsideVolume as_it_is = volume_inside(input_, options_.progress);
      const InsideVolume inside = cover::filled_volume(input_, as_it_is, options_.progress);
      made_.original_volume = inside.volume, made_.is_estimated = inside.is_estimated;
      add_note_of_cavities(as_it_is.volume, inside.volume, made_.notes);
    } else {
      wrap_solid();
      sheets = input_.original;
    }
    to_cover_ = input_.original;
    if (options_.fill) append(to_cover_, solid_);
    box_ = bounding_box(to_cover_);
    ProgressMeter meter(options_.progress, "spheres");
    depth_.emplace(solid_, slack_, std::move(sheets), meter);
  }

  /// The faces that bound no part of a solid, as both sides of a loose triangle; of a tangle, all that meet others.
  TriangleMesh faces_beside(const TriangleMesh& solid) const {
    TriangleMesh faces;
    verify::KnownSolid known(solid, "solid");
    for (const FaceId f : known.faces_beside(options_.progress)) {
      const Triangle t = solid.triangle(f);
      faces.triangles.push_back(
          {faces.positions.push_back(t.a), faces.positions.push_back(t.b), faces.positions.push_back(t.c)});
    }
    return faces;
  }

  /// Of triangles that bound no solid: a wrap, which closes what is open.
  void wrap_solid() {
    constexpr double kPerDiagonal = 96;
    const double spacing = std::max(diagonal_ / kPerDiagonal, least_margin_);
    TriangleMesh near = input_.with_caps();
    Wrap made = cover::wrap_around(near, spacing, options_.progress);
    solid_ = std::move(made.mesh);
    append(near, made.doors);
    slack_ = distance_bounds(solid_, near, {.progress = options_.progress}).upper;
    made_.original_volume = made.inside_volume, made_.is_estimated = true;
    made_.notes.push_back(fmt::format(
        "the triangles bound no solid ({}): what lies inside is taken from a wrap, up to {:.4g} around them",
        input_.obstacle, rounded_up(slack_, 4)));
  }

  /// The first that keeps max_distance, of covers of few balls and one of all; or the one that reaches least.
  SphereCover best_cover() {
    std::optional<SphereCover> best = within_distance();
    if (best && best->within_bounds) return std::move(*best);
    SphereCover nearest = nearest_cover();
    nearest.verify_seconds += best ? best->verify_seconds : 0;
    if (!best || nearest.verdict.distance().upper <= best->verdict.distance().upper) best = std::move(nearest);
    if (!best->within_bounds)
      best->notes.push_back(fmt::format("no cover by {} was found that keeps a distance of {:.4g}",
                                        counted(options_.max_balls, "sphere"), options_.max_distance));
    return std::move(*best);
  }

  /// Of few balls: what is proven of them may exceed what the search estimates, so that it aims again, by that nearer.
  std::optional<SphereCover> within_distance() {
    constexpr double kRoomForTheProof = 1.0 / 512;  // of what is asked for: union_reach is a bound
    constexpr int kMostAims = 2;
    std::optional<SphereCover> cover;
    if (!std::isfinite(options_.max_distance)) return cover;
    double verify_seconds = 0, aim = options_.max_distance * (1 - kRoomForTheProof) - 2 * least_margin_;
    for (int i = 0; i < kMostAims && aim > 0; ++i, aim *= options_.max_distance / cover->verdict.distance().upper) {
      const BallCover found = keep_distance(aim);
      if (found.balls.empty()) break;
      cover = proven(found);
      verify_seconds += cover->verify_seconds;
      cover->verify_seconds = verify_seconds;
      if (cover->within_bounds) break;
    }
    return cover;
  }

  /// Few balls that reach out by no more, as far as the search can tell; none if that takes too many.
  BallCover keep_distance(double reach) {
    constexpr double kCoarsest = 8;
    ProgressMeter meter(options_.progress, "spheres");
    const Cut cut = cut_up(size_of_cubes(std::min(reach / kCubesPerReach, diagonal_ / kCoarsest)), meter);
    const BallTask task{cut.patches, *depth_, cut.size, meter};
    return cover::fewest_balls(task, cut.places, options_.max_balls, reach);
  }

  /// For few balls the search estimates coarsely, so that half as many may be proven to reach out by less.
  SphereCover nearest_cover() {
    constexpr std::size_t kFew = 8;
    const auto rank = [](const SphereCover& c) { return std::pair(c.verdict.distance().upper, c.volume); };
    SphereCover best = proven(reach_least(options_.max_balls));
    double verify_seconds = best.verify_seconds;
    for (std::size_t count = options_.max_balls / 2; count > 0 && options_.max_balls <= kFew; count /= 2) {
      SphereCover fewer = proven(reach_least(count));
      verify_seconds += fewer.verify_seconds;
      if (fewer.verdict.certified >= best.verdict.certified && rank(fewer) < rank(best)) best = std::move(fewer);
    }
    best.verify_seconds = verify_seconds;
    return best;
  }

  /// Searches with coarser or finer patches, until they are small beside the reach, or as many as there may be.
  BallCover reach_least(std::size_t max_balls) {
    ProgressMeter meter(options_.progress, "spheres");
    const double first = diagonal_ * 0.25 / std::sqrt(static_cast<double>(max_balls));
    constexpr int kMostRounds = 12;  // where a finer guess finds nothing and a coarser one too much, they would go on
    double guess = first, finest = std::numeric_limits<double>::infinity();
    BallCover best;
    for (int round = 1;; ++round) {
      const double size = size_of_cubes(guess / kCubesPerReach);
      if (!best.balls.empty() && size >= finest) return best;
      const Cut cut = cut_up(size, meter);
      const BallTask task{cut.patches, *depth_, cut.size, meter};
      BallCover found = cover::least_reach(task, cut.places, max_balls, std::max(guess, 2 * cut.size));
      const bool is_any = !found.balls.empty();
      const double reach = found.reach;
      if (is_any) finest = std::min(finest, size);
      if (is_any && (best.balls.empty() || reach < best.reach)) best = std::move(found);
      constexpr double kFinest = 0.5;  // a ball is covered by one that reaches out by nothing
      if (is_any && (reach > guess / 2 || guess < kFinest * first || round >= kMostRounds)) return best;
      guess = is_any ? std::max(reach * 1.1, guess / 3) : guess * 1.5;
    }
  }

  /// As small as asked for, but for how many there may be, and for rounding.
  double size_of_cubes(double size) const {
    constexpr double kMostPatches = 100'000, kPatchesPerBall = 10;
    const double most = std::max(kMostPatches, kPatchesPerBall * static_cast<double>(options_.max_balls));
    return std::max({size, std::sqrt(area_of(to_cover_) / most), least_margin_});
  }

  Cut cut_up(double size, ProgressMeter& meter) {
    const CubeGrid grid(box_, size);
    std::vector<cover::PointInCube> points = cover::points_in_cubes(to_cover_, grid);
    meter.at(0.1);
    Cut cut{grid.spacing(), cover::patches_of(points)};
    constexpr std::size_t kLeastPlaces = 5000, kPlacesPerBall = 40;
    cut.places = cover::places_for_balls({cut.patches, *depth_, cut.size, meter}, cut.size,
                                         std::max(kLeastPlaces, kPlacesPerBall * options_.max_balls));
    meter.at(0.3);
    if (options_.fill) {
      cover::add_inside(points, grid, box_, *depth_, meter);
      cut.patches = cover::patches_of(std::move(points));
    }
    meter.at(0.4);
    return cut;
  }

  /// What was found, with all that is told of it.
  SphereCover proven(const BallCover& found) const {
    SphereCover cover = made_;
    const Stopwatch verifying;
    certify(cover, found);
    cover.verify_seconds = verifying.seconds();
    measure(cover);
    return cover;
  }

  /// The balls become larger by a hair, so that no rounding uncovers anything.
  void certify(SphereCover& cover, const BallCover& found) const {
    constexpr int kTrials = 4;
    constexpr double kGrowth = 10;
    double margin = least_margin_;
    for (int trial = 0; trial < kTrials; ++trial, margin *= kGrowth) {
      cover.balls.clear();
      for (const auto& [center, radius] : found.balls) cover.balls.push_back(stored({center, radius + margin}));
      UnionVerification verification = decided(cover.balls);
      cover.volume = verification.union_volume;
      cover.verdict = std::move(verification);
      if (cover.verdict.certified) break;
    }
    cover.is_of_wrap = !input_.closed, cover.fills_wrap = cover.is_of_wrap && options_.fill && cover.verdict.certified;
    cover.verdict.non_finite_faces = input_.repairs.dropped_non_finite_faces;
    cover.verdict.cap_faces = made_.verdict.cap_faces;
  }

  // Planners on GPUs read float32 numbers. Far from the origin these are too coarse.
  Ball stored(const Ball& ball) const {
    constexpr double kMostRounding = 1e-5;  // of the diagonal
    Vec3 center;
    for (int axis = 0; axis < 3; ++axis) center[axis] = of_24_bits(ball.center[axis], std::nearbyint);
    const double radius = of_24_bits(ball.radius + norm(center - ball.center), std::ceil);
    return radius - ball.radius < kMostRounding * diagonal_ ? Ball{center, radius} : ball;
  }

  UnionVerification decided(const std::vector<Ball>& balls) const {
    const VerificationOptions options{.progress = options_.progress};
    const bool asks_inside = options_.fill && is_closed(input_.original);
    UnionVerification found = verify_union(balls, input_.original, asks_inside, options);
    if (!found.certified || !options_.fill || asks_inside) return found;
    UnionVerification of_solid = verify_union(balls, solid_, true, options);
    found.certified = of_solid.certified, found.why_not = std::move(of_solid.why_not);
    if (input_.closed) found.encloses_solid = of_solid.certified ? Answer::Yes : Answer::Undecided;
    return found;
  }

  DistanceBounds reach_of(const std::vector<Ball>& balls) const {
    DistanceBounds reach = union_reach(balls, solid_, {.progress = options_.progress});
    const double most = options_.max_distance - slack_;
    if (reach.upper > most && reach.lower < most && reach.lower > 0)
      reach = union_reach(balls, solid_, {.relative_gap = most / reach.lower - 1, .progress = options_.progress});
    reach.upper += slack_;
    if (slack_ > 0 || input_.dropped.face_count() > 0) reach.lower = 0;
    return reach;
  }

  void measure(SphereCover& cover) const {
    DistanceBounds reach = reach_of(cover.balls), from_triangles = reach;
    if (cover.is_of_wrap || input_.caps.face_count() > 0 || input_.dropped.face_count() > 0 ||
        input_.repairs.crossing_components > 0)
      from_triangles = union_reach(cover.balls, input_.original, {.progress = options_.progress});
    reach.upper = std::min(reach.upper, from_triangles.upper);  // the solid has the triangles
    cover.verdict.distance_to_triangles = from_triangles, cover.verdict.distance_to_solid = reach;
    const bool fills = cover.fills_wrap || cover.verdict.encloses_solid == Answer::Yes;
    // No estimate may say that the mesh is larger than what covers it.
    if (cover.is_estimated && fills && cover.original_volume > cover.volume) cover.original_volume = 0;
    cover.within_bounds = reach.upper <= options_.max_distance;
  }

  static constexpr double kCubesPerReach = 3;

  const SphereCoverOptions& options_;
  const RepairedMesh input_;
  const double diagonal_;
  double least_margin_ = 0;
  Box box_;
  TriangleMesh solid_, to_cover_;
  double slack_ = 0;
  std::optional<Depth> depth_;
  SphereCover made_;  ///< what is known of the solid, without balls
};

}  // namespace

SphereCover sphere_cover(TriangleMesh triangles, const SphereCoverOptions& options) {
  check(options);
  SphereCover cover;
  arena_of(options.threads).execute([&] { cover = SphereCoverer(std::move(triangles), options).run(); });
  return cover;
}

}  // namespace prohull
