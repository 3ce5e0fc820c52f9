#include "prohull/mesh_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

#include "effort.h"
#include "input_error.h"
#include "meshes.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "prohull/sample.h"
#include "query/awkward_segments.h"
#include "query/brute_force.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

TEST(MeshQuery, FindsWhereASegmentEntersAndLeaves) {
  MeshQuery query{QueryIndex(box({0, 0, 0}, {1, 1, 1}))};
  const Segment through{{0.3, 0.4, -1}, {0.3, 0.4, 3}};
  const auto hits = query.all_hits(through);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_DOUBLE_EQ(hits[0].t, 0.25);
  EXPECT_TRUE(hits[0].entering);
  EXPECT_LT(norm(hits[0].position - Vec3{0.3, 0.4, 0}), 1e-15);
  EXPECT_DOUBLE_EQ(hits[1].t, 0.5);
  EXPECT_FALSE(hits[1].entering);
  EXPECT_EQ(query.first_hit(through), hits[0]);
  EXPECT_TRUE(query.any_hit(through));
  EXPECT_FALSE(query.first_hit(Segment{{0.3, 0.4, -1}, {0.3, 0.4, -0.5}}));
  EXPECT_DOUBLE_EQ(query.first_hit(Ray{{0.3, 0.4, 0.5}, {0, 0, 2}})->t, 0.25);
  EXPECT_FALSE(query.first_hit(Ray{{0.3, 0.4, 2}, {0, 0, 2}}));
}

TEST(MeshQuery, HitsHavePositionsWhereNoDoubleHoldsT) {
  const TriangleMesh mesh = meshes::make({{0, -1, -1}, {0, 2, -1}, {0, 0, 2}}, {{0, 1, 2}});
  for (const Engine engine : {Engine::Bvh, Engine::Brute}) {
    MeshQuery query{QueryIndex(mesh, engine)};
    for (const auto& [start, speed] : {std::pair(-5.0, 5e-324), std::pair(-5.0, 1e-310), std::pair(-2e-15, 1e308)}) {
      const Ray ray{{start, 0.1, 0}, {speed, 0, 0}};
      const auto hit = query.first_hit(ray);
      ASSERT_TRUE(hit) << speed;
      EXPECT_EQ(hit->position, (Vec3{0, 0.1, 0})) << speed;
      EXPECT_GE(hit->t, 0);
      EXPECT_EQ(query.all_hits(ray), std::vector{*hit});
    }
  }
}

TEST(MeshQuery, EntersAndLeavesInTurnHoweverASegmentRuns) {
  for (const TriangleMesh& mesh : {box({0, 0, 0}, {1, 1, 1}), octahedron(), torus(8, 6), two_spheres_and_a_box()}) {
    MeshQuery query{QueryIndex(mesh)};
    const Box around = bounding_box(mesh);
    std::size_t hits = 0;
    for (Segment s : awkward_segments(mesh, rounds(1000), test_seed())) {
      // From far outside: to the middle of the segment, and on beyond the mesh.
      const Vec3 d = s.b - s.a;
      if (d == Vec3{}) continue;
      const double reach = 4 * around.diagonal() / norm(d);
      const auto found = query.all_hits(Segment{s.a - reach * d, s.a + reach * d});
      EXPECT_EQ(found.size() % 2, 0u);
      for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].entering, i % 2 == 0);
      hits += found.size();
    }
    EXPECT_GT(hits, rounds(1000) / 4);
  }
}

class Engines : public testing::TestWithParam<Engine> {};

TEST_P(Engines, AnswerAsBruteForceDoes) {
  expect_answers_of_brute_force([](const TriangleMesh& mesh) { return QueryIndex(mesh, GetParam()); });
}

INSTANTIATE_TEST_SUITE_P(Query, Engines, testing::Values(Engine::Auto, Engine::Bvh), [](const auto& parameter) {
  for (const auto& [name, engine] : engine_names())
    if (engine == parameter.param) return identifier(name);
  return std::string("unnamed");
});

TEST(MeshQuery, OfAnEmptyMeshFindsNothing) {
  MeshQuery query{QueryIndex(TriangleMesh{})};
  EXPECT_FALSE(query.first_hit(Segment{{0, 0, 0}, {1, 1, 1}}));
  EXPECT_FALSE(query.meets(Triangle{{0, 0, 0}, {1, 1, 1}, {0, 1, 0}}));
}

TEST(QueryIndex, RefusesWhatItCannotAnswer) {
  TriangleMesh mesh = octahedron();
  mesh.positions[VertexId{2}].y = std::nan("");
  EXPECT_THROW(QueryIndex{mesh}, InputError);
  EXPECT_THROW(QueryIndex(octahedron(), Engine::Filter), InputError);
}

// Only the outer levels were looked at.
TEST(QueryIndex, RefusesHullsThatAreNoHulls) {
  const TriangleMesh mesh = sphere(3);
  const auto hull_of = [&](HullSide side) { return build_hull(mesh, {.target_faces = 100, .side = side}).hull; };
  const ProgressiveHull outer = hull_of(HullSide::Outer), inner = hull_of(HullSide::Inner);
  const auto with_a_vertex_moved = [](const ProgressiveHull& hull, double factor) {
    auto positions = hull.positions();
    const VertexId v = hull.made_vertex(100);
    positions[v] = positions[v] * factor;
    return ProgressiveHull(hull.side(), hull.original_vertex_count(), positions, hull.base_corners(), hull.splits());
  };
  EXPECT_NO_THROW(QueryIndex(outer, inner, Engine::Filter));
  EXPECT_THROW(QueryIndex(with_a_vertex_moved(outer, 0.2), inner, Engine::Filter), InputError);
  EXPECT_THROW(QueryIndex(outer, with_a_vertex_moved(inner, 3), Engine::Filter), InputError);
}

TEST(Hits, AreTheSameForAnyNumberOfThreads) {
  const QueryIndex index(make_sample("asteroid", 2000));
  const auto segments = awkward_segments(make_sample("asteroid", 2000), 3000, test_seed());
  const HitBatch one = find_hits(index, segments, HitMode::All, {.threads = 1});
  ASSERT_EQ(one.offsets.size(), segments.size() + 1);
  MeshQuery query(index);
  for (std::size_t i = 0; i < segments.size(); ++i)
    EXPECT_EQ(std::vector(one.hits.begin() + static_cast<std::ptrdiff_t>(one.offsets[i]),
                          one.hits.begin() + static_cast<std::ptrdiff_t>(one.offsets[i + 1])),
              query.all_hits(segments[i]));
  for (const unsigned threads : {0u, 2u, 5u}) {
    const HitBatch many = find_hits(index, segments, HitMode::All, {.threads = threads});
    EXPECT_EQ(many.offsets, one.offsets);
    EXPECT_EQ(many.hits, one.hits);
  }
}

TEST(Hits, InChunksAreTheSame) {
  const QueryIndex index(make_sample("asteroid", 2000));
  const auto segments = awkward_segments(make_sample("asteroid", 2000), 3000, test_seed());
  for (const HitMode mode : {HitMode::First, HitMode::Any, HitMode::All}) {
    const HitBatch whole = find_hits(index, segments, mode);
    std::mutex mutex;
    std::size_t queries = 0;
    find_hits_in_chunks(index, segments, mode, [&](std::size_t first, const HitBatch& chunk) {
      const std::scoped_lock lock(mutex);
      const auto begin = whole.hits.begin() + static_cast<std::ptrdiff_t>(whole.offsets[first]);
      EXPECT_TRUE(std::ranges::equal(chunk.hits, std::span(begin, chunk.hits.size())));
      for (std::size_t i = 0; i < chunk.offsets.size(); ++i)
        EXPECT_EQ(chunk.offsets[i], whole.offsets[first + i] - whole.offsets[first]);
      queries += chunk.offsets.size() - 1;
    });
    EXPECT_EQ(queries, segments.size());
  }
}

TEST(Hits, EndWithWhatTakingThemThrows) {
  const std::vector<Segment> segments(5000, {{-1, 0.1, 0.2}, {1, 0.1, 0.2}});
  EXPECT_THROW(find_hits_in_chunks(QueryIndex(octahedron()), segments, HitMode::First,
                                   [](std::size_t, const HitBatch&) { throw std::length_error("full"); }),
               std::length_error);
}

TEST(Hits, NameTheFirstQueryThatIsNotFinite) {
  std::vector<Segment> segments(10, {{0, 0, 0}, {1, 1, 1}});
  segments[7].b.z = std::nan("");
  segments[8].b.z = std::nan("");
  const std::string refusal = error_of([&] { find_hits(QueryIndex(octahedron()), segments, HitMode::First); }).what();
  EXPECT_NE(refusal.find("query 7"), std::string::npos) << refusal;
}

TEST(Hits, CanBeCancelled) {
  const std::vector<Segment> segments(5000, {{-1, 0.1, 0.2}, {1, 0.1, 0.2}});
  EXPECT_THROW(find_hits(QueryIndex(octahedron()), segments, HitMode::First,
                         {.progress = [](std::string_view, double) { return false; }}),
               Cancelled);
}

TEST(FacesMet, OfManyTrianglesAreThoseOfEach) {
  const QueryIndex index(box({0, 0, 0}, {1, 1, 1}));
  const std::vector<Triangle> triangles{{{-1, 0.5, 0.5}, {2, 0.5, 0.4}, {2, 0.5, 0.6}},  // in left, out right
                                        {{5, 5, 5}, {6, 5, 5}, {5, 6, 5}},               // far away
                                        {{1, 1, 1}, {2, 2, 2}, {2, 2, 3}}};              // touches a corner
  const FaceBatch batch = find_faces_met(index, triangles);
  MeshQuery query(index);
  ASSERT_EQ(batch.offsets.size(), 4u);
  EXPECT_EQ(batch.faces.size(), batch.offsets[3]);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto met = query.faces_met(triangles[i]);
    EXPECT_EQ(met.empty(), i == 1) << i;
    EXPECT_EQ(std::vector(batch.faces.begin() + static_cast<std::ptrdiff_t>(batch.offsets[i]),
                          batch.faces.begin() + static_cast<std::ptrdiff_t>(batch.offsets[i + 1])),
              met);
  }
}

TEST(Contains, SaysWhereTheMeshWindsAround) {
  MeshQuery cube{QueryIndex(box({0, 0, 0}, {1, 1, 1}))};
  EXPECT_TRUE(cube.contains({0.5, 0.5, 0.5}));
  EXPECT_TRUE(cube.contains({0.99, 0.99, 0.01}));
  EXPECT_FALSE(cube.contains({1.01, 0.5, 0.5}));
  EXPECT_FALSE(cube.contains({-7, 0.5, 0.5}));
  EXPECT_FALSE(MeshQuery{QueryIndex(inside_out(box({0, 0, 0}, {1, 1, 1})))}.contains({0.5, 0.5, 0.5}));

  const TriangleMesh cavity = inside_out(box({0.2, 0.2, 0.2}, {0.4, 0.4, 0.4}));
  MeshQuery hollow{QueryIndex(together(box({0, 0, 0}, {1, 1, 1}), cavity))};
  EXPECT_FALSE(hollow.contains({0.3, 0.3, 0.3}));
  EXPECT_TRUE(hollow.contains({0.1, 0.3, 0.3}));

  MeshQuery overlapping{QueryIndex(together(box({0, 0, 0}, {1, 1, 1}), box({0.5, 0, 0}, {1.5, 1, 1})))};
  for (const double x : {0.25, 0.75, 1.25}) EXPECT_TRUE(overlapping.contains({x, 0.3, 0.4})) << x;
}

TEST(Contains, TakesAClosedSoup) {
  MeshQuery query{QueryIndex(soup(octahedron()))};
  EXPECT_TRUE(query.contains({0.1, 0.1, 0.1}));
  EXPECT_FALSE(query.contains({0.9, 0.9, 0.9}));
}

TEST(Contains, RefusesMeshesThatHaveNoInside) {
  const std::vector<Vec3> none;
  TriangleMesh open = octahedron();
  open.triangles.pop_back();
  const QueryIndex index(open);
  EXPECT_THROW(MeshQuery(index).contains({0, 0, 0}), InputError);
  EXPECT_THROW(contains(index, none), InputError);
  EXPECT_THROW(contains(QueryIndex(TriangleMesh{}), none), InputError);
}

TEST(Contains, OfABatchIsThatOfEachPoint) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
  std::vector<Vec3> points(2000);
  for (Vec3& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};
  const QueryIndex index(two_spheres_and_a_box());
  MeshQuery query(index);
  for (const unsigned threads : {0u, 1u}) {
    const std::vector<bool> inside = contains(index, points, {.threads = threads});
    ASSERT_EQ(inside.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(inside[i], query.contains(points[i])) << i;
    EXPECT_GT(std::ranges::count(inside, true), 0);
    EXPECT_GT(std::ranges::count(inside, false), 0);
  }
  points[1234].x = std::nan("");
  EXPECT_THROW(contains(index, points), InputError);
}

}  // namespace
}  // namespace prohull
