#include "prohull/tight_hull.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "construct/shape_guards.h"
#include "construct/tight/few_faces.h"
#include "construct/tight/tight_collapses.h"
#include "construct/tight/tightening.h"
#include "construct/tight/unsearched.h"
#include "construct/turned.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/error.h"

namespace prohull {
namespace {

/// Vertices move at levels of so many faces: to the first one leads the progressive hull, to the others tight
/// collapses. Void of horse, rocker arm and screwdriver at 2,000 faces: 2.16, 1.86 and 1.37 % by {1.75, 1.3, 1} times
/// the target, by {2.5, 1.5, 1} with three rounds at each 2.14, 1.84 and 1.35 % in 1.6 times the time, by {1.5, 1.2,
/// 1} 2.18, 1.90 and 1.38 %. Progressive hulls of few faces are bad starts: rocker arm at 200 faces 16.9 % from
/// 350, 16.1 % from 613. Of small meshes, progressive hulls of up to half of the faces are near: a part of 1,172 faces
/// has the same void at 100 faces from 306 and from 536, in 0.64 of the time. From a third, four parts and a bracket of
/// 2,000 to 5,500 faces had 4 to 45 % more void at 100, in 0.76 to 1.2 of the time, and two had 5 and 10 % less.
std::vector<std::size_t> levels_above(std::size_t target, std::size_t all) {
  constexpr double kFirst = 1.75, kSecond = 1.3, kFewest = 600, kFiner = 2;
  const auto faces = static_cast<double>(target);
  std::vector<double> levels{faces, kSecond * faces, kFirst * faces};
  while (target > 0 && levels.back() < kFewest && kFiner * kFirst * levels.back() < static_cast<double>(all))
    levels.push_back(kFirst * levels.back());
  std::vector<std::size_t> rounded;
  for (const double level : levels) rounded.push_back(static_cast<std::size_t>(std::llround(level)));
  std::erase_if(rounded, [&](std::size_t level) { return level > target && level >= all; });
  std::ranges::reverse(rounded);
  return rounded;
}

constexpr unsigned kMostRounds = 12;
constexpr double kShareOfLevels = 0.3;  ///< of the time, where there is a search

class TightBuild {
 public:
  TightBuild(const Original& original, const TriangleMesh& mesh, const HullOptions& options, std::size_t most_searched)
      : original_(original),
        mesh_(mesh),
        options_(options),
        most_searched_(most_searched),
        step_(options),
        meter_(options.progress, "tighten") {
    step_.self_intersections = SelfIntersections::Refused;
  }

  TightHull run() {
    tight_.mesh = mesh_;
    const std::size_t target = std::min(options_.target_faces, mesh_.face_count());
    const std::vector<std::size_t> levels = levels_above(target, mesh_.face_count());
    const bool is_searched = target <= most_searched_ && target < mesh_.face_count();
    const std::size_t all = std::accumulate(levels.begin(), levels.end(), std::size_t{0});
    const double share = is_searched ? kShareOfLevels : 1;
    std::size_t done = 0;  // a level takes time with its faces
    for (const std::size_t faces : levels) {
      step_.target_faces = faces;
      const double from = double(done) / double(all), to = double(done + faces) / double(all);
      reach(share * from, share * to, faces == target ? kMostRounds : 1);
      done += faces;
    }
    TriangleMesh hull = hull_->triangle_mesh();
    if (is_searched && is_near(target, hull)) hull = with_less_volume(hull, original_, search_options());
    tight_.mesh = turned_if_inner(hull, options_.side);
    if (tight_.mesh.face_count() <= options_.target_faces) tight_.stopped = Stopped::TargetReached;
    return std::move(tight_);
  }

 private:
  // Trials seldom remove more faces, and look for them at all edges.
  static bool is_near(std::size_t target, const TriangleMesh& hull) { return hull.face_count() <= target + target / 4; }

  // With the guards that the hull has needed so far.
  HullOptions search_options() {
    HullOptions search = step_;
    if (tight_.relaxed_guards > 0) search.guards = weaker(search.guards, kRelaxedGuards[tight_.relaxed_guards - 1]);
    search.progress = meter_.part(kShareOfLevels, 1);
    return search;
  }

  // From one part of the work done to another.
  void reach(double from, double to, unsigned max_rounds) {
    step_.progress = meter_.part(from, std::lerp(from, to, 0.5));
    if (hull_) collapse_tightly(*hull_, original_, step_, *contacts_);
    if (!hull_ || hull_->face_count() > step_.target_faces)
      build_on();
    else
      tight_.stopped = Stopped::TargetReached;
    tight_.moved_vertices += tighten(*hull_, original_,
                                     {.guards = step_.guards,
                                      .float32_coordinates = step_.float32_coordinates,
                                      .max_rounds = max_rounds,
                                      .threads = step_.threads,
                                      .progress = meter_.part(std::lerp(from, to, 0.5), to)},
                                     *contacts_);
  }

  // Collapses outside of the hull, which may do what tight ones may not.
  void build_on() {
    if (hull_) {
      tight_.mesh = turned_if_inner(hull_->triangle_mesh(), options_.side);
      if (!(signed_volume(tight_.mesh) > 0)) {  // what is left of an inner hull is as thin as rounding
        tight_.stopped = Stopped::NoLegalCollapse;
        return;
      }
    }
    HullOptions left = step_;
    left.guards.max_overhang =
        overhang_left(bounding_box(tight_.mesh), bounding_box(mesh_), options_.guards.max_overhang);
    HullResult result = build_hull(tight_.mesh, left);
    tight_.refusals += result.refusals;
    tight_.blocked = result.blocked;
    tight_.stopped = result.stopped;
    tight_.relaxed_guards = result.relaxed_guards;
    hull_.emplace(turned_if_inner(result.hull.base(), options_.side));
    contacts_.emplace(hull_->positions().size());
  }

  const Original& original_;
  const TriangleMesh& mesh_;
  const HullOptions& options_;
  const std::size_t most_searched_;  ///< faces of a hull that is searched on from
  HullOptions step_;
  ProgressMeter meter_;
  std::optional<HalfEdgeMesh> hull_;
  std::optional<Contacts> contacts_;
  TightHull tight_{{}, Stopped::TargetReached, {}, {}, 0, 0};
};

Original original_of(const TriangleMesh& mesh, const TriangleMesh* wrapped, HullSide side, double padding,
                     unsigned threads) {
  if (!wrapped) return Original::closed(turned_if_inner(mesh, side), side, threads);
  if (side == HullSide::Inner && padding == 0)
    throw InputError(Defect::InvalidOption, "nothing is inside of triangles that are not closed: no inner hull");
  if (padding > 0) return Original::padded_triangles(*wrapped, padding, threads);
  return Original::triangles(*wrapped, threads);
}

TightHull build(const TriangleMesh& mesh, const HullOptions& options, const TriangleMesh* wrapped, double padding,
                std::size_t most_searched) {
  if (options.self_intersections == SelfIntersections::Allowed)
    throw InputError(Defect::InvalidOption, "self-intersections cannot be allowed: a tight hull never adds any");
  if (!options.tolerances.empty())
    throw InputError(Defect::InvalidOption, "a tight hull has no tolerances for single faces: build it without tight");
  if (options.mirror) throw InputError(Defect::InvalidOption, "a tight hull is not symmetric: build it without tight");
  const Original original = original_of(mesh, wrapped, options.side, padding, options.threads);
  return TightBuild(original, mesh, options, most_searched).run();
}

}  // namespace

TightHull build_unsearched_tight_hull(const TriangleMesh& mesh, const HullOptions& options, const TriangleMesh* wrapped,
                                      double padding) {
  return build(mesh, options, wrapped, padding, 0);
}

TightHull build_tight_hull(const TriangleMesh& mesh, const HullOptions& options, const TriangleMesh* wrapped,
                           double padding) {
  return build(mesh, options, wrapped, padding, kFewFaces);
}

TriangleMesh moved_towards_closed(const TriangleMesh& hull, const TriangleMesh& mesh, HullSide side,
                                  const MoveOptions& options) {
  return moved_towards_closed(hull, mesh, side, options, {});
}

TriangleMesh moved_towards_closed(const TriangleMesh& hull, const TriangleMesh& mesh, HullSide side,
                                  const MoveOptions& options, const MayReach& may_reach) {
  HalfEdgeMesh moving(turned_if_inner(hull, side));
  tighten(moving, original_of(mesh, nullptr, side, 0, options.threads), options, may_reach);
  return turned_if_inner(moving.triangle_mesh(), side);
}

TriangleMesh moved_towards(const TriangleMesh& hull, const TriangleMesh& triangles, const MoveOptions& options) {
  return moved_towards(hull, triangles, options, {});
}

TriangleMesh moved_towards(const TriangleMesh& hull, const TriangleMesh& triangles, const MoveOptions& options,
                           const MayReach& may_reach) {
  HalfEdgeMesh moving(turned_if_inner(hull, options.side));
  tighten(moving, original_of(hull, &triangles, options.side, options.padding, options.threads), options, may_reach);
  return turned_if_inner(moving.triangle_mesh(), options.side);
}

}  // namespace prohull
