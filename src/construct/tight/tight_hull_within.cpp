#include <cmath>

#include "prohull/error.h"
#include "prohull/tight_hull.h"

namespace prohull {
namespace {

class TightSearch {
 public:
  TightSearch(const TriangleMesh& mesh, const std::function<bool(const TriangleMesh&)>& is_within,
              const HullOptions& options, const TriangleMesh* wrapped)
      : mesh_(mesh), is_within_(is_within), options_(options), wrapped_(wrapped), best_{mesh, Stopped::Cancelled,
                                                                                        {},   {},
                                                                                        0,    0} {}

  TightHull run() try {
    const std::size_t enough = faces_of_progressive_hull();
    std::size_t too_few = options_.target_faces;
    if (was_cancelled_ || is_within_with(too_few)) return best_;
    std::size_t fewest_within = enough;
    constexpr double kCloseEnough = 1.03;  // what is left to gain is less than the chance in each hull
    for (int builds = 3; builds < kMaxTightBuilds && !was_cancelled_; ++builds) {
      if (static_cast<double>(fewest_within) < kCloseEnough * static_cast<double>(too_few)) break;
      const auto middle = static_cast<std::size_t>(
          std::llround(std::sqrt(static_cast<double>(too_few) * static_cast<double>(fewest_within))));
      if (middle <= too_few || middle >= fewest_within) break;
      (is_within_with(middle) ? fewest_within : too_few) = middle;
    }
    if (!has_tight_ && !was_cancelled_ && enough > options_.target_faces) is_within_with(enough);
    return best_;
  } catch (const Cancelled&) {
    best_.stopped = Stopped::Cancelled;
    return best_;
  }

 private:
  /// Of the coarsest level that is accepted, which is the answer if no tight hull is better.
  std::size_t faces_of_progressive_hull() {
    HullOptions guarded = options_;
    guarded.self_intersections = SelfIntersections::Refused;
    HullResult result = build_hull(mesh_, guarded);
    was_cancelled_ = result.stopped == Stopped::Cancelled;
    if (was_cancelled_) return mesh_.face_count();
    const std::size_t faces = faces_within(result.hull, is_within_);
    best_ = {result.hull.level(faces), result.stopped, result.refused, result.blocked, 0, result.relaxed_guards};
    return faces;
  }

  bool is_within_with(std::size_t faces) {
    HullOptions options = options_;
    options.target_faces = faces;
    TightHull hull = build_tight_hull(mesh_, options, wrapped_);
    was_cancelled_ = hull.stopped == Stopped::Cancelled;
    if (was_cancelled_) {
      best_.stopped = Stopped::Cancelled;
      return false;
    }
    if (hull.mesh.face_count() > best_.mesh.face_count() || !is_within_(hull.mesh)) return false;
    best_ = std::move(hull);
    has_tight_ = true;
    return true;
  }

  const TriangleMesh& mesh_;
  const std::function<bool(const TriangleMesh&)>& is_within_;
  const HullOptions& options_;
  const TriangleMesh* wrapped_;
  TightHull best_;
  bool has_tight_ = false, was_cancelled_ = false;
};

}  // namespace

TightHull build_tight_hull_within(const TriangleMesh& mesh, const std::function<bool(const TriangleMesh&)>& is_within,
                                  const HullOptions& options, const TriangleMesh* wrapped) {
  return TightSearch(mesh, is_within, options, wrapped).run();
}

}  // namespace prohull
