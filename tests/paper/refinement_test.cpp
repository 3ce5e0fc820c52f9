#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "effort.h"
#include "meshes.h"
#include "paper/engines.h"
#include "prohull/detail/random_segments.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "prohull/mesh_query.h"
#include "prohull/sample.h"
#include "query/awkward_segments.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

struct Case {
  const char* name;
  ProgressiveHull hull;
};

ProgressiveHull hull_of(const TriangleMesh& mesh, std::size_t faces, HullSide side = HullSide::Outer) {
  return build_hull(mesh, {.target_faces = faces, .side = side}).hull;
}

/// With flat parts, several components, handles, folds; outer and inner.
const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"asteroid", hull_of(make_sample("asteroid", 3000), 100)},
      {"inner asteroid", hull_of(make_sample("asteroid", 3000), 100, HullSide::Inner)},
      {"torus", hull_of(torus(24, 16), 40)},
      {"inner torus", hull_of(torus(24, 16), 200, HullSide::Inner)},
      {"bracket", hull_of(make_sample("bracket", 2000), 60)},
      {"three parts", hull_of(together(together(sphere(3), moved(torus(16, 10), {3, 0, 0})),
                                       subdivided(subdivided(box({-1, 2, -1}, {1, 4, 1})))),
                              60)},
      {"not simplified", hull_of(octahedron(), 100)}};
  return all;
}

std::vector<Segment> segments_for(const TriangleMesh& mesh, std::size_t count, unsigned seed) {
  std::vector<Segment> segments = awkward_segments(mesh, count, seed);
  for (const Segment& s : random_segments(bounding_box(mesh), count, seed)) segments.push_back(s);
  return segments;
}

struct Variant {
  const char* name;
  RefinementOptions options;
};

constexpr Variant kVariants[] = {
    {"RollBack", {}},
    {"RollBackAfter7", {.queries_per_roll_back = 7}},
    {"Coarsen", {.between = BetweenQueries::Coarsen}},
};

class Refinement : public testing::TestWithParam<Variant> {};

TEST_P(Refinement, WhereBoundsMeetAnswersAsBruteForceDoes) {
  std::size_t hits = 0, met = 0;  // of all cases: one has few segments under sanitizers
  for (const auto& [name, hull] : cases()) {
    SCOPED_TRACE(name);
    const TriangleMesh original = hull.original();
    MeshQuery truth{QueryIndex(original, Engine::Brute)}, query{index_called("refinement", hull, GetParam().options)};
    const auto segments = segments_for(original, static_cast<std::size_t>(rounds(60)), test_seed());
    for (const Segment& s : segments) {
      const auto all = truth.all_hits(s);
      hits += all.size();
      ASSERT_EQ(query.all_hits(s), all);
      ASSERT_EQ(query.first_hit(s), truth.first_hit(s));
      const auto any = query.any_hit(s);
      ASSERT_EQ(any.has_value(), !all.empty());
      ASSERT_TRUE(!any || std::ranges::count(all, *any) == 1);
    }
    for (const Ray& r : rays_along(segments)) {
      ASSERT_EQ(query.all_hits(r), truth.all_hits(r));
      ASSERT_EQ(query.first_hit(r), truth.first_hit(r));
    }
    for (std::size_t i = 0; i + 2 < segments.size(); i += 4) {
      const Triangle t{segments[i].a, segments[i + 1].b, segments[i + 2].b};
      const auto faces = truth.faces_met(t);
      ASSERT_EQ(query.faces_met(t), faces);
      ASSERT_EQ(query.meets(t), !faces.empty());
      met += faces.size();
    }
  }
  EXPECT_GT(hits, 0u);
  EXPECT_GT(met, 0u);
}

TEST_P(Refinement, WhereFacesMeetFindsFirstCrossingsFromOutside) {
  std::size_t hits = 0;
  for (const auto& [name, hull] : cases()) {
    if (hull.side() == HullSide::Inner) continue;
    SCOPED_TRACE(name);
    const TriangleMesh original = hull.original();
    const Box around = bounding_box(hull.base());
    MeshQuery truth{QueryIndex(original, Engine::Brute)},
        query{index_called("paper-refinement", hull, GetParam().options)};
    for (const Segment& s : segments_for(original, static_cast<std::size_t>(rounds(100)), test_seed())) {
      const auto all = truth.all_hits(s), found = query.all_hits(s);
      ASSERT_TRUE(std::ranges::all_of(found, [&](const Hit& hit) { return std::ranges::count(all, hit) == 1; }));
      if (around.overlaps({s.a, s.a})) continue;
      const auto first = truth.first_hit(s);
      ASSERT_EQ(query.first_hit(s), first);
      ASSERT_EQ(query.any_hit(s).has_value(), first.has_value());
      ASSERT_EQ(query.first_hit(Ray{s.a, s.b - s.a}), truth.first_hit(Ray{s.a, s.b - s.a}));
      hits += first.has_value();
    }
  }
  EXPECT_GT(hits, 0u);
}

TEST_P(Refinement, GivesTheSameAnswersAndCountsForAnyNumberOfThreads) {
  const ProgressiveHull& hull = cases()[0].hull;
  const auto segments = random_segments(bounding_box(hull.original()), 3000, test_seed());
  for (const std::string_view engine : {"refinement", "paper-refinement"}) {
    const QueryIndex index = index_called(engine, hull, GetParam().options);
    const HitBatch one = find_hits(index, segments, HitMode::All, {.threads = 1});
    for (int i = 0; i < 3; ++i) {
      const HitBatch many = find_hits(index, segments, HitMode::All, {.threads = 0});
      EXPECT_EQ(many.hits, one.hits);
      EXPECT_EQ(many.counts.tests, one.counts.tests);
      EXPECT_EQ(many.counts.splits, one.counts.splits);
      EXPECT_EQ(many.counts.coarsenings, one.counts.coarsenings);
    }
  }
}

TEST_P(Refinement, TakesNoMoreMemoryHoweverManyQueriesThereAre) {
  const ProgressiveHull& hull = cases()[0].hull;
  MeshQuery query{index_called("refinement", hull, GetParam().options)};
  const auto segments = random_segments(bounding_box(hull.original()), 200, test_seed());
  const auto ask_all = [&] {
    for (const Segment& s : segments) query.all_hits(s), query.any_hit(s);
  };
  ask_all();
  const std::size_t memory = query.memory_bytes();
  for (int i = 0; i < 10; ++i) ask_all();
  EXPECT_EQ(query.memory_bytes(), memory);
}

INSTANTIATE_TEST_SUITE_P(BetweenQueries, Refinement, testing::ValuesIn(kVariants),
                         [](const auto& variant) { return std::string(variant.param.name); });

TEST(RefinementCounts, EveryBaseFaceIsTestedAndNothingWhereTheBoxIsMissed) {
  const ProgressiveHull& hull = cases()[0].hull;
  const Box base = bounding_box(hull.base()), box = bounding_box(hull.original());
  for (const std::string_view engine : {"refinement", "paper-refinement"}) {
    MeshQuery query{index_called(engine, hull)};
    EXPECT_FALSE(query.first_hit(Segment{{base.min.x, base.min.y, base.max.z + 1}, base.max + Vec3{0, 0, 1}}));
    EXPECT_EQ(query.counts().tests, 0u);
    EXPECT_EQ(query.counts().splits, 0u);
    // At a corner of the box, where a hull of an asteroid is not.
    EXPECT_FALSE(query.first_hit(Segment{box.max - Vec3{1e-3, 1e-3, 1e-3}, box.max}));
    EXPECT_EQ(query.counts().tests, hull.base_face_count());
    EXPECT_EQ(query.counts().splits, 0u);
    EXPECT_TRUE(query.first_hit(Segment{box.min, box.max}));
    EXPECT_GT(query.counts().tests, 2 * hull.base_face_count());
    EXPECT_GT(query.counts().splits, 10u);
  }
}

// P&T Table 3: coarser hulls need fewer tests and more splits.
TEST(RefinementCounts, TradeTestsForSplitsAsTheBaseHullGetsCoarser) {
  const ProgressiveHull hull = hull_of(make_sample("asteroid", 20000), 100);
  const auto segments = random_segments(bounding_box(hull.original()), static_cast<std::size_t>(rounds(500)), 1);
  QueryCounts last;
  for (const std::size_t faces : {5000u, 1000u, 200u}) {
    const QueryCounts counts =
        find_hits(index_called("paper-refinement", hull.with_base(faces)), segments, HitMode::All).counts;
    EXPECT_GT(counts.splits, last.splits);
    EXPECT_TRUE(last.tests == 0 || counts.tests < last.tests);
    last = counts;
  }
}

TEST(RefinementCounts, AreUndoneByRollingBackAndByCoarsening) {
  const ProgressiveHull& hull = cases()[0].hull;
  const Box box = bounding_box(hull.original());
  const Segment through{box.min, box.max},
      elsewhere{{box.min.x, box.max.y, box.min.z}, {box.max.x, box.min.y, box.max.z}};
  for (const std::string_view engine : {"refinement", "paper-refinement"}) {
    // The same query again: all splits again, every second time, or never.
    for (const auto& [options, expected] : {std::pair{RefinementOptions{}, 4u},
                                            {RefinementOptions{.queries_per_roll_back = 2}, 2u},
                                            {RefinementOptions{.between = BetweenQueries::Coarsen}, 1u}}) {
      MeshQuery query{index_called(engine, hull, options)};
      query.all_hits(through);
      const std::size_t once = query.counts().splits;
      for (int i = 0; i < 3; ++i) query.all_hits(through);
      EXPECT_EQ(query.counts().splits, expected * once);
    }
    // Another query: what the first left is coarsened but for what the other needs.
    MeshQuery query{index_called(engine, hull, {.between = BetweenQueries::Coarsen})};
    query.all_hits(through);
    EXPECT_EQ(query.counts().coarsenings, 0u);
    query.all_hits(elsewhere);
    EXPECT_GT(query.counts().coarsenings, 10u);
  }
}

TEST(QueryIndex, RefusesRefinementOptionsOutOfRange) {
  EXPECT_THROW(index_called("refinement", cases()[0].hull, {.queries_per_roll_back = 0}), InputError);
  EXPECT_EQ(index_called("paper-refinement", cases()[0].hull).engine_name(), "paper-refinement");
  EXPECT_EQ(QueryIndex(cases()[0].hull).engine_name(), "bvh");
}

}  // namespace
}  // namespace prohull
