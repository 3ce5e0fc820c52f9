#include "construct/tight/tight_collapses.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "construct/edge_queue.h"
#include "construct/guard/self_intersection_guard.h"
#include "construct/placement.h"
#include "construct/shape_guards.h"
#include "construct/star.h"
#include "construct/tight/tight_placement.h"
#include "parallel/progress_meter.h"

namespace prohull {
namespace {

class TightCollapses {
 public:
  TightCollapses(HalfEdgeMesh& mesh, const Original& original, const HullOptions& options)
      : mesh_(mesh),
        options_(options),
        guard_(mesh, faces_along_curve(mesh)),
        placement_(original, options.float32_coordinates),
        queue_(mesh.edge_id_count()),
        edges_(mesh.edge_id_count()),
        changed_(mesh.positions().size(), 1),
        meter_(options.progress, "tighten"),
        excess_(mesh.face_count() - std::min(mesh.face_count(), options.target_faces)) {}

  void run() {
    if (mesh_.face_count() <= options_.target_faces) return;
    queue_all();
    while (mesh_.face_count() > options_.target_faces && !queue_.empty()) {
      meter_.at(excess_ - (mesh_.face_count() - options_.target_faces), excess_);
      const EdgeId e = queue_.pop();
      const HalfEdgeId h = mesh_.half_edge(e);
      const bool is_fresh = edges_[e].evaluated >= std::max(changed_[mesh_.tail(h)], changed_[mesh_.tip(h)]);
      const auto to = place(e);
      edges_[e] = {.evaluated = time_, .is_refused = !to};
      if (!to) continue;
      const double priority = std::max(0.0, added_volume(star_, star_.to_local(*to)));
      if (is_fresh || queue_.precedes_all(priority))
        collapse(e, *to);
      else
        queue_.insert(e, priority);
    }
  }

 private:
  struct EdgeState {
    std::uint32_t evaluated = 0;
    bool is_refused = false;  ///< and not queued before its star changes
  };

  // First priorities are estimated, from what the collapse would add if it had to enclose the hull: a third of the
  // placements.
  void queue_all() {
    constexpr double kLikelyPart = 0.4;
    for (std::uint32_t i = 0; i < mesh_.edge_id_count(); ++i) {
      meter_.at(0);
      const EdgeId e{i};
      if (!mesh_.has(e)) continue;
      const auto outside = place_outside_of_star(e);
      edges_[e].is_refused = !outside;
      if (outside) queue_.insert(e, kLikelyPart * outside->added_volume);
    }
  }

  std::optional<Placement> place_outside_of_star(EdgeId e) {
    gather_star(mesh_, e, star_);
    if (!satisfies_link_condition(star_) || star_.valence() > options_.guards.max_valence) return std::nullopt;
    measure_star(mesh_, star_);
    return place_outside(star_, placement_margin(star_, placement_.rounding()));
  }

  // Where the new vertex goes, if it may.
  std::optional<Vec3> place(EdgeId e) {
    const auto outside = place_outside_of_star(e);
    if (!outside) return std::nullopt;
    std::optional<Vec3> flat;
    const bool is_flat = any_flat_end(mesh_, star_, *outside, [&](const Vec3& end, const Vec3& local) {
      if (placement_.as_stored(end) != end) return false;
      flat = end;
      return !refused_shape(star_, local, options_) && !guard_.would_add_intersections(mesh_, star_, end);
    });
    if (is_flat) return flat;
    if (flat) return std::nullopt;  // any other apex would move flat parts by the margin
    const Vec3 from = placement_.as_stored(star_.to_input(outside->local));
    if (!is_finite(from) || !is_outside(mesh_, star_, from)) return std::nullopt;
    placement_.set(from, mesh_, star_.link);
    const auto is_accepted = [&](const Vec3& to) {
      return !refused_shape(star_, star_.to_local(to), options_) && !guard_.would_add_intersections(mesh_, star_, to);
    };
    if (const auto to = placement_.first(is_accepted)) return to;
    return is_accepted(from) ? std::optional(from) : std::nullopt;
  }

  void collapse(EdgeId e, const Vec3& to) {
    const HalfEdgeId h = mesh_.half_edge(e);
    for (const HalfEdgeId gone : {mesh_.next(h), mesh_.next(mesh_.twin(h))})
      if (queue_.contains(mesh_.edge(gone))) queue_.erase(mesh_.edge(gone));
    const VertexId s = changed_.push_back(++time_);
    mesh_.collapse(h, to);
    guard_.changed(mesh_, s);
    mark_changed(s);
    for (const VertexId v : star_.link) mark_changed(v);
  }

  // Edges that were refused get another turn, others are placed anew when theirs comes.
  void mark_changed(VertexId v) {
    changed_[v] = time_;
    for (const HalfEdgeId h : mesh_.around(v))
      if (const EdgeId e = mesh_.edge(h); std::exchange(edges_[e].is_refused, false)) queue_.insert(e, 0);
  }

  HalfEdgeMesh& mesh_;
  const HullOptions& options_;
  SelfIntersectionGuard guard_;
  TightPlacement placement_;
  Star star_;
  EdgeHeap queue_;
  PerEdge<EdgeState> edges_;
  PerVertex<std::uint32_t> changed_;  ///< when a face around it last did
  std::uint32_t time_ = 1;
  ProgressMeter meter_;
  const std::size_t excess_;  ///< faces above the target, at first
};

}  // namespace

void collapse_tightly(HalfEdgeMesh& hull, const Original& original, const HullOptions& options) {
  TightCollapses(hull, original, options).run();
}

}  // namespace prohull
