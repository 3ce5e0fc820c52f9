#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "construct/placement.h"
#include "construct/progressive/cells.h"
#include "construct/shape_guards.h"
#include "effort.h"
#include "geometry/unit_cube.h"
#include "meshes.h"
#include "prohull/hull_builder.h"
#include "prohull/sample.h"

namespace prohull {
namespace {

using namespace meshes;

/// The greedy algorithm of P&T 3.1.1 without anything that makes it fast: no queue, no Figure 3, nothing is remembered.
/// Before every collapse the priorities of all edges are found anew; of the legal collapses the one with the least is
/// made, of several that with the least edge.
class NaiveGreedy {
 public:
  NaiveGreedy(const TriangleMesh& mesh, const HullOptions& options)
      : options_(options), box_(bounding_box(mesh)), mesh_(mesh) {}

  std::vector<VertexSplit> run() {
    std::vector<VertexSplit> collapses;
    while (mesh_.face_count() > options_.target_faces) {
      const auto best = best_collapse();
      if (!best) break;
      collapses.push_back(mesh_.collapse(mesh_.half_edge(best->edge), best->apex));
    }
    return collapses;
  }

  const PerVertex<Vec3>& positions() const { return mesh_.positions(); }

 private:
  struct Candidate {
    double priority;
    EdgeId edge;
    auto operator<=>(const Candidate&) const = default;
  };
  struct Collapse {
    EdgeId edge;
    Vec3 apex;
  };

  std::optional<Collapse> best_collapse() {
    std::vector<Candidate> candidates;
    for (std::uint32_t i = 0; i < mesh_.edge_id_count(); ++i)
      if (mesh_.has(EdgeId{i}))
        if (const auto priority = priority_of(EdgeId{i})) candidates.push_back({*priority, EdgeId{i}});
    std::ranges::sort(candidates);
    for (const Candidate& candidate : candidates)
      if (const auto apex = legal_apex(candidate.edge)) return Collapse{candidate.edge, *apex};
    return std::nullopt;
  }

  /// False if the collapse is illegal wherever the new vertex goes (3.1.4).
  bool look_at(EdgeId edge) {
    gather_star(mesh_, edge, star_);
    if (!satisfies_link_condition(star_) || star_.valence() > options_.guards.max_valence) return false;
    measure_star(mesh_, star_);
    return true;
  }

  std::optional<Placement> place() const { return place_outside(star_, placement_margin(star_, rounding_)); }

  /// 3.1.3. The library's own values, so that ties are the same to the last bit; they must be those of the paper.
  std::optional<double> priority_of(EdgeId edge) {
    if (!look_at(edge)) return std::nullopt;
    const double unit = star_.scale * star_.scale * star_.scale;
    if (options_.strategy == Strategy::Paper2) {
      Vec3 center;
      for (const VertexId v : star_.link) center += mesh_.position(v) / static_cast<double>(star_.link.size());
      const double volume = link_center_volume(star_);
      EXPECT_NEAR(volume, volume_to(center, [](double x) { return std::abs(x); }), 1e-9 * unit);
      return volume;
    }
    const auto placement = place();
    if (!placement) return std::nullopt;
    EXPECT_NEAR(placement->added_volume, volume_to(star_.to_input(placement->local), [](double x) { return x; }),
                1e-9 * unit);
    return placement->added_volume;
  }

  /// Of the tetrahedra between a point and the faces of the star (formula 3).
  template <class Volume>
  double volume_to(const Vec3& p, Volume volume) const {
    const auto tetrahedron = [&](VertexId a, VertexId b, VertexId c) {
      const Vec3 &at = mesh_.position(a), &bt = mesh_.position(b), &ct = mesh_.position(c);
      return volume(dot(cross(bt - at, ct - at), p - at) / 6);
    };
    double sum =
        tetrahedron(star_.o, star_.d, star_.link[0]) + tetrahedron(star_.d, star_.o, star_.link[star_.o_faces]);
    for (std::size_t i = 0; i < star_.link.size(); ++i)
      sum += tetrahedron(star_.apex(i), star_.link[i], star_.link[star_.after(i)]);
    return sum;
  }

  /// Where the collapse puts its vertex, if it is legal there (3.1.2, 3.1.4).
  std::optional<Vec3> legal_apex(EdgeId edge) {
    look_at(edge);
    const auto placement = place();
    if (!placement || refused_shape(star_, placement->local, options_)) return std::nullopt;
    const Vec3 apex = star_.to_input(placement->local);
    const double reach = options_.guards.max_overhang * box_.diagonal();
    for (int axis = 0; axis < 3; ++axis)
      if (apex[axis] < box_.min[axis] - reach || apex[axis] > box_.max[axis] + reach) return std::nullopt;
    if (!is_outside(mesh_, star_, apex)) return std::nullopt;
    return apex;
  }

  HullOptions options_;
  Box box_;
  double rounding_ = storage_rounding(box_, false);
  HalfEdgeMesh mesh_;
  Star star_;
};

/// Numbered as build_hull numbers faces and vertices itself, so that its edges are those of HalfEdgeMesh(mesh): ties
/// are decided by them.
TriangleMesh along_the_curve(const TriangleMesh& mesh) {
  const UnitCube cube(bounding_box(mesh));
  std::vector<BoxedFace> faces;
  for (const FaceId f : mesh.triangles.ids()) faces.push_back({f, cube.at(mesh.triangle(f))});
  TriangleMesh sorted;
  PerVertex<VertexId> number(mesh.vertex_count(), kNoVertex);
  for (const FaceId f : along_curve(faces)) {
    auto corners = mesh.triangles[f];
    for (VertexId& v : corners) {
      if (number[v] == kNoVertex) number[v] = sorted.positions.push_back(mesh.positions[v]);
      v = number[v];
    }
    sorted.triangles.push_back(corners);
  }
  return sorted;
}

struct Case {
  std::string_view name;
  TriangleMesh mesh;
};

// Rough; smooth; of planar faces, where collapses add nothing; of equal priorities, for a torus is alike all around.
std::vector<Case> cases() {
  const std::size_t faces = effort<std::size_t>(500, 150);
  return {{"asteroid", make_sample("asteroid", faces)},
          {"knot", make_sample("knot", faces)},
          {"box", make_sample("box", faces)},
          {"torus", torus(effort(24, 12), 8)}};
}

class PaperOrder : public testing::TestWithParam<Strategy> {};

// Down to where no collapse is legal. So the updates of Figure 3 leave no stale priority behind, and an edge that was
// refused comes back when, and only when, it may be legal again.
TEST_P(PaperOrder, IsThatOfTheNaiveGreedyAlgorithm) {
  for (const auto& [name, given] : cases()) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = along_the_curve(given);
    HullOptions options{.target_faces = 4, .strategy = GetParam()};
    NaiveGreedy naive(mesh, options);
    const std::vector<VertexSplit> collapses = naive.run();
    EXPECT_GT(collapses.size(), effort(mesh.face_count() / 8, std::size_t{5}));
    for (const QueueKind queue : {QueueKind::Heap, QueueKind::RedBlackTree}) {
      options.queue = queue;
      const ProgressiveHull hull = build_hull(mesh, options).hull;
      const auto [ours, theirs] = std::ranges::mismatch(hull.splits(), collapses);
      ASSERT_TRUE(ours == hull.splits().end() && theirs == collapses.end())
          << "collapse " << theirs - collapses.begin() << " of " << collapses.size() << " is another one";
      EXPECT_EQ(hull.positions(), naive.positions());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Strategies, PaperOrder, testing::Values(Strategy::Paper1, Strategy::Paper2),
                         [](const auto& parameter) { return std::string(name_of(strategy_names(), parameter.param)); });

}  // namespace
}  // namespace prohull
