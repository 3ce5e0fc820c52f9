#include "prohull/hull_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "build/edge_queue.h"
#include "build/placement.h"
#include "build/self_intersection_guard.h"
#include "build/shape_guards.h"
#include "build/spatial_order.h"
#include "build/star.h"
#include "build/turned.h"
#include "geometry/float32.h"
#include "prohull/error.h"
#include "prohull/mesh_report.h"

namespace prohull {
namespace {

// What is known of an edge between its visits. Times count the collapses, from 1.
struct EdgeFacts {
  double key = 0;
  std::uint32_t evaluated = 0;  ///< when the key was that of the star
  Refusal last_refusal = Refusal::LinkCondition;
};

struct VertexFacts {
  std::uint32_t changed = 1;  ///< when a face around it last did
  bool has_refused = false;   ///< an edge that ends here may be out of the queue
};

double largest_coordinate(const Box& box) {
  return std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.min.z), std::abs(box.max.x),
                   std::abs(box.max.y), std::abs(box.max.z)});
}

template <class Queue>
class HullBuilder {
 public:
  HullBuilder(const TriangleMesh& mesh, const HullOptions& options)
      : options_(options),
        original_vertices_(mesh.vertex_count()),
        order_(mesh),
        mesh_(order_.reordered(mesh)),
        queue_(mesh_.edge_id_count()),
        edges_(mesh_.edge_id_count()),
        vertices_(mesh.vertex_count()),
        rounding_(largest_coordinate(bounding_box(mesh)) * (options.float32_coordinates ? 0x1p-23 : 0x1p-52)) {
    if (!options.allow_self_intersections || options.side == HullSide::Inner) guard_.emplace(mesh_);
  }

  HullResult run() {
    queue_all();
    while (mesh_.face_count() > options_.target_faces && !queue_.empty() && !cancelled()) {
      const EdgeId edge = queue_.pop();
      prefetch_upcoming();
      gather_star(mesh_, edge, star_);
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
      const VertexId s = collapse(apex);
      if (options_.strategy == Strategy::Lazy)
        mark_changed_around(s);
      else
        reevaluate_around(s);  // Figure 3
    }
    return result();
  }

 private:
  void queue_all() {
    for (std::uint32_t i = 0; i < mesh_.edge_id_count() && !cancelled(); ++i)
      options_.strategy == Strategy::Lazy ? estimate_and_queue(EdgeId{i}) : evaluate_and_queue(EdgeId{i});
  }

  // Lazy only: instead of a linear program for every edge of the input.
  void estimate_and_queue(EdgeId edge) {
    gather_star(mesh_, edge, star_);
    edges_[edge].key = estimated_volume(mesh_, star_);
    queue_.insert(edge, edges_[edge].key);
  }

  // Edges that follow each other in the queue lie anywhere in the mesh: what is known of them comes into the cache in
  // steps, as each is needed to find the next.
  void prefetch_upcoming() {
    if constexpr (ForeseesEdges<Queue>) {
      if (queue_.empty()) return;
      const auto half_edge = [&](std::size_t skipped) { return mesh_.half_edge(queue_.upcoming(skipped)); };
      const EdgeId far = queue_.upcoming(20);
      queue_.prefetch(far);
      mesh_.prefetch(far);
      __builtin_prefetch(&edges_[far]);
      if (const HalfEdgeId h = half_edge(16); h != kNoHalfEdge) mesh_.prefetch(h);
      if (const HalfEdgeId h = half_edge(12); h != kNoHalfEdge) prefetch_end(h), mesh_.prefetch(mesh_.twin(h));
      if (const HalfEdgeId h = half_edge(8); h != kNoHalfEdge) prefetch_end(mesh_.twin(h)), prefetch_faces<0>(h);
      if (const HalfEdgeId h = half_edge(5); h != kNoHalfEdge) prefetch_faces<1>(h);
      if (const HalfEdgeId h = half_edge(2); h != kNoHalfEdge) prefetch_faces<2>(h);
    }
  }

  void prefetch_end(HalfEdgeId h) {
    mesh_.prefetch(mesh_.tail(h));
    __builtin_prefetch(&vertices_[mesh_.tail(h)]);
  }

  // The faces `distance` away from the edge's own, around either end, on either side; and the last corners on the way.
  template <int distance>
  void prefetch_faces(HalfEdgeId h) {
    for (const HalfEdgeId side : {h, mesh_.twin(h)}) {
      HalfEdgeId around_tail = side, around_tip = mesh_.next(side);  // towards and away from the link
      for (int i = 0; i < distance; ++i) {
        around_tail = mesh_.rotated(around_tail);
        around_tip = mesh_.next(mesh_.twin(around_tip));
      }
      mesh_.prefetch(mesh_.tip(around_tail)), mesh_.prefetch(mesh_.tip(around_tip));
      mesh_.prefetch(mesh_.rotated(around_tail)), mesh_.prefetch(mesh_.twin(around_tip));
    }
  }

  std::optional<Refusal> refusal_of_topology() const {
    if (!satisfies_link_condition(star_)) return Refusal::LinkCondition;
    if (star_.valence() > options_.max_valence) return Refusal::Valence;
    return std::nullopt;
  }

  std::optional<Placement> place() {
    ++linear_programs_;
    return place_outside(star_, placement_margin(star_, rounding_));
  }

  Vec3 as_stored(const Vec3& p) const { return options_.float32_coordinates ? nearest_float32(p) : p; }

  std::uint32_t now() const { return static_cast<std::uint32_t>(record_.size() + 1); }

  bool is_fresh(EdgeId edge) const {
    return edges_[edge].evaluated >= std::max(vertices_[star_.o].changed, vertices_[star_.d].changed);
  }

  void set_key(EdgeId edge, double key) {
    edges_[edge].key = key;
    edges_[edge].evaluated = now();
  }

  // Lazy only: the key of an edge whose star has changed is found now, and may send it back into the queue.
  bool comes_too_early(EdgeId edge, const Placement& placement) {
    if (is_fresh(edge)) return false;
    set_key(edge, placement.added_volume);
    if (queue_.precedes_all(placement.added_volume)) return false;
    queue_.insert(edge, placement.added_volume);
    return true;
  }

  // Where it would go, or why it may not. An end of the edge that adds nothing at all is preferred (not in the paper);
  // where the guards refuse it for now, so is the edge: any other apex would move flat parts by the margin.
  std::optional<Refusal> refusal_of_apex(const Placement& placement, Vec3& apex) {
    constexpr double kFlat = 1e-7;  // of the star's cube; only saves exact tests where they cannot succeed
    if (options_.strategy == Strategy::Lazy &&
        placement.added_volume <= kFlat * star_.scale * star_.scale * star_.scale) {
      std::optional<Refusal> why;
      for (const VertexId end : {star_.o, star_.d}) {
        apex = mesh_.position(end);
        if (!lies_on_all_planes(mesh_, star_, apex)) continue;
        why = refused_shape(star_, end == star_.o ? star_.local_o : star_.local_d, options_);
        if (!why && as_stored(apex) == apex && !(guard_ && guard_->would_add_intersections(mesh_, star_, apex)))
          return std::nullopt;
      }
      if (why) return why;
    }
    if (const auto why = refused_shape(star_, placement.local, options_)) return why;
    apex = as_stored(star_.to_input(placement.local));
    if (!is_finite(apex) || !is_outside(mesh_, star_, apex)) return Refusal::Certificate;
    if (guard_ && guard_->would_add_intersections(mesh_, star_, apex)) return Refusal::SelfIntersection;
    return std::nullopt;
  }

  void refuse(EdgeId edge, Refusal why) {
    refused_.count(why);
    edges_[edge].last_refusal = why;
    vertices_[star_.o].has_refused = vertices_[star_.d].has_refused = true;
  }

  VertexId collapse(const Vec3& apex) {
    // The edges d-l and o-r merge into o-l and d-r.
    unqueue(mesh_.edge(mesh_.next(star_.edge)));
    unqueue(mesh_.edge(mesh_.next(mesh_.twin(star_.edge))));
    const VertexId s = mesh_.positions().next_id();
    record_.push_back(mesh_.collapse(star_.edge, apex));
    vertices_.push_back({now(), vertices_[star_.o].has_refused || vertices_[star_.d].has_refused});
    if (guard_) guard_->changed(mesh_, s);
    return s;
  }

  // The edges whose star has changed are those with an end on s or its link. Lazy: they are evaluated when their turn
  // comes; those that were refused get another.
  void mark_changed_around(VertexId s) {
    mark_changed(s);
    const HalfEdgeId first = mesh_.out(s);
    HalfEdgeId h = first;
    do {
      mark_changed(mesh_.tip(h));
      h = mesh_.rotated(h);
    } while (h != first);
  }

  void mark_changed(VertexId v) {
    vertices_[v].changed = now();
    if (!vertices_[v].has_refused) return;
    vertices_[v].has_refused = false;
    const HalfEdgeId first = mesh_.out(v);
    HalfEdgeId h = first;
    do {
      const EdgeId edge = mesh_.edge(h);
      if (!queue_.contains(edge)) queue_.insert(edge, edges_[edge].key);
      h = mesh_.rotated(h);
    } while (h != first);
  }

  // P&T Figure 3.
  void reevaluate_around(VertexId s) {
    const HalfEdgeId first = mesh_.out(s);
    HalfEdgeId h = first;
    do {
      const HalfEdgeId around = mesh_.twin(h);
      reevaluate(mesh_.edge(h));
      // Edges between two link vertices are met from both: the one beside s is left to its own tail.
      HalfEdgeId g = mesh_.rotated(around);
      reevaluate(mesh_.edge(g));
      for (g = mesh_.rotated(g); mesh_.rotated(g) != around; g = mesh_.rotated(g)) reevaluate(mesh_.edge(g));
      h = mesh_.rotated(h);
    } while (h != first);
  }

  void unqueue(EdgeId edge) {
    if (queue_.contains(edge)) queue_.erase(edge);
  }

  void reevaluate(EdgeId edge) {
    unqueue(edge);
    evaluate_and_queue(edge);
  }

  void evaluate_and_queue(EdgeId edge) {
    gather_star(mesh_, edge, star_);
    if (const auto why = refusal_of_topology()) return refuse(edge, *why);
    measure_star(mesh_, star_);
    if (options_.strategy == Strategy::Paper2) {
      set_key(edge, link_center_volume(star_));
    } else {
      const auto placement = place();
      if (!placement) return refuse(edge, Refusal::NoRoomOutside);
      set_key(edge, placement->added_volume);
    }
    queue_.insert(edge, edges_[edge].key);
  }

  bool cancelled() {
    constexpr std::size_t kInterval = 1024;
    if (!cancelled_ && options_.progress && ++steps_ % kInterval == 0)
      cancelled_ = !options_.progress({mesh_.face_count(), mesh_.face_id_count(), options_.target_faces});
    return cancelled_;
  }

  Stopped stopped() const {
    if (mesh_.face_count() <= options_.target_faces) return Stopped::TargetReached;
    return cancelled_ ? Stopped::Cancelled : Stopped::NoLegalCollapse;
  }

  HullResult result() {
    RefusalCounts blocked;
    for (std::uint32_t i = 0; i < mesh_.edge_id_count(); ++i)
      if (const EdgeId e{i}; mesh_.has(e) && !queue_.contains(e)) blocked.count(edges_[e].last_refusal);
    return {hull_as_numbered_in_the_input(), stopped(), refused_, blocked, linear_programs_};
  }

  ProgressiveHull hull_as_numbered_in_the_input() {
    std::vector<VertexId> corners(3 * mesh_.face_id_count());
    for (std::uint32_t c = 0; c < corners.size(); ++c)
      corners[order_.given_corner(c)] = order_.given(mesh_.tail(HalfEdgeId{c}));
    PerVertex<Vec3> positions(mesh_.positions().size());
    for (const VertexId v : positions.ids()) positions[order_.given(v)] = mesh_.position(v);
    for (auto& [o, d, l, r, od, do_] : record_) {
      o = order_.given(o), d = order_.given(d), l = order_.given(l), r = order_.given(r);
      od = order_.given_corner(od), do_ = order_.given_corner(do_);
    }
    return {options_.side, original_vertices_, std::move(positions), std::move(corners), std::move(record_)};
  }

  const HullOptions options_;
  const std::size_t original_vertices_;
  const SpatialOrder order_;
  HalfEdgeMesh mesh_;
  Queue queue_;
  PerEdge<EdgeFacts> edges_;
  PerVertex<VertexFacts> vertices_;
  std::optional<SelfIntersectionGuard> guard_;
  const double rounding_;  ///< the most by which storing moves a coordinate, with some room
  Star star_;
  std::vector<VertexSplit> record_;
  RefusalCounts refused_;
  std::size_t linear_programs_ = 0, steps_ = 0;
  bool cancelled_ = false;
};

void check(const HullOptions& options) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw InputError(Defect::InvalidOption, what);
  };
  require(options.target_faces >= 4, "target_faces must be at least 4, the faces of a tetrahedron");
  require(options.max_valence >= 3, "max_valence must be at least 3");
  require(options.min_compactness_ratio >= 0 && options.min_compactness_ratio <= 1,
          "min_compactness_ratio must be in [0, 1]");
  require(options.sufficient_compactness >= 0 && options.sufficient_compactness <= 1,
          "sufficient_compactness must be in [0, 1]");
  require(options.max_normal_deviation >= 0 && options.max_normal_deviation <= std::numbers::pi / 2,
          "max_normal_deviation must be in [0, pi/2] radians");
}

HullResult run_builder(const TriangleMesh& mesh, const HullOptions& options) {
  switch (options.queue) {
    case QueueKind::Bucket:
      return HullBuilder<EdgeBuckets>(mesh, options).run();
    case QueueKind::Heap:
      return HullBuilder<EdgeHeap>(mesh, options).run();
    default:
      return HullBuilder<EdgeTree>(mesh, options).run();
  }
}

// Every face with its corners 1 and 2 exchanged: o and d exchange their roles, l and r their sides.
HullResult turned(HullResult result) {
  const auto corner = [](std::uint32_t c) { return c % 3 == 0 ? c : c / 3 * 3 + 3 - c % 3; };
  const ProgressiveHull& hull = result.hull;
  std::vector<VertexId> corners(hull.base_corners().size());
  for (std::uint32_t c = 0; c < corners.size(); ++c) corners[corner(c)] = hull.base_corners()[c];
  std::vector<VertexSplit> splits = hull.splits();
  // (o, d, l) has become (o, l, d), that is (d, o, l): now on the right of o-d.
  for (VertexSplit& split : splits) {
    const auto second = [&](std::uint32_t od) { return corner(od % 3 == 2 ? od - 2 : od + 1); };
    split = {split.o, split.d, split.r, split.l, second(split.do_), second(split.od)};
  }
  result.hull = ProgressiveHull(hull.side(), hull.original_vertex_count(), hull.positions(), std::move(corners),
                                std::move(splits));
  return result;
}

}  // namespace

std::string_view name(Refusal refusal) {
  constexpr std::array<std::string_view, kRefusalKinds> kNames = {"link_condition",   "valence",     "no_room_outside",
                                                                  "certificate",      "compactness", "normal_deviation",
                                                                  "self_intersection"};
  return kNames[static_cast<std::size_t>(refusal)];
}

HullResult build_hull(const TriangleMesh& mesh, const HullOptions& options) {
  check(options);
  const MeshReport report = inspect(mesh);
  if (report.faces == 0) throw InputError(Defect::EmptyMesh, "the mesh has no faces");
  if (!report.is_closed_manifold()) throw InputError(report.worst_defect, report.first_defect);
  if (!(report.volume > 0))
    throw InputError(Defect::NoVolume, "the mesh is inside out or encloses nothing; closed_mesh turns what it can");
  if (options.side == HullSide::Outer) return run_builder(mesh, options);
  // An inner hull is the outer hull of the mesh turned inside out: what was inside of a face is then outside.
  return turned(run_builder(turned(mesh), options));
}

}  // namespace prohull
