#include "loose_hull.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "construct/edge_queue.h"
#include "construct/placement.h"
#include "construct/shape_guards.h"

namespace prohull::bench {
namespace {

Vec3 mean_of_link(const Star& star) {
  Vec3 sum;
  for (const Vec3& p : star.local) sum += p;
  return sum / static_cast<double>(star.local.size());
}

/// The lowest point above or below `from` along the mean normal that is outside of all planes.
std::optional<Vec3> lifted(const Star& star, const Vec3& from, double margin) {
  Vec3 up;
  for (std::size_t i = 0; i < star.planes.size(); ++i) up += star.planes[i].normal * star.double_areas[i];
  double least = -std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t i = 0; i < star.planes.size(); ++i) {
    if (star.double_areas[i] == 0) continue;
    const double rise = dot(star.planes[i].normal, up);
    const double missing = star.planes[i].offset + margin - dot(star.planes[i].normal, from);
    if (rise > 0)
      least = std::max(least, missing / rise);
    else if (rise < 0)
      most = std::min(most, missing / rise);
    else if (missing > 0)
      return std::nullopt;
  }
  if (!(least <= most) || least == -std::numeric_limits<double>::infinity()) return std::nullopt;
  return from + least * up;
}

/// P&T 3.1.1.
class LooseLoop {
 public:
  LooseLoop(const TriangleMesh& mesh, Strategy strategy, PlacementRule rule)
      : rule_(rule),
        rounding_(storage_rounding(bounding_box(mesh), false)),
        mesh_(mesh),
        queue_(mesh_.edge_id_count()) {
    options_.strategy = strategy;
    for (std::uint32_t e = 0; e < mesh_.edge_id_count(); ++e) evaluate(EdgeId{e});
  }

  void run(std::size_t target_faces) {
    while (mesh_.face_count() > target_faces && !queue_.empty()) {
      look_at(queue_.pop());
      const auto local = place();
      if (!local || refused_shape(star_, *local, options_)) continue;
      const Vec3 apex = star_.to_input(*local);
      if (!is_outside(mesh_, star_, apex)) continue;
      collapse(apex);
    }
  }

  ProgressiveHull hull(std::size_t original_vertices) const {
    std::vector<VertexId> corners;
    for (std::uint32_t h = 0; h < 3 * mesh_.face_id_count(); ++h) corners.push_back(mesh_.tail(HalfEdgeId{h}));
    return {HullSide::Outer, original_vertices, mesh_.positions(), std::move(corners), record_};
  }

 private:
  /// False if the edge must not be collapsed (3.1.4).
  bool look_at(EdgeId edge) {
    gather_star(mesh_, edge, star_);
    if (!satisfies_link_condition(star_) || star_.valence() > options_.guards.max_valence) return false;
    measure_star(mesh_, star_);
    return true;
  }

  std::optional<Vec3> place() const { return rule_(star_, placement_margin(star_, rounding_)); }

  void evaluate(EdgeId edge) {
    if (queue_.contains(edge)) queue_.erase(edge);
    if (!look_at(edge)) return;
    if (options_.strategy == Strategy::Paper2) return queue_.insert(edge, link_center_volume(star_));
    if (const auto local = place()) queue_.insert(edge, std::max(0.0, added_volume(star_, *local)));
  }

  void collapse(const Vec3& apex) {
    for (const HalfEdgeId h : {star_.edge, mesh_.twin(star_.edge)})  // d-l and o-r merge into o-l and d-r
      if (const EdgeId gone = mesh_.edge(mesh_.next(h)); queue_.contains(gone)) queue_.erase(gone);
    const VertexId s = mesh_.positions().next_id();
    record_.push_back(mesh_.collapse(star_.edge, apex));
    changed_.clear();  // Figure 3: all edges with an end on s or its link
    for (const HalfEdgeId h : mesh_.around(s))
      for (const HalfEdgeId g : mesh_.around(mesh_.tip(h))) changed_.push_back(mesh_.edge(g));
    std::ranges::sort(changed_);
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
    for (const EdgeId edge : changed_) evaluate(edge);
  }

  PlacementRule rule_;
  HullOptions options_;
  double rounding_;
  HalfEdgeMesh mesh_;
  EdgeHeap queue_;
  Star star_;
  std::vector<VertexSplit> record_;
  std::vector<EdgeId> changed_;
};

}  // namespace

std::optional<Vec3> by_linear_program(const Star& star, double margin) {
  const auto placement = place_outside(star, margin);
  return placement ? std::optional(placement->local) : std::nullopt;
}

std::optional<Vec3> lifted_midpoint(const Star& star, double margin) { return lifted(star, {}, margin); }

std::optional<Vec3> lifted_center(const Star& star, double margin) { return lifted(star, mean_of_link(star), margin); }

std::optional<Vec3> best_lifted(const Star& star, double margin) {
  std::optional<Vec3> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& from : {Vec3{}, mean_of_link(star), star.local_o, star.local_d})
    if (const auto p = lifted(star, from, margin))
      if (const double added = added_volume(star, *p); added < least) best = p, least = added;
  return best;
}

ProgressiveHull loose_hull(const TriangleMesh& mesh, Strategy strategy, PlacementRule rule, std::size_t target_faces) {
  LooseLoop loop(mesh, strategy, rule);
  loop.run(target_faces);
  return loop.hull(mesh.vertex_count());
}

}  // namespace prohull::bench
