#include "paper/collapse_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "effort.h"
#include "prohull/error.h"
#include "prohull/sample.h"

namespace prohull {
namespace {

HullOptions options_of(Strategy strategy) {
  return {.target_faces = 60, .strategy = strategy, .queue = QueueKind::Heap};
}

ProgressiveHull asteroid(Strategy strategy) {
  return build_hull(make_sample("asteroid", effort<std::size_t>(400, 150)), options_of(strategy)).hull;
}

using Ends = std::pair<VertexId, VertexId>;
Ends ends_of(VertexId a, VertexId b) { return std::minmax({a, b}); }

TEST(CollapseStudy, TheCollapsePutItsVertexAtTheOptimumOutsideOfAllPlanes) {
  const ProgressiveHull hull = asteroid(Strategy::Paper1);
  for (std::size_t i = 0; i < hull.splits().size(); ++i) {
    const StudiedCollapse study = study_collapse(hull, i);
    EXPECT_EQ(study.made, hull.positions()[hull.made_vertex(i)]);
    EXPECT_LT(norm(study.optimum - study.made), 1e-9);
    EXPECT_EQ(study.star.face_count(), study.star.vertex_count());
    EXPECT_EQ(study.sides.size(), study.star.face_count());
    EXPECT_EQ(std::ranges::count(study.sides, -1), 0);
    const auto [o, d] = ends_of(hull.splits()[i].o, hull.splits()[i].d);
    const Vec3 &a = hull.positions()[o], &b = hull.positions()[d], &c = study.star.positions[VertexId{0}];
    EXPECT_TRUE(c == a || c == b);
  }
}

// Linear programming: no way leads from the optimum to less volume but through a plane.
TEST(CollapseStudy, AnotherPlaceAddsMoreOrIsInsideOfAPlane) {
  const ProgressiveHull hull = asteroid(Strategy::Paper1);
  std::size_t outside = 0;
  for (std::size_t i = 0; i < hull.splits().size(); i += 7) {
    const StudiedCollapse best = study_collapse(hull, i);
    const Box box = bounding_box(best.star);
    const double reach = 0.3 * box.diagonal();
    for (const Vec3& way : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1},
                            best.steepest, -best.steepest}) {
      const StudiedCollapse moved = study_collapse(hull, i, best.optimum + way * reach);
      if (std::ranges::count(moved.sides, -1) > 0) continue;
      EXPECT_GE(moved.added_volume, best.optimal_volume);
      ++outside;
    }
    const StudiedCollapse below = study_collapse(hull, i, best.optimum - best.steepest * reach);
    EXPECT_GT(std::ranges::count(below.sides, -1), 0);
    EXPECT_LT(below.added_volume, best.optimal_volume);
  }
  EXPECT_GT(outside, 0u);
}

class QueueStudy : public testing::TestWithParam<Strategy> {};

TEST_P(QueueStudy, TheFirstEdgeIsTheOneThatIsCollapsed) {
  const ProgressiveHull hull = asteroid(GetParam());
  ASSERT_GT(hull.splits().size(), 20u);
  for (std::size_t i = 0; i < hull.splits().size(); ++i) {
    const auto queue = queue_before(hull, i, options_of(GetParam()));
    EXPECT_EQ(queue.size(), 3 * (hull.original_face_count() - 2 * i) / 2);
    ASSERT_FALSE(queue[0].refusal);
    EXPECT_EQ(ends_of(queue[0].ends[0], queue[0].ends[1]), ends_of(hull.splits()[i].o, hull.splits()[i].d)) << i;
  }
}

// P&T Figure 3: what is not renewed may keep its priority.
TEST_P(QueueStudy, OtherEdgesKeepTheirPriorities) {
  const ProgressiveHull hull = asteroid(GetParam());
  std::map<Ends, double> before;
  std::size_t kept = 0, renewed = 0;
  for (std::size_t i = 0; i < hull.splits().size(); ++i) {
    std::map<Ends, double> now;
    for (const QueuedEdge& edge : queue_before(hull, i, options_of(GetParam()))) {
      const Ends ends = ends_of(edge.ends[0], edge.ends[1]);
      now[ends] = edge.priority;
      (edge.is_renewed ? renewed : kept) += 1;
      if (i == 0) {
        EXPECT_FALSE(edge.is_renewed);
      } else if (!edge.is_renewed) {
        EXPECT_NEAR(before.at(ends), edge.priority, 1e-12);
      }
    }
    before = std::move(now);
  }
  EXPECT_GT(renewed, 10 * hull.splits().size());
  EXPECT_GT(kept, renewed);
}

INSTANTIATE_TEST_SUITE_P(Strategies, QueueStudy, testing::Values(Strategy::Paper1, Strategy::Paper2),
                         [](const auto& parameter) { return std::string(name_of(strategy_names(), parameter.param)); });

TEST(CollapseStudy, RefusesWhatItHasNot) {
  const ProgressiveHull hull = asteroid(Strategy::Paper1);
  EXPECT_THROW(study_collapse(hull, hull.splits().size()), InputError);
  EXPECT_THROW(study_collapse(hull, 0, Vec3{std::numeric_limits<double>::quiet_NaN(), 0, 0}), InputError);
  EXPECT_THROW(queue_before(hull, hull.splits().size() + 1, options_of(Strategy::Paper1)), InputError);
  EXPECT_THROW(queue_before(hull, 0, {}), InputError);
  const ProgressiveHull inner =
      build_hull(make_sample("asteroid", 150), {.target_faces = 100, .side = HullSide::Inner}).hull;
  EXPECT_THROW(study_collapse(inner, 0), InputError);
}

}  // namespace
}  // namespace prohull
