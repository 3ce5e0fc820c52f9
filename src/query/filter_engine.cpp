#include "query/filter_engine.h"

#include <algorithm>
#include <vector>

#include "geometry/triangle_intersection.h"
#include "hull/void_complex.h"
#include "query/some_faces.h"

// What the filters decide of a line that begins outside of the box around all positions, so that no mesh winds around
// its origin. Let w be the winding number of the mesh along the moved line, W that of the outer level, v that of the
// inner level: v <= w <= W between crossings (docs/theory.md). Nothing is said of self-intersections.
//
// Sure hit: the first crossing with the inner level enters, by a face that no other covers. So v = 1 on some part of
// the line behind it. There w >= 1, but w = 0 at the origin: the line crosses the mesh between.
//
// Sure miss: the line crosses neither level. Then v = W = 0 on all of it, and w = 0. Suppose that it crosses a face of
// the mesh none the less. On one side of the face, the outer one, lies void: a tetrahedron, or a face of the outer
// level, which the line would cross. The walk through the void from there (paper/walk_engine.cpp) covers no part of the
// line, for W would be above w there. So it leads through flat tetrahedra, at one point, to a face of the mesh: both
// are among sheets_without_thickness, and those are tested.

namespace prohull {
namespace {

constexpr std::size_t kFilterFaces = 2000;

struct Level {
  explicit Level(TriangleMesh m) : mesh(std::move(m)), tree(make_bvh_engine(mesh)) {}
  std::size_t memory_bytes() const {
    return mesh.vertex_count() * sizeof(Vec3) + mesh.face_count() * sizeof(mesh.triangles[FaceId{}]) +
           tree->memory_bytes();
  }
  TriangleMesh mesh;
  std::unique_ptr<QueryEngine> tree;
};

/// The faces that others meet, covered ones among them.
std::vector<bool> met_by_others(const Level& level) {
  const TriangleMesh& mesh = level.mesh;
  const auto worker = level.tree->worker();
  std::vector<bool> met(mesh.face_count(), false);
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle triangle = mesh.triangle(f);
    FaceCollector touched(mesh, triangle, HitMode::All);
    worker->collect(triangle, touched);
    met[index(f)] = std::ranges::any_of(
        touched.all(), [&](FaceId g) { return g != f && triangles_intersect(triangle, mesh.triangle(g)); });
  }
  return met;
}

/// What all threads share.
struct FilterData {
  FilterData(const TriangleMesh& mesh, const ProgressiveHull& outer_hull, const ProgressiveHull& inner_hull)
      : whole(make_bvh_engine(mesh)),
        outer(outer_hull.level(kFilterFaces)),
        inner(inner_hull.level(kFilterFaces)),
        sheets(mesh, sheets_without_thickness(VoidComplex(outer_hull))),
        may_be_covered(met_by_others(inner)) {
    const VoidComplex certified(inner_hull);  // throws if the levels do not enclose each other
    for (const ProgressiveHull* hull : {&outer_hull, &inner_hull})
      for (const Vec3& p : hull->positions()) frame.extend(p);
  }

  bool is_outside(const Vec3& p) const { return !frame.overlaps({p, p}); }

  std::unique_ptr<QueryEngine> whole;
  Level outer, inner;
  SomeFaces sheets;
  std::vector<bool> may_be_covered;  ///< by face of the inner level
  Box frame;                         ///< of all positions
};

class FilterWorker final : public QueryWorker {
 public:
  explicit FilterWorker(const FilterData& shared)
      : shared_(shared),
        whole_(shared.whole->worker()),
        outer_(shared.outer.tree->worker()),
        inner_(shared.inner.tree->worker()),
        sheets_(shared.sheets) {}

  void collect(const DirectedLine& line, HitCollector& hits) override { whole_->collect(line, hits); }
  void collect(const Triangle& triangle, FaceCollector& faces) override { whole_->collect(triangle, faces); }
  void collect(ClosestCollector& closest) override { whole_->collect(closest); }
  std::optional<Hit> one_hit(const TriangleMesh& mesh, const DirectedLine& line, HitMode mode) override {
    return whole_->one_hit(mesh, line, mode);
  }
  void all_hits(const TriangleMesh& mesh, const DirectedLine& line, std::vector<Hit>& hits) override {
    whole_->all_hits(mesh, line, hits);
  }

  int winding(const TriangleMesh& mesh, const DirectedLine& line) override { return whole_->winding(mesh, line); }

  bool crosses(const TriangleMesh& mesh, const DirectedLine& line) override {
    if (shared_.is_outside(line.origin)) return crosses_from_outside(mesh, line);
    if (line.is_ray() || !shared_.is_outside(line.end)) return whole_->crosses(mesh, line);
    return crosses_from_outside(mesh, DirectedLine(Segment{line.end, line.origin}));
  }

 private:
  bool crosses_from_outside(const TriangleMesh& mesh, const DirectedLine& line) {
    const auto first = inner_->one_hit(shared_.inner.mesh, line, HitMode::First);
    if (first && first->entering && !shared_.may_be_covered[index(first->face)]) return true;
    if (!first && !outer_->crosses(shared_.outer.mesh, line)) return sheets_.crosses(line);
    return whole_->crosses(mesh, line);
  }

  const FilterData& shared_;
  std::unique_ptr<QueryWorker> whole_, outer_, inner_;
  SomeFaces::Asker sheets_;
};

class FilterEngine final : public QueryEngine {
 public:
  FilterEngine(const TriangleMesh& mesh, const ProgressiveHull& outer, const ProgressiveHull& inner)
      : shared_(mesh, outer, inner) {}
  std::unique_ptr<QueryWorker> worker() const override { return std::make_unique<FilterWorker>(shared_); }
  bool gains_from_order() const override { return shared_.whole->gains_from_order(); }
  std::size_t memory_bytes() const override {
    return sizeof(*this) + shared_.whole->memory_bytes() + shared_.outer.memory_bytes() + shared_.inner.memory_bytes() +
           shared_.sheets.memory_bytes();
  }

 private:
  FilterData shared_;
};

}  // namespace

std::unique_ptr<QueryEngine> make_filter_engine(const TriangleMesh& mesh, const ProgressiveHull& outer,
                                                const ProgressiveHull& inner) {
  return std::make_unique<FilterEngine>(mesh, outer, inner);
}

bool filter_pays(std::size_t faces) { return faces >= 1000000; }

}  // namespace prohull
