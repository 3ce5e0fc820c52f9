#include "construct/tight/tight_collapses.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "construct/edge_queue.h"
#include "construct/guard/self_intersection_guard.h"
#include "construct/placement.h"
#include "construct/shape_guards.h"
#include "construct/star.h"
#include "construct/tight/tight_placement.h"
#include "parallel/arena.h"
#include "prohull/detail/progress_meter.h"

namespace prohull {
namespace {

/// What is known of an edge.
struct EdgeState {
  enum class Known { Nothing, LeastPriority, Place } known = Known::Nothing;
  std::uint32_t evaluated = 0;
  double priority = 0;  ///< the volume that a collapse adds, or adds at least
  Vec3 to;              ///< its place
  bool is_refused = false;
  std::vector<Vec3> found = {};  ///< of the original, what was in the way
};

/// Finds where the new vertices of collapses may go; one for each thread.
class CollapsePlacer {
 public:
  CollapsePlacer(const HalfEdgeMesh& mesh, const Original& original, const HullOptions& options)
      : mesh_(mesh),
        options_(options),
        allowed_(original.allowed(options.guards.max_overhang)),
        placement_(original, options.float32_coordinates) {}

  std::optional<Placement> place_outside_of_star(EdgeId e) {
    gather_star(mesh_, e, star_);
    if (!satisfies_link_condition(star_) || star_.valence() > options_.guards.max_valence) return std::nullopt;
    measure_star(mesh_, star_);
    return place_outside(star_, placement_margin(star_, placement_.rounding()));
  }
  const Star& star() const { return star_; }  ///< of the edge in hand

  /// An edge is placed only if by what is known none of those that wait precedes it.
  void evaluate(EdgeId e, EdgeState& state, const Contacts& contacts, double least_waiting) {
    if (state.known == EdgeState::Known::Place) return;
    const auto outside = place_outside_of_star(e);
    state.is_refused = !outside;
    if (!outside) return;
    start_from(*outside, contacts);
    if (state.known == EdgeState::Known::Nothing) {
      state.priority = least_volume(*outside);
      state.known = EdgeState::Known::LeastPriority;
      if (state.priority > least_waiting) return;
    }
    place(*outside, state, [](const Vec3&) { return true; });
  }

  void start_from(const Placement& outside, const Contacts& contacts) {
    placement_.set(stored(outside), mesh_, star_.link);
    contacts.gather(star_.o, star_.link, known_);
    placement_.know(known_);
  }

  /// After start_from.
  template <class IsFree>
  void place(const Placement& outside, EdgeState& state, IsFree&& is_free) {
    Box allowed = allowed_;
    for (const VertexId v : {star_.o, star_.d}) allowed.extend(mesh_.position(v));
    const auto to = place_of(outside, [&](const Vec3& p) {
      return allowed.contains(p) && !refused_shape(star_, star_.to_local(p), options_) && is_free(p);
    });
    state.found = placement_.found();
    state.is_refused = !to;
    if (!to) return;
    state.known = EdgeState::Known::Place, state.to = *to;
    state.priority = std::max(0.0, added_volume(star_, star_.to_local(*to)));
  }

 private:
  Vec3 stored(const Placement& outside) const { return placement_.as_stored(star_.to_input(outside.local)); }

  /// What the collapse adds if only known points are in the way.
  double least_volume(const Placement& outside) {
    const auto to = placement_.guess();
    return std::max(0.0, to ? added_volume(star_, star_.to_local(*to)) : outside.added_volume);
  }

  template <class IsAccepted>
  std::optional<Vec3> place_of(const Placement& outside, IsAccepted&& is_accepted) {
    std::optional<Vec3> flat;
    const bool is_flat = any_flat_end(mesh_, star_, outside, [&](const Vec3& end, const Vec3&) {
      if (placement_.as_stored(end) != end) return false;
      flat = end;
      return is_accepted(end);
    });
    if (is_flat) return flat;
    if (flat) return std::nullopt;  // any other apex would move flat parts by the margin
    const Vec3 from = stored(outside);
    if (!is_finite(from) || !is_outside(mesh_, star_, from)) return std::nullopt;
    if (const auto to = placement_.first(is_accepted)) return to;
    return is_accepted(from) && placement_.keeps_padding(from) ? std::optional(from) : std::nullopt;
  }

  const HalfEdgeMesh& mesh_;
  const HullOptions& options_;
  const Box allowed_;  ///< all vertices that do not hang over by more already
  TightPlacement placement_;
  Star star_;
  std::vector<Vec3> known_;
};

class TightCollapses {
 public:
  TightCollapses(HalfEdgeMesh& mesh, const Original& original, const HullOptions& options, Contacts& contacts)
      : mesh_(mesh),
        options_(options),
        contacts_(contacts),
        guard_(mesh, faces_along_curve(mesh)),
        placers_([&] { return CollapsePlacer(mesh, original, options); }),
        placer_(mesh, original, options),
        queue_(mesh.edge_id_count()),
        edges_(mesh.edge_id_count()),
        changed_(mesh.positions().size(), 1),
        batch_(mesh.positions().size(), 0),
        meter_(options.progress, "tighten"),
        excess_(mesh.face_count() - std::min(mesh.face_count(), options.target_faces)) {}

  // Edges at the front of the queue whose stars are apart are evaluated at the same time. Of those that are placed, all
  // are collapsed that no waiting edge may precede.
  void run() {
    if (mesh_.face_count() <= options_.target_faces) return;
    queue_all();
    while (mesh_.face_count() > options_.target_faces && !queue_.empty()) {
      meter_.at(excess_ - (mesh_.face_count() - options_.target_faces), excess_);
      std::vector<EdgeId> edges = take_independent();
      const double least_waiting = queue_.least();
      oneapi::tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t i) {
        placers_.local().evaluate(edges[i], edges_[edges[i]], contacts_, least_waiting);
      });
      std::ranges::stable_sort(edges, {}, [&](EdgeId e) { return edges_[e].priority; });
      double least = least_waiting;
      for (const EdgeId e : edges) least = std::min(least, apply(e, least));
    }
  }

 private:
  // First priorities are estimated, from what the collapse would add if it had to enclose the hull: a third of the
  // placements.
  void queue_all() {
    constexpr double kLikelyPart = 0.4;
    oneapi::tbb::parallel_for(std::size_t{0}, edges_.size(), [&](std::size_t i) {
      const EdgeId e{static_cast<std::uint32_t>(i)};
      meter_.go_on();
      if (!mesh_.has(e)) return;
      const auto outside = placers_.local().place_outside_of_star(e);
      edges_[e].is_refused = !outside;
      if (outside) edges_[e].priority = kLikelyPart * outside->added_volume;
    });
    for (const EdgeId e : edges_.ids())
      if (mesh_.has(e) && !edges_[e].is_refused) queue_.insert(e, edges_[e].priority);
  }

  // What is known of an edge is forgotten if its star has changed.
  std::vector<EdgeId> take_independent() {
    constexpr std::size_t kMost = 16;
    ++batches_;
    std::vector<EdgeId> taken;
    std::vector<std::pair<EdgeId, double>> left;
    while (taken.size() < kMost && left.size() < kMost && !queue_.empty()) {
      const double priority = queue_.least();
      const EdgeId e = queue_.pop();
      if (any_in_star(e, [&](VertexId v) { return batch_[v] == batches_; })) {
        left.emplace_back(e, priority);
        continue;
      }
      any_in_star(e, [&](VertexId v) { return batch_[v] = batches_, false; });
      taken.push_back(e);
      EdgeState& state = edges_[e];
      const HalfEdgeId h = mesh_.half_edge(e);
      if (state.evaluated < std::max(changed_[mesh_.tail(h)], changed_[mesh_.tip(h)]))
        state.known = EdgeState::Known::Nothing;
      state.evaluated = time_;
    }
    for (const auto& [e, priority] : left) queue_.insert(e, priority);
    return taken;
  }

  template <class Is>
  bool any_in_star(EdgeId e, Is&& is) const {
    const HalfEdgeId h = mesh_.half_edge(e);
    for (const VertexId end : {mesh_.tail(h), mesh_.tip(h)}) {
      if (is(end)) return true;
      for (const HalfEdgeId g : mesh_.around(end))
        if (is(mesh_.tip(g))) return true;
    }
    return false;
  }

  // Collapses the edge, queues it again, or leaves it; returns from what priority on others have to wait.
  double apply(EdgeId e, double least_waiting) {
    constexpr double kNobodyWaits = std::numeric_limits<double>::infinity();
    EdgeState& state = edges_[e];
    const auto found = std::exchange(state.found, {});
    if (!found.empty()) contacts_.keep(mesh_.tail(mesh_.half_edge(e)), found);
    if (state.is_refused) return kNobodyWaits;
    if (mesh_.face_count() <= options_.target_faces) return kNobodyWaits;
    if (state.known != EdgeState::Known::Place || state.priority > least_waiting) {
      queue_.insert(e, state.priority);
      return state.priority;
    }
    const auto outside = placer_.place_outside_of_star(e);
    const auto is_free = [&](const Vec3& p) { return !guard_.would_add_intersections(mesh_, placer_.star(), p); };
    if (outside && is_free(state.to)) {
      collapse(e, state.to);
      return kNobodyWaits;
    }
    if (outside) placer_.start_from(*outside, contacts_), placer_.place(*outside, state, is_free);
    state.is_refused = state.is_refused || !outside;
    if (!state.is_refused) queue_.insert(e, state.priority);
    return kNobodyWaits;
  }

  void collapse(EdgeId e, const Vec3& to) {
    const HalfEdgeId h = mesh_.half_edge(e);
    for (const HalfEdgeId gone : {mesh_.next(h), mesh_.next(mesh_.twin(h))})
      if (queue_.contains(mesh_.edge(gone))) queue_.erase(mesh_.edge(gone));
    const VertexId s = changed_.push_back(++time_);
    batch_.push_back(0);
    const Star& star = placer_.star();
    contacts_.join(star.o, star.d);
    guard_.collapsed(mesh_, mesh_.collapse(h, to));
    mark_changed(s);
    for (const VertexId v : star.link) mark_changed(v);
  }

  // Edges that were refused get another turn, others are placed anew when theirs comes.
  void mark_changed(VertexId v) {
    changed_[v] = time_;
    for (const HalfEdgeId h : mesh_.around(v))
      if (const EdgeId e = mesh_.edge(h); std::exchange(edges_[e].is_refused, false)) queue_.insert(e, 0);
  }

  HalfEdgeMesh& mesh_;
  const HullOptions& options_;
  Contacts& contacts_;
  SelfIntersectionGuard guard_;
  oneapi::tbb::enumerable_thread_specific<CollapsePlacer> placers_;
  CollapsePlacer placer_;
  EdgeHeap queue_;
  PerEdge<EdgeState> edges_;
  PerVertex<std::uint32_t> changed_;  ///< when a face around it last did
  std::uint32_t time_ = 1;
  PerVertex<std::uint32_t> batch_;  ///< the last one in which it was in a star
  std::uint32_t batches_ = 0;
  ProgressMeter meter_;
  const std::size_t excess_;  ///< faces above the target, at first
};

}  // namespace

void collapse_tightly(HalfEdgeMesh& hull, const Original& original, const HullOptions& options, Contacts& contacts) {
  arena_of(options.threads).execute([&] { TightCollapses(hull, original, options, contacts).run(); });
}

}  // namespace prohull
