#include "prohull/tight_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "construct/best_of.h"
#include "construct/shape_guards.h"
#include "construct/tight/tight_collapses.h"
#include "construct/tight/tightening.h"
#include "construct/turned.h"
#include "mesh/half_edge_mesh.h"
#include "parallel/progress_meter.h"
#include "prohull/error.h"

namespace prohull {
namespace {

/// The levels at which vertices are moved, as multiples of the target. Small steps at the end count most: rocker arm
/// at 2,000 faces 2.14 % by {2, 1}, 2.10 % by {4, 2, 1}, 2.04 % by {4, 2.8, 2, 1.4, 1}.
constexpr std::array kLevels{8.0, 4.0, 2.5, 1.75, 1.35, 1.15, 1.0};

/// From this level on collapses are tight. Rocker arm at 2,000 faces: 2.02 % without, 1.92 % from 1.0 on, 1.86 %
/// from 1.35, 1.84 % from 1.75 or 2.5, 1.83 % from 4.
constexpr double kTightCollapses = 1.75;

TightHull build_towards(const Original& original, const TriangleMesh& mesh, const HullOptions& options) {
  const bool inner = options.side == HullSide::Inner;
  TightHull tight{mesh, Stopped::TargetReached, {}, {}, 0, 0};
  HullOptions step = options;
  step.self_intersections = SelfIntersections::Refused;
  ProgressMeter meter(options.progress, "tighten");
  double done = 0;  // of the sum of kLevels: a level takes time with its faces
  const auto set_part = [&](double level, double from, double to) {
    const double all = std::accumulate(kLevels.begin(), kLevels.end(), 0.0);
    step.progress = meter.part((done + from * level) / all, (done + to * level) / all);
  };
  const auto apply = [&](auto&& change) {
    HalfEdgeMesh hull(inner ? turned(tight.mesh) : tight.mesh);
    change(hull);
    tight.mesh = inner ? turned(hull.triangle_mesh()) : hull.triangle_mesh();
  };
  for (const double level : kLevels) {
    const auto target = static_cast<double>(std::min(options.target_faces, mesh.face_count()));
    const auto faces = static_cast<std::size_t>(std::llround(level * target));
    if (faces >= mesh.face_count() && level > 1) {
      done += level;
      continue;
    }
    step.target_faces = faces;
    set_part(level, 0, 0.3);
    if (level <= kTightCollapses) apply([&](HalfEdgeMesh& hull) { collapse_tightly(hull, original, step); });
    set_part(level, 0.3, 0.4);
    step.guards.max_overhang = overhang_left(bounding_box(tight.mesh), bounding_box(mesh), options.guards.max_overhang);
    HullResult result = build_hull(tight.mesh, step);
    tight.refusals += result.refusals;
    tight.blocked = result.blocked;
    tight.stopped = result.stopped;
    tight.relaxed_guards = result.relaxed_guards;
    tight.mesh = result.hull.base();
    set_part(level, 0.4, 1);
    apply([&](HalfEdgeMesh& hull) {
      tight.moved_vertices +=
          tighten(hull, original,
                  {.guards = step.guards, .float32_coordinates = step.float32_coordinates, .progress = step.progress});
    });
    done += level;
  }
  return tight;
}

Original original_of(const TriangleMesh& mesh, const TriangleMesh* wrapped, HullSide side, double padding) {
  if (!wrapped) return Original::closed(side == HullSide::Inner ? turned(mesh) : mesh, side);
  if (side == HullSide::Inner && padding == 0)
    throw InputError(Defect::InvalidOption, "nothing is inside of triangles that are not closed: no inner hull");
  if (padding > 0) return Original::padded_triangles(*wrapped, padding);
  constexpr double kClearance = 1e-6;  // of the diagonal: more than a hull moves when it is rounded to float32
  return Original::triangles(*wrapped, kClearance * bounding_box(*wrapped).diagonal());
}

}  // namespace

TightHull build_tight_hull(const TriangleMesh& mesh, const HullOptions& options, const TriangleMesh* wrapped,
                           double padding) {
  if (options.self_intersections == SelfIntersections::Allowed)
    throw InputError(Defect::InvalidOption, "self-intersections cannot be allowed: a tight hull never adds any");
  if (!options.tolerances.empty())
    throw InputError(Defect::InvalidOption, "a tight hull has no tolerances for single faces: build it without tight");
  const Original original = original_of(mesh, wrapped, options.side, padding);
  if (options.best_of <= 1) return build_towards(original, mesh, options);
  return best_of(
      options, "tighten", [&](const HullOptions& one) { return build_towards(original, mesh, one); },
      [](const TightHull& result) -> const TriangleMesh& { return result.mesh; });
}

TriangleMesh moved_towards_closed(const TriangleMesh& hull, const TriangleMesh& mesh, HullSide side,
                                  const MoveOptions& options) {
  const bool inner = side == HullSide::Inner;
  HalfEdgeMesh moving(inner ? turned(hull) : hull);
  tighten(moving, original_of(mesh, nullptr, side, 0), options);
  return inner ? turned(moving.triangle_mesh()) : moving.triangle_mesh();
}

TriangleMesh moved_towards(const TriangleMesh& hull, const TriangleMesh& triangles, const MoveOptions& options) {
  const bool inner = options.side == HullSide::Inner;
  HalfEdgeMesh moving(inner ? turned(hull) : hull);
  tighten(moving, original_of(hull, &triangles, options.side, options.padding), options);
  return inner ? turned(moving.triangle_mesh()) : moving.triangle_mesh();
}

}  // namespace prohull
