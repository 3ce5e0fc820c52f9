#include "paper/collapse_study.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "construct/placement.h"
#include "construct/shape_guards.h"
#include "construct/star.h"
#include "geometry/predicates.h"
#include "mesh/half_edge_mesh.h"
#include "prohull/detail/refuse.h"
#include "prohull/error.h"

namespace prohull {
namespace {

HalfEdgeMesh mesh_of(const ProgressiveHull& hull, std::size_t i) {
  const ProgressiveHull then = hull.with_base(hull.original_face_count() - 2 * i);
  return {then.positions(), then.base_corners()};
}

void require(bool holds, const char* what) {
  if (!holds) refuse(what);
}

void require_collapses(const ProgressiveHull& hull, std::size_t count) {
  require(hull.side() == HullSide::Outer, "collapses are studied of outer hulls only");
  require(count <= hull.splits().size(), "the hull has no such collapse");
}

double rounding_of(const ProgressiveHull& hull) {
  Box box;
  for (std::uint32_t v = 0; v < hull.original_vertex_count(); ++v) box.extend(hull.positions()[VertexId{v}]);
  return storage_rounding(box, false);
}

std::optional<Placement> place(const Star& star, double rounding) {
  return place_outside(star, placement_margin(star, rounding));
}

/// As Star numbers its faces.
TriangleMesh mesh_of(const Star& star, const HalfEdgeMesh& mesh) {
  TriangleMesh result;
  const VertexId o = result.positions.push_back(mesh.position(star.o));
  const VertexId d = result.positions.push_back(mesh.position(star.d));
  std::vector<VertexId> link;
  for (const VertexId v : star.link) link.push_back(result.positions.push_back(mesh.position(v)));
  for (std::size_t i = 0; i < link.size(); ++i)
    result.triangles.push_back({i < star.o_faces ? o : d, link[i], link[star.after(i)]});
  result.triangles.push_back({o, d, link[0]});
  result.triangles.push_back({d, o, link[star.o_faces]});
  return result;
}

Vec3 steepest_of(const Star& star) {
  Vec3 sum;
  for (std::size_t i = 0; i < star.planes.size(); ++i) sum += star.planes[i].normal * star.double_areas[i];
  return sum / norm(sum);
}

/// The edges whose star the last collapse changed; none if there was no collapse.
std::set<EdgeId> renewed_edges(const ProgressiveHull& hull, std::size_t i, const HalfEdgeMesh& mesh) {
  std::set<EdgeId> renewed;
  if (i > 0) visit_edges_around(mesh, hull.made_vertex(i - 1), [&](EdgeId edge) { renewed.insert(edge); });
  return renewed;
}

/// What the loop of the construction finds of an edge, in its order.
class EdgeStudy {
 public:
  EdgeStudy(const HalfEdgeMesh& mesh, const HullOptions& options, double rounding)
      : mesh_(mesh), options_(options), rounding_(rounding) {}

  QueuedEdge operator()(EdgeId edge) {
    gather_star(mesh_, edge, star_);
    QueuedEdge queued{{star_.o, star_.d}, 0, {}, false};
    queued.refusal = refusal(queued.priority);
    return queued;
  }

 private:
  std::optional<Refusal> refusal(double& priority) {
    if (!satisfies_link_condition(star_)) return Refusal::LinkCondition;
    if (star_.valence() > options_.guards.max_valence) return Refusal::Valence;
    measure_star(mesh_, star_);
    const auto placement = place(star_, rounding_);
    if (!placement) return Refusal::NoRoomOutside;
    priority = options_.strategy == Strategy::Paper2 ? link_center_volume(star_) : placement->added_volume;
    if (const auto why = refused_shape(star_, placement->local, options_)) return why;
    if (!is_outside(mesh_, star_, star_.to_input(placement->local))) return Refusal::Certificate;
    return std::nullopt;
  }

  const HalfEdgeMesh& mesh_;
  const HullOptions& options_;
  double rounding_;
  Star star_;
};

}  // namespace

StudiedCollapse study_collapse(const ProgressiveHull& hull, std::size_t i, const std::optional<Vec3>& asked) {
  require_collapses(hull, i + 1);
  const Vec3 made = hull.positions()[hull.made_vertex(i)], at = asked.value_or(made);
  require(is_finite(at), "the place of the new vertex must be finite");
  const HalfEdgeMesh mesh = mesh_of(hull, i);
  Star star;
  gather_star(mesh, mesh.edge(HalfEdgeId{hull.splits()[i].od}), star);
  measure_star(mesh, star);
  const auto placement = place(star, rounding_of(hull));
  if (!placement) throw InputError(Defect::NoCertificate, "the linear program of this collapse has no answer");
  StudiedCollapse study{mesh_of(star, mesh), made, star.to_input(placement->local),      placement->added_volume,
                        steepest_of(star),   {},   added_volume(star, star.to_local(at))};
  for (const FaceId f : study.star.triangles.ids()) {
    const Triangle t = study.star.triangle(f);
    study.sides.push_back(static_cast<std::int8_t>(side(t.a, t.b, t.c, at)));
  }
  return study;
}

std::vector<QueuedEdge> queue_before(const ProgressiveHull& hull, std::size_t i, const HullOptions& options) {
  require_collapses(hull, i);
  require(options.strategy != Strategy::Lazy, "the queue is that of the paper's strategies, paper1 and paper2");
  const HalfEdgeMesh mesh = mesh_of(hull, i);
  const std::set<EdgeId> renewed = renewed_edges(hull, i, mesh);
  EdgeStudy study(mesh, options, rounding_of(hull));
  std::vector<QueuedEdge> queue;
  for (std::uint32_t e = 0; e < mesh.edge_id_count(); ++e) {
    queue.push_back(study(EdgeId{e}));
    queue.back().is_renewed = renewed.contains(EdgeId{e});
  }
  std::ranges::stable_sort(queue, [](const QueuedEdge& a, const QueuedEdge& b) {
    return std::tuple(a.refusal.has_value(), a.priority) < std::tuple(b.refusal.has_value(), b.priority);
  });
  return queue;
}

}  // namespace prohull
