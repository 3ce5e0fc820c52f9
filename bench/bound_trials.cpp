#include "bound_trials.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "enclose/candidate.h"
#include "parallel/arena.h"
#include "prohull/error.h"

namespace prohull::bench {
namespace {

class BoundTrials {
 public:
  BoundTrials(const TriangleMesh& mesh, std::size_t faces, const EnclosingOptions& options)
      : request_(mesh, faces, options), solids_(request_), faces_(faces), distance_(options.bounds.max_distance) {}

  void try_mesh() {
    if (solids_.has_mesh()) try_solid(0, "mesh");
  }

  void try_convex_hull() {
    if (const auto id = solids_.convex_hull({})) try_solid(*id, "convex hull");
  }

  void try_wrap(double spacing, double flatness) {
    std::string why_not;
    const WrapKind kind{.nodes_per_edge = 3.5, .offset = 0.3, .closing = 0, .flatness = flatness};
    const auto id = solids_.wrap(kind, spacing * distance_, faces_, why_not);
    if (id) try_solid(*id, fmt::format("wrap {:.2f}{}", spacing, flatness > 0 ? " flat" : ""));
  }

  std::vector<BoundTrial> taken() && { return std::move(trials_); }

 private:
  void try_solid(SolidId id, const std::string& what) {
    const bool is_mesh = solids_[id].source == Source::Mesh;
    const Approach approach = is_mesh ? Approach::Touching : Approach::Clear;
    if (is_mesh) take(id, {Method::Levels}, 0, what + ", level");
    take(id, {Method::Levels, true, approach}, 0, what + ", moved level");
    for (const double part : {0.7, 0.85, 1.0, 1.35, 1.75}) {
      const std::string within = fmt::format("{}, within {:g}", what, part);
      if (is_mesh) take(id, {Method::Within}, part, within);
      take(id, {Method::Within, true, approach}, part, within + " moved");
    }
  }

  /// Also with further collapses, if it keeps the bound.
  void take(SolidId id, Recipe recipe, double part, const std::string& what) {
    Candidate candidate{.solid = id,
                        .target_faces = faces_,
                        .recipe = recipe,
                        .bounds = request_.options.bounds,
                        .within = part * distance_};
    candidate.start = add(candidate, what);
    if (!candidate.start) return;
    candidate.recipe = {Method::Further, true, recipe.approach};
    add(candidate, what + ", further");
  }

  /// Returns the hull if it keeps the bound.
  std::optional<EnclosingHull> add(const Candidate& candidate, std::string what) {
    std::optional<Attempt> made = attempt(candidate, request_, solids_);
    if (!made) return std::nullopt;
    const bool is_kept = made->hull.certified && made->hull.within_bounds;
    trials_.push_back({std::move(what), made->hull.mesh.face_count(), is_kept});
    return is_kept ? std::optional(std::move(made->hull)) : std::nullopt;
  }

  const Request request_;
  Solids solids_;
  const std::size_t faces_;
  const double distance_;
  std::vector<BoundTrial> trials_;
};

}  // namespace

std::vector<BoundTrial> bound_trials(const TriangleMesh& mesh, std::size_t faces, const EnclosingOptions& options,
                                     double finest) {
  return arena_of(options.hull.threads).execute([&] {
    BoundTrials trials(mesh, faces, options);
    trials.try_mesh();
    trials.try_convex_hull();
    constexpr double kLargest = 2, kSmallest = 0.25, kSteps = 7;
    for (int i = 0; i <= kSteps; ++i) {
      const double spacing = kLargest * std::pow(kSmallest / kLargest, i / kSteps);
      if (spacing * options.bounds.max_distance < finest) break;
      for (const double flatness : {0.0, 0.08}) trials.try_wrap(spacing, flatness);
    }
    return std::move(trials).taken();
  });
}

}  // namespace prohull::bench
