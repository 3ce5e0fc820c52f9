#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "effort.h"
#include "geometry/predicates.h"
#include "hull/void_complex.h"
#include "mesh/half_edge_mesh.h"
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

struct Pair {
  std::string name;
  ProgressiveHull outer, inner;
};

Pair pair_of(std::string name, const TriangleMesh& mesh, std::size_t faces) {
  return {std::move(name), build_hull(mesh, {.target_faces = faces}).hull,
          build_hull(mesh, {.target_faces = faces, .side = HullSide::Inner}).hull};
}

/// With flat parts, several components, handles, folds.
const std::vector<Pair>& pairs() {
  static const std::vector<Pair> all{
      pair_of("asteroid", make_sample("asteroid", 2000), 60), pair_of("torus", torus(24, 16), 60),
      pair_of("bracket", make_sample("bracket", 1000), 60),
      pair_of("three parts",
              together(together(sphere(3), moved(torus(16, 10), {3, 0, 0})), subdivided(box({-1, 2, -1}, {1, 4, 1}))),
              60),
      pair_of("not simplified", octahedron(), 100)};
  return all;
}

std::vector<Segment> segments_for(const TriangleMesh& mesh, int count, unsigned seed) {
  const auto size = static_cast<std::size_t>(count);
  std::vector<Segment> segments = awkward_segments(mesh, size, seed);
  for (const Segment& s : random_segments(bounding_box(mesh), size / 2, seed)) segments.push_back(s);
  return segments;
}

void expect_answers_of_brute_force(const QueryIndex& index, const TriangleMesh& mesh,
                                   const std::vector<Segment>& segments) {
  MeshQuery truth{QueryIndex(mesh, Engine::Brute)}, query{index};
  const auto expect_same = [&](const auto& line) {
    const auto all = truth.all_hits(line);
    ASSERT_EQ(query.all_hits(line), all);
    ASSERT_EQ(query.first_hit(line), truth.first_hit(line));
    const auto any = query.any_hit(line);
    ASSERT_EQ(any.has_value(), !all.empty());
    ASSERT_TRUE(!any || std::ranges::count(all, *any) == 1);
    ASSERT_EQ(query.crosses(line), !all.empty());
  };
  for (const Segment& s : segments) {
    expect_same(s);
    expect_same(Ray{s.a, s.b - s.a});
    if (testing::Test::HasFatalFailure()) return;
  }
}

class PairEngines : public testing::TestWithParam<const char*> {};

TEST_P(PairEngines, AnswerAsBruteForceDoes) {
  for (const auto& [name, outer, inner] : pairs()) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = outer.original();
    expect_answers_of_brute_force(index_called(GetParam(), outer, inner), mesh,
                                  segments_for(mesh, rounds(50), test_seed()));
    MeshQuery truth{QueryIndex(mesh)}, query{index_called(GetParam(), outer, inner)};
    const Triangle t{mesh.positions[VertexId{0}], {0, 0, 0}, {1, 1, 0.5}};
    EXPECT_EQ(query.faces_met(t), truth.faces_met(t));
    for (const Segment& s : segments_for(mesh, rounds(10), test_seed()))
      for (const Vec3& p : {s.a, s.b}) EXPECT_EQ(query.contains(p), truth.contains(p));
  }
}

// The tree over the original is made by the first query that needs it, in the middle of a batch.
TEST_P(PairEngines, AnswerBatchesOfPointsAsTheTreeDoes) {
  const TriangleMesh mesh = torus(48, 24);
  const Pair pair = pair_of("torus", mesh, 400);
  const std::vector<Vec3> points = random_points(bounding_box(mesh), 5000, test_seed());
  const QueryIndex hulls = index_called(GetParam(), pair.outer, pair.inner), tree(mesh);
  EXPECT_EQ(contains(hulls, points), contains(tree, points));
  EXPECT_EQ(closest_points(hulls, points), closest_points(tree, points));
}

INSTANTIATE_TEST_SUITE_P(Query, PairEngines, testing::Values("walk", "filter"));

/// Small integer coordinates: closed surfaces that touch, cross and cover themselves, with faces of no area, sheets of
/// no thickness, and parts that are inside out; or boxes with dents.
TriangleMesh lattice_mesh(std::mt19937& random) {
  const auto integer = [&](int least, int most) { return std::uniform_int_distribution<int>(least, most)(random); };
  const auto point = [&] { return Vec3{double(integer(0, 3)), double(integer(0, 3)), double(integer(0, 3))}; };
  TriangleMesh mesh;
  switch (integer(0, 3)) {
    case 0:
      mesh = subdivided(octahedron());
      break;
    case 1:
      mesh = torus(5, 4);
      break;
    default:
      mesh = subdivided(subdivided(box({0, 0, 0}, {4, 4, 4})));
  }
  const bool wild = mesh.face_count() < 100;
  for (Vec3& p : mesh.positions)
    if (wild || integer(0, 9) == 0) p = point();
  return mesh;
}

/// Random collapses, as many as can be found in `tries`. The apex lies on lattice points too, so that many tetrahedra
/// are flat.
ProgressiveHull random_hull(const TriangleMesh& original, HullSide side, std::mt19937& random, int tries) {
  HalfEdgeMesh mesh(original);
  std::vector<VertexSplit> splits;
  const Side wrong = side == HullSide::Outer ? Side::Inside : Side::Outside;
  for (int i = 0; i < tries && mesh.face_count() > 4; ++i) {
    const HalfEdgeId h{static_cast<std::uint32_t>(random() % (3 * original.face_count()))};
    if (mesh.tail(h) == kNoVertex) continue;
    std::set<VertexId> near_o, star{mesh.tail(h), mesh.tip(h)};
    std::set<FaceId> faces;
    std::size_t common = 0;
    for (const HalfEdgeId a : mesh.around(mesh.tail(h))) near_o.insert(mesh.tip(a)), faces.insert(FaceId(index(a) / 3));
    for (const HalfEdgeId a : mesh.around(mesh.tip(h))) {
      common += near_o.contains(mesh.tip(a));
      star.insert(mesh.tip(a)), faces.insert(FaceId(index(a) / 3));
    }
    if (common != 2) continue;
    star.insert(near_o.begin(), near_o.end());
    std::vector<VertexId> corners(star.begin(), star.end());
    const auto coordinate = [&] { return std::uniform_int_distribution<int>(-2, 12)(random) / 2.0; };
    const Vec3 apex = random() % 2 ? mesh.position(corners[random() % corners.size()])
                                   : Vec3{coordinate(), coordinate(), coordinate()};
    if (std::ranges::any_of(faces, [&](FaceId f) {
          const auto [a, b, c] = mesh.corners(f);
          return prohull::side(mesh.position(a), mesh.position(b), mesh.position(c), apex) == wrong;
        }))
      continue;
    splits.push_back(mesh.collapse(h, apex));
  }
  std::vector<VertexId> corners;
  for (std::uint32_t f = 0; f < original.face_count(); ++f)
    for (const VertexId v : mesh.corners(FaceId(f))) corners.push_back(v);
  return ProgressiveHull(side, original.vertex_count(), mesh.positions(), corners, splits);
}

TEST(Walk, FindsAllCrossingsOfMeshesWithFlatVoidAndSheetsWithoutThickness) {
  std::mt19937 random(test_seed());
  std::size_t flat = 0, solid = 0, with_sheets = 0;
  for (int round = 0; round < 8; ++round) {
    const TriangleMesh mesh = lattice_mesh(random);
    const ProgressiveHull outer = random_hull(mesh, HullSide::Outer, random, 500),
                          inner = random_hull(mesh, HullSide::Inner, random, 500);
    ASSERT_EQ(first_defect(outer), std::nullopt);
    const VoidComplex complex(outer);
    for (std::uint32_t t = 0; t < complex.size(); ++t) ++(complex.is_flat(t) ? flat : solid);
    with_sheets += !sheets_without_thickness(complex).empty();
    const auto segments = segments_for(mesh, 40, static_cast<unsigned>(random()));
    expect_answers_of_brute_force(index_called("walk", outer, inner), mesh, segments);
    expect_answers_of_brute_force(QueryIndex(outer, inner, Engine::Filter), mesh, segments);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(flat, 10u);
  EXPECT_GT(solid, 10u);
  EXPECT_GT(with_sheets, 0u);
}

TEST(Walk, WithAnOuterHullAloneFindsFirstCrossingsFromOutside) {
  std::size_t hits = 0;
  for (const auto& [name, outer, inner] : pairs()) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = outer.original();
    Box around;
    for (const Vec3& p : outer.positions()) around.extend(p);
    MeshQuery truth{QueryIndex(mesh, Engine::Brute)}, query{index_called("walk", outer)};
    for (const Segment& s : segments_for(mesh, rounds(60), test_seed())) {
      const auto all = truth.all_hits(s), found = query.all_hits(s);
      ASSERT_TRUE(std::ranges::all_of(found, [&](const Hit& hit) { return std::ranges::count(all, hit) == 1; }));
      if (around.overlaps({s.a, s.a})) continue;
      ASSERT_EQ(query.first_hit(s), truth.first_hit(s));
      ASSERT_EQ(query.any_hit(s).has_value(), !all.empty());
      const Ray ray{s.a, s.b - s.a};
      ASSERT_EQ(query.first_hit(ray), truth.first_hit(ray));
      hits += !all.empty();
    }
  }
  EXPECT_GT(hits, 0u);
}

TEST(PairIndex, TakesAnOuterAndAnInnerHullOfOneMesh) {
  const auto& [name, outer, inner] = pairs()[1];
  EXPECT_THROW(QueryIndex(inner, outer), InputError);
  EXPECT_THROW(QueryIndex(outer, pairs()[0].inner), InputError);
  EXPECT_THROW(index_called("walk", inner), InputError);
  EXPECT_THROW(QueryIndex(outer, Engine::Filter), InputError);
  EXPECT_THROW(index_called("walk", outer.original()), InputError);
  EXPECT_EQ(QueryIndex(outer, inner).engine_name(), "bvh");
  EXPECT_EQ(index_called("walk", outer, inner).engine_name(), "walk");
  EXPECT_EQ(index_called("refinement", outer, inner).engine_name(), "refinement");
}

}  // namespace
}  // namespace prohull
