#include <algorithm>
#include <cmath>

#include "construct/tight/unsearched.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/tight_hull.h"

namespace prohull {
namespace {

constexpr int kMaxTightBuilds = 11;  // with the progressive hull that it begins with

class TightSearch {
 public:
  TightSearch(const TriangleMesh& mesh, const std::function<bool(const TriangleMesh&)>& is_within,
              const HullOptions& options, const TriangleMesh* wrapped, double padding, std::size_t most_faces)
      : mesh_(mesh),
        is_within_(is_within),
        options_(options),
        wrapped_(wrapped),
        padding_(padding),
        most_faces_(most_faces),
        meter_(options.progress, "search") {}

  TightHull run() {
    build_progressive();
    const std::size_t enough = best_.mesh.face_count();
    const bool is_known_to_be_enough = enough <= most_faces_ && is_within_(best_.mesh);
    std::size_t too_few = options_.target_faces;
    if (build_tight_within(too_few)) {
      keep_if_within(build_tight_hull(mesh_, next_options(too_few), wrapped_, padding_));
      return best_;
    }
    std::size_t fewest_within = std::min(enough, most_faces_);
    if (!is_known_to_be_enough && (fewest_within <= too_few || !build_tight_within(fewest_within))) return best_;
    constexpr double kCloseEnough = 1.03;  // what is left to gain is less than the chance in each hull
    while (builds_ < kMaxTightBuilds - 1) {
      if (static_cast<double>(fewest_within) < kCloseEnough * static_cast<double>(too_few)) break;
      const auto middle = static_cast<std::size_t>(
          std::llround(std::sqrt(static_cast<double>(too_few) * static_cast<double>(fewest_within))));
      if (middle <= too_few || middle >= fewest_within) break;
      (build_tight_within(middle) ? fewest_within : too_few) = middle;
    }
    if (!has_tight_ && enough > options_.target_faces) build_tight_within(enough);
    return best_;
  }

 private:
  HullOptions next_options(std::size_t target_faces) {
    HullOptions options = options_;
    options.target_faces = target_faces;
    options.progress = meter_.part(double(builds_) / kMaxTightBuilds, double(builds_ + 1) / kMaxTightBuilds);
    ++builds_;
    return options;
  }

  /// Its coarsest level that is accepted, or else its finest, is the answer if no tight hull is better.
  void build_progressive() {
    HullOptions guarded = next_options(options_.target_faces);
    guarded.self_intersections = SelfIntersections::Refused;
    HullResult result = build_hull(mesh_, guarded);
    best_ = {result.hull.level(faces_within(result.hull, is_within_)),
             result.stopped,
             result.refusals,
             result.blocked,
             0,
             result.relaxed_guards};
  }

  /// Whether the tight hull of so many faces is accepted; it is then the best.
  bool build_tight_within(std::size_t faces) {
    return keep_if_within(build_unsearched_tight_hull(mesh_, next_options(faces), wrapped_, padding_));
  }

  bool keep_if_within(TightHull hull) {
    if (hull.mesh.face_count() > best_.mesh.face_count() || !is_within_(hull.mesh)) return false;
    best_ = std::move(hull);
    has_tight_ = true;
    return true;
  }

  const TriangleMesh& mesh_;
  const std::function<bool(const TriangleMesh&)>& is_within_;
  const HullOptions& options_;
  const TriangleMesh* wrapped_;
  const double padding_;
  const std::size_t most_faces_;
  ProgressMeter meter_;
  int builds_ = 0;
  TightHull best_;
  bool has_tight_ = false;
};

}  // namespace

TightHull build_tight_hull_within(const TriangleMesh& mesh, const std::function<bool(const TriangleMesh&)>& is_within,
                                  const HullOptions& options, const TriangleMesh* wrapped, double padding,
                                  std::size_t most_faces) {
  return TightSearch(mesh, is_within, options, wrapped, padding, most_faces).run();
}

}  // namespace prohull
