#include "construct/progressive/collapse_loop.h"

#include <array>
#include <cmath>
#include <random>
#include <span>

#include "construct/edge_queue.h"
#include "construct/guard/self_intersection_guard.h"
#include "construct/placement.h"
#include "construct/progressive/mirrored_collapse.h"
#include "construct/shape_guards.h"
#include "construct/star.h"
#include "geometry/float32.h"

namespace prohull {
namespace {

/// Makes priorities greater by up to 5 %.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : is_on_(seed != 0), random_(seed) {}

  double operator()(double priority) {
    return is_on_ ? priority * (1 + 0.05 * 0x1p-64 * static_cast<double>(random_())) : priority;
  }

 private:
  bool is_on_;
  std::mt19937_64 random_;
};

/// Not in the paper: of two collapses that add the same volume, that with more faces to spread it over goes first.
/// 1 % less void than by the volume alone (docs/performance.md).
double lazy_priority(double added_volume, std::size_t valence) {
  return added_volume / std::sqrt(static_cast<double>(valence));
}

/// None of its edges can be collapsed before it has lost faces, and there are too many to look at them before.
bool is_hub(const HalfEdgeMesh& mesh, VertexId v, const HullOptions& options) {
  constexpr unsigned kMany = 64;
  return mesh.valence(v) > std::max(kMany, options.guards.max_valence) + 1;
}

std::vector<FaceId> all_faces(const HalfEdgeMesh& mesh) {
  std::vector<FaceId> faces;
  faces.reserve(mesh.face_id_count());
  for (std::uint32_t i = 0; i < mesh.face_id_count(); ++i) faces.push_back(FaceId{i});
  return faces;
}

template <class Queue>
class CollapseLoop {
 public:
  CollapseLoop(Patch& patch, const CollapseRules& rules)
      : patch_(patch),
        rules_(rules),
        options_(rules.options),
        mesh_(patch.mesh),
        edges_(patch.edges),
        vertices_(patch.vertices),
        queue_(mesh_.edge_id_count()),
        noise_(patch.seed) {
    if (options_.refuses_self_intersections()) guard_.emplace(mesh_, all_faces(mesh_));
    if (!patch.tolerances.empty()) tolerance_guard_.emplace(patch.tolerances);
    if (rules.mirror) mirrored_.emplace(mesh_, patch.images, *rules.mirror);
  }

  void run() {
    queue_all();
    while (mesh_.face_count() > patch_.target_faces && !queue_.empty()) {
      tell();
      const EdgeId edge = queue_.pop();
      if (ends_at_hub(edge)) {
        refuse(edge, Refusal::Valence);
        continue;
      }
      gather(edge);
      if (!is_free_to_change(star_.link)) continue;
      if (const auto why = refusal_of_topology()) {  // 3.1.4: link condition, valence
        refuse(edge, *why);
        continue;
      }
      measure_star(mesh_, star_);
      const auto placement = place();  // 3.1.2, linear program
      if (!placement) {
        refuse(edge, Refusal::NoRoomOutside);
        continue;
      }
      if (comes_too_early(edge, *placement)) continue;
      Vec3 apex;
      if (const auto why = refusal_of_apex(*placement, apex)) {  // exact certificate; 3.1.4: shape
        refuse(edge, *why);
        continue;
      }
      if (!patch_.inside.has_inside(rules_.unit_cube.at(apex))) continue;
      for (const VertexId s : collapse(edge, apex))
        if (options_.strategy == Strategy::Lazy)
          mark_changed_around(s);
        else
          reevaluate_around(s);  // Figure 3
    }
  }

 private:
  void queue_all() {
    for (std::uint32_t i = 0; i < mesh_.edge_id_count(); ++i) {
      tell();
      const EdgeId edge{i};
      const VertexId v = mesh_.tail(mesh_.half_edge(edge)), w = mesh_.tip(mesh_.half_edge(edge));
      if (!vertices_[v].may_go() || !vertices_[w].may_go()) continue;
      if (options_.strategy != Strategy::Lazy) {
        evaluate_and_queue(edge);
      } else if (!edges_[edge].is_refused || !is_fresh(edge, v, w)) {
        edges_[edge].is_refused = false;
        enqueue(edge);
      } else {
        vertices_[v].has_refused = vertices_[w].has_refused = true;
      }
    }
  }

  void enqueue(EdgeId edge) {
    if (edges_[edge].priority <= patch_.max_priority) queue_.insert(edge, edges_[edge].priority);
  }

  bool is_free_to_change(const std::vector<VertexId>& link) const {
    return std::ranges::all_of(link, [&](VertexId v) { return vertices_[v].is_free; });
  }

  // Known before the star is looked at, which may have a million faces.
  bool ends_at_hub(EdgeId edge) const {
    const HalfEdgeId h = mesh_.half_edge(edge);
    return is_hub(mesh_, mesh_.tail(h), options_) || is_hub(mesh_, mesh_.tip(h), options_);
  }

  void gather(EdgeId edge) {
    gather_star(mesh_, edge, star_);
    patch_.visited_faces += star_.valence();
  }

  std::optional<Refusal> refusal_of_topology() {
    if (!satisfies_link_condition(star_)) return Refusal::LinkCondition;
    if (mirrored_ && !mirrored_->look_at(star_)) return Refusal::Symmetry;
    if (valence() > options_.guards.max_valence) return Refusal::Valence;
    return std::nullopt;
  }

  std::size_t valence() const { return mirrored_ ? mirrored_->valence() : star_.valence(); }

  std::optional<Placement> place() {
    ++patch_.linear_programs;
    const double margin = placement_margin(star_, rules_.rounding);
    return mirrored_ ? mirrored_->place(star_, margin) : place_outside(star_, margin);
  }

  std::optional<Vec3> as_stored(const Vec3& p) const {
    if (mirrored_) return mirrored_->as_stored(star_, p, options_.float32_coordinates);
    return options_.float32_coordinates ? nearest_float32(p) : p;
  }

  bool is_fresh(EdgeId edge, VertexId v, VertexId w) const {
    return edges_[edge].evaluated >= std::max(vertices_[v].changed, vertices_[w].changed);
  }

  void set_priority(EdgeId edge, double priority) {
    edges_[edge].priority = noise_(priority);
    edges_[edge].evaluated = patch_.time;
    if (const EdgeId image = image_of(edge); image != edge) {
      edges_[image].priority = edges_[edge].priority;
      edges_[image].evaluated = patch_.time;
    }
  }

  // What is decided of an edge holds for its image too, which need not be asked again.
  EdgeId image_of(EdgeId edge) const { return mirrored_ ? mirrored_->image(edge) : edge; }

  // Lazy only: the priority of an edge whose star has changed is found now, and may send it back into the queue.
  bool comes_too_early(EdgeId edge, const Placement& placement) {
    if (is_fresh(edge, star_.o, star_.d)) return false;
    set_priority(edge, lazy_priority(placement.added_volume, valence()));
    if (edges_[edge].priority <= patch_.max_priority && queue_.precedes_all(edges_[edge].priority)) return false;
    enqueue(edge);
    if (const EdgeId image = image_of(edge); queue_.contains(image) && image != edge) unqueue(image), enqueue(image);
    return true;
  }

  // Where it would go, or why it may not. An end of the edge that adds nothing at all is preferred (not in the paper);
  // where the shape guards refuse it for now, so is the edge: any other apex would move flat parts by the margin.
  std::optional<Refusal> refusal_of_apex(const Placement& placement, Vec3& apex) {
    if (options_.strategy == Strategy::Lazy) {
      std::optional<Refusal> why;
      const auto is_accepted = [&](const Vec3& point, const Vec3& local) {
        apex = point;
        why = refusal_of_shape(local);
        return !why && as_stored(point) == point && !would_exceed_tolerance(local) && !would_add_intersections(point);
      };
      const bool is_flat = mirrored_ ? mirrored_->any_flat_point(star_, placement, is_accepted)
                                     : any_flat_end(mesh_, star_, placement, is_accepted);
      if (is_flat || why) return why;
    }
    const auto stored = as_stored(star_.to_input(placement.local));
    if (!stored) return Refusal::Symmetry;
    apex = *stored;
    if (hangs_over(apex)) return Refusal::Overhang;
    if (const auto why = refusal_of_shape(placement.local)) return why;
    if (!is_finite(apex) || !is_outside(mesh_, star_, apex)) return Refusal::Certificate;
    if (rules_.may_reach && !rules_.may_reach(apex)) return Refusal::Overhang;
    if (would_exceed_tolerance(star_.to_local(apex))) return Refusal::Tolerance;
    if (would_add_intersections(apex)) return Refusal::SelfIntersection;
    return std::nullopt;
  }

  std::optional<Refusal> refusal_of_shape(const Vec3& local) const {
    return mirrored_ ? mirrored_->refused_shape(star_, local, options_) : refused_shape(star_, local, options_);
  }

  bool would_add_intersections(const Vec3& apex) {
    if (!guard_) return false;
    return mirrored_ ? mirrored_->would_add_intersections(*guard_, star_, apex)
                     : guard_->would_add_intersections(mesh_, star_, apex);
  }

  bool would_exceed_tolerance(const Vec3& local) {
    return tolerance_guard_ && tolerance_guard_->would_exceed(mesh_, star_, local);
  }

  bool hangs_over(const Vec3& p) const {
    const Box& box = rules_.box;
    const double reach = options_.guards.max_overhang * box.diagonal();
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] < box.min[axis] - reach || p[axis] > box.max[axis] + reach) return true;
    return false;
  }

  void refuse(EdgeId edge, Refusal why) {
    patch_.refusals.count(why);
    mark_refused(edge, why);
    if (const EdgeId image = image_of(edge); image != edge) {
      unqueue(image);
      mark_refused(image, why);
    }
  }

  void mark_refused(EdgeId edge, Refusal why) {
    edges_[edge].last_refusal = why;
    edges_[edge].is_refused = true;
    edges_[edge].evaluated = patch_.time;
    const HalfEdgeId h = mesh_.half_edge(edge);
    vertices_[mesh_.tail(h)].has_refused = vertices_[mesh_.tip(h)].has_refused = true;
  }

  /// The new vertices: that of the star's edge, and that of its image.
  std::span<const VertexId> collapse(EdgeId edge, const Vec3& apex) {
    const double priority = edges_[edge].priority;
    made_ = {collapse(star_.edge, apex, priority)};
    if (!mirrored_ || !mirrored_->has_second()) return std::span(made_).first(1);
    const HalfEdgeId second = mirrored_->second();
    unqueue(mesh_.edge(second));
    made_[1] = collapse(second, mirrored_->second_apex(apex), priority);
    return std::span(made_).subspan(mirrored_->are_joined() ? 1 : 0);
  }

  VertexId collapse(HalfEdgeId h, const Vec3& apex, double priority) {
    // The edges d-l and o-r merge into o-l and d-r.
    unqueue(mesh_.edge(mesh_.next(h)));
    unqueue(mesh_.edge(mesh_.next(mesh_.twin(h))));
    const double last_priority = patch_.priorities.empty() ? 0 : patch_.priorities.back();
    patch_.priorities.push_back(std::max(last_priority, priority));
    const bool has_refused = vertices_[mesh_.tail(h)].has_refused || vertices_[mesh_.tip(h)].has_refused;
    const VertexId s = mesh_.positions().next_id();
    patch_.record.push_back(mesh_.collapse(h, apex));
    ++patch_.time;
    vertices_.push_back({.changed = patch_.time, .has_refused = has_refused});
    if (guard_) guard_->collapsed(mesh_, patch_.record.back());
    if (tolerance_guard_) tolerance_guard_->collapsed();
    return s;
  }

  // The edges whose star has changed are those with an end on s or its link. Lazy: they are evaluated when their turn
  // comes; those that were refused get another.
  void mark_changed_around(VertexId s) {
    mark_changed(s);
    for (const HalfEdgeId h : mesh_.around(s)) mark_changed(mesh_.tip(h));
  }

  void mark_changed(VertexId v) {
    vertices_[v].changed = patch_.time;
    if (!vertices_[v].has_refused || is_hub(mesh_, v, options_)) return;
    vertices_[v].has_refused = false;
    for (const HalfEdgeId h : mesh_.around(v)) {
      const EdgeId edge = mesh_.edge(h);
      if (!edges_[edge].is_refused || !vertices_[mesh_.tip(h)].is_free) continue;
      edges_[edge].is_refused = false;
      enqueue(edge);
    }
  }

  void reevaluate_around(VertexId s) {
    visit_edges_around(mesh_, s, [this](EdgeId edge) { reevaluate(edge); });
  }

  void unqueue(EdgeId edge) {
    if (queue_.contains(edge)) queue_.erase(edge);
  }

  void reevaluate(EdgeId edge) {
    unqueue(edge);
    evaluate_and_queue(edge);
  }

  void evaluate_and_queue(EdgeId edge) {
    const HalfEdgeId h = mesh_.half_edge(edge);
    if (vertices_[mesh_.tail(h)].is_kept || vertices_[mesh_.tip(h)].is_kept) return;
    if (ends_at_hub(edge)) return refuse(edge, Refusal::Valence);
    gather(edge);
    if (const auto why = refusal_of_topology()) return refuse(edge, *why);
    measure_star(mesh_, star_);
    if (options_.strategy == Strategy::Paper2) {
      set_priority(edge, link_center_volume(star_));
    } else {
      const auto placement = place();
      if (!placement) return refuse(edge, Refusal::NoRoomOutside);
      set_priority(edge, placement->added_volume);
    }
    edges_[edge].is_refused = false;
    enqueue(edge);
  }

  void tell() {
    constexpr std::size_t kInterval = 1024;
    if (++steps_ % kInterval == 0) rules_.tell(2 * (patch_.record.size() - std::exchange(told_, patch_.record.size())));
  }

  Patch& patch_;
  const CollapseRules& rules_;
  const HullOptions& options_;
  HalfEdgeMesh& mesh_;
  PerEdge<EdgeFacts>& edges_;
  PerVertex<VertexFacts>& vertices_;
  Queue queue_;
  Noise noise_;
  std::optional<SelfIntersectionGuard> guard_;
  std::optional<ToleranceGuard> tolerance_guard_;
  std::optional<MirroredCollapse> mirrored_;
  std::array<VertexId, 2> made_{};
  Star star_;
  std::size_t steps_ = 0, told_ = 0;
};

}  // namespace

void estimate_priorities(Patch& patch, const CollapseRules& rules) {
  if (rules.options.strategy != Strategy::Lazy) return;
  Star star;
  Noise noise(patch.seed == 0 ? 0 : patch.seed + 1);
  for (const EdgeId edge : patch.edges.ids()) {
    if (index(edge) % 1024 == 0) rules.tell(0);
    if (patch.edges[edge].priority != EdgeFacts::kUnknown) continue;
    const HalfEdgeId h = patch.mesh.half_edge(edge);
    const VertexId v = patch.mesh.tail(h), w = patch.mesh.tip(h);
    if (!patch.vertices[v].may_go() || !patch.vertices[w].may_go()) continue;
    if (is_hub(patch.mesh, v, rules.options) || is_hub(patch.mesh, w, rules.options)) {
      patch.edges[edge].priority = 0;  // refused at once
      continue;
    }
    gather_star(patch.mesh, edge, star);
    patch.visited_faces += star.valence();
    patch.edges[edge].priority = noise(lazy_priority(estimated_volume(patch.mesh, star), star.valence()));
  }
}

void run_collapse_loop(Patch& patch, const CollapseRules& rules) {
  switch (rules.options.queue) {
    case QueueKind::Bucket:
      return CollapseLoop<EdgeBuckets>(patch, rules).run();
    case QueueKind::Heap:
      return CollapseLoop<EdgeHeap>(patch, rules).run();
    default:
      return CollapseLoop<EdgeTree>(patch, rules).run();
  }
}

}  // namespace prohull
