#include <cmath>
#include <optional>

#include "prohull/distance.h"
#include "prohull/error.h"
#include "prohull/float32_hull.h"
#include "prohull/tight_hull.h"

namespace prohull {
namespace {

class TightSearch {
 public:
  TightSearch(const TriangleMesh& mesh, double distance, const HullOptions& options)
      : mesh_(mesh), distance_(distance), options_(options), best_{mesh, Stopped::Cancelled, {}, {}, 0} {
    distance_options_.progress = [this](double) {
      return !options_.progress || options_.progress({mesh_.face_count(), mesh_.face_count(), options_.target_faces});
    };
  }

  TightHull run() try {
    const std::size_t enough = faces_of_progressive_hull();
    std::size_t too_few = options_.target_faces;
    if (was_cancelled_ || is_near_with(too_few)) return best_;
    std::size_t fewest_near = enough;
    constexpr double kCloseEnough = 1.03;  // what is left to gain is less than the chance in each hull
    for (int builds = 1; builds < kMaxTightBuilds && !was_cancelled_; ++builds) {
      if (static_cast<double>(fewest_near) < kCloseEnough * static_cast<double>(too_few)) break;
      const auto middle = static_cast<std::size_t>(
          std::llround(std::sqrt(static_cast<double>(too_few) * static_cast<double>(fewest_near))));
      if (middle <= too_few || middle >= fewest_near) break;
      (is_near_with(middle) ? fewest_near : too_few) = middle;
    }
    if (!has_tight_ && !was_cancelled_ && enough > options_.target_faces) is_near_with(enough);
    return best_;
  } catch (const Cancelled&) {
    best_.stopped = Stopped::Cancelled;
    return best_;
  }

 private:
  /// Of the coarsest level that is near enough, which is the answer if no tight hull is better.
  std::size_t faces_of_progressive_hull() {
    HullOptions guarded = options_;
    guarded.self_intersections = SelfIntersections::Refused;
    HullResult result = build_hull(mesh_, guarded);
    was_cancelled_ = result.stopped == Stopped::Cancelled;
    if (was_cancelled_) return mesh_.face_count();
    const std::size_t faces = faces_within(result.hull, distance_, distance_options_);
    best_ = {result.hull.level(faces), result.stopped, result.refused, result.blocked, 0};
    return faces;
  }

  bool is_near_with(std::size_t faces) {
    HullOptions options = options_;
    options.target_faces = faces;
    TightHull hull = build_tight_hull(mesh_, options);
    was_cancelled_ = hull.stopped == Stopped::Cancelled;
    if (was_cancelled_) {
      best_.stopped = Stopped::Cancelled;
      return false;
    }
    if (hull.mesh.face_count() > best_.mesh.face_count() || !is_near(hull.mesh)) return false;
    best_ = std::move(hull);
    has_tight_ = true;
    return true;
  }

  bool is_near(const TriangleMesh& hull) const {
    const auto bound = [&](const TriangleMesh& h) { return distance_bounds(h, mesh_, distance_options_).upper; };
    return bound(options_.float32_coordinates ? with_float32_coordinates(hull, options_.side).mesh : hull) <= distance_;
  }

  const TriangleMesh& mesh_;
  const double distance_;
  const HullOptions& options_;
  DistanceOptions distance_options_;
  TightHull best_;
  bool has_tight_ = false, was_cancelled_ = false;
};

}  // namespace

TightHull build_tight_hull_within(const TriangleMesh& mesh, double distance, const HullOptions& options) {
  if (!(distance > 0)) throw InputError(Defect::InvalidOption, "the distance must be above 0");
  return TightSearch(mesh, distance, options).run();
}

}  // namespace prohull
