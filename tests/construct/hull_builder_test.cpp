#include "prohull/hull_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <utility>

#include "construct/star.h"
#include "effort.h"
#include "geometry/float32.h"
#include "input_error.h"
#include "meshes.h"
#include "progress.h"
#include "prohull/detail/replay.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/mesh_report.h"
#include "prohull/sample.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

constexpr std::size_t kFaces = effort(1600, 400);
constexpr int kLevels = effort(3, 2);

TriangleMesh hollow_ball() { return together(sphere(kLevels + 1), inside_out(scaled(sphere(kLevels), 0.6))); }
TriangleMesh two_parts() { return together(sphere(kLevels), moved(torus(20, 12), {0, 0, 1.7})); }

std::size_t total(const RefusalCounts& counts) {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < kRefusalKinds; ++i) sum += counts[static_cast<Refusal>(i)];
  return sum;
}

EnclosureReport verify(const ProgressiveHull& hull, const TriangleMesh& original, const TriangleMesh& level) {
  return hull.side() == HullSide::Outer ? verify_enclosure(original, level) : verify_enclosure(level, original);
}

/// All that is promised of any result.
void check(const TriangleMesh& original, const HullOptions& options, const HullResult& result) {
  const ProgressiveHull& hull = result.hull;
  EXPECT_EQ(hull.side(), options.side);
  EXPECT_EQ(first_defect(hull), std::nullopt);
  EXPECT_EQ(hull.original(), original) << "bit for bit";
  EXPECT_EQ(hull.original_face_count(), original.face_count());
  EXPECT_EQ(hull.original_vertex_count(), original.vertex_count());

  const ReplayReport replay = verify_replay(hull, original);
  EXPECT_TRUE(replay.holds) << replay.why_not;
  EXPECT_EQ(replay.splits, hull.splits().size());

  const TriangleMesh base = hull.base();
  EXPECT_EQ(base.face_count(), hull.base_face_count());
  EXPECT_EQ(base, hull.level(hull.base_face_count()));
  EXPECT_EQ(base, hull.level(hull.base_face_count() + 1)) << "levels are two faces apart";
  const std::size_t between = (hull.base_face_count() + original.face_count()) / 2;
  EXPECT_LE(hull.level(between).face_count(), between);
  EXPECT_GE(hull.level(between).face_count() + 1, between);
  for (const std::size_t faces : {std::size_t{0}, (3 * hull.base_face_count() + original.face_count()) / 4, between}) {
    const TriangleMesh level = hull.level(faces);
    const MeshReport report = inspect(level);
    EXPECT_TRUE(report.is_closed_manifold()) << report.first_defect;
    EXPECT_EQ(report.euler_characteristic, inspect(original).euler_characteristic);
    EXPECT_TRUE(verify(hull, original, level).encloses) << level.face_count() << " faces";
    if (options.float32_coordinates) {
      // What it made; it may keep vertices of the original.
      for (const VertexId v : level.positions.ids())
        if (std::ranges::find(original.positions, level.positions[v]) == original.positions.end()) {
          EXPECT_TRUE(is_float32(level.positions[v]));
        }
    }
  }
  switch (result.stopped) {
    case Stopped::TargetReached:
      EXPECT_LE(hull.base_face_count(), options.target_faces);
      EXPECT_GE(hull.base_face_count() + 1, std::min(options.target_faces, original.face_count()));
      break;
    case Stopped::NoLegalCollapse:
      EXPECT_GT(hull.base_face_count(), options.target_faces);
      EXPECT_EQ(total(result.blocked), hull.base_face_count() / 2 * 3) << "every edge that is left was refused";
      break;
  }
  if (options.refuses_self_intersections()) {
    EXPECT_LE(verify_enclosure(base, base).self_intersections, verify_enclosure(original, original).self_intersections);
  }
}

struct Named {
  std::string name;
  TriangleMesh mesh;
};

std::vector<Named> meshes_to_simplify() {
  std::vector<Named> all{{"hollow_ball", hollow_ball()}, {"two_parts", two_parts()}};
  for (const char* name : {"asteroid", "torus", "knot", "box", "bracket"})
    all.push_back({name, make_sample(name, kFaces)});
  return all;
}

class BuildHull : public testing::TestWithParam<Named> {};

TEST_P(BuildHull, KeepsItsPromisesForEveryStrategySideAndKindOfCoordinates) {
  const TriangleMesh& mesh = GetParam().mesh;
  for (const Strategy strategy : {Strategy::Lazy, Strategy::Paper1, Strategy::Paper2})
    for (const HullSide side : {HullSide::Outer, HullSide::Inner})
      for (const bool float32 : {false, true}) {
        SCOPED_TRACE(testing::Message() << "strategy " << int(strategy) << ", side " << int(side) << ", float32 "
                                        << float32);
        const HullOptions options{
            .target_faces = kFaces / 8, .side = side, .strategy = strategy, .float32_coordinates = float32};
        check(mesh, options, build_hull(mesh, options));
      }
}

TEST_P(BuildHull, KeepsItsPromisesWhenNoCollapseIsLeft) {
  const TriangleMesh& mesh = GetParam().mesh;
  for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
    const HullOptions options{.target_faces = 4, .side = side};
    const HullResult result = build_hull(mesh, options);
    if (inspect(mesh).euler_characteristic != 2) {
      EXPECT_EQ(result.stopped, Stopped::NoLegalCollapse) << "only a sphere may become a tetrahedron";
    }
    check(mesh, options, result);
  }
}

TEST_P(BuildHull, IsTheSameEveryTimeAndWithHeapAndTree) {
  const TriangleMesh& mesh = GetParam().mesh;
  for (const Strategy strategy : {Strategy::Lazy, Strategy::Paper1}) {
    HullOptions options{.target_faces = kFaces / 4, .strategy = strategy};
    EXPECT_EQ(build_hull(mesh, options).hull, build_hull(mesh, options).hull);
    options.queue = QueueKind::Heap;
    const HullResult heap = build_hull(mesh, options);
    options.queue = QueueKind::RedBlackTree;
    const HullResult tree = build_hull(mesh, options);
    EXPECT_EQ(heap.hull, tree.hull);
    EXPECT_EQ(heap.linear_programs, tree.linear_programs);
    check(mesh, options, heap);
  }
}

/// Collapses only: what was joined, not where the apex lies.
bool have_equal_structure(const ProgressiveHull& a, const ProgressiveHull& b) {
  return a.splits() == b.splits() && a.base_corners() == b.base_corners();
}

TEST_P(BuildHull, DoesNotDependOnTheUnit) {
  const TriangleMesh& mesh = GetParam().mesh;
  const HullOptions options{.target_faces = kFaces / 8};
  const ProgressiveHull hull = build_hull(mesh, options).hull;
  // Powers of eight keep volumes, that is priorities, in the same eighths of octaves; scaling loses no bit.
  for (const double scale : {0x1p20, 0x1p-20, 0x1p200, 0x1p-200}) {
    const ProgressiveHull other = build_hull(scaled(mesh, scale), options).hull;
    EXPECT_TRUE(have_equal_structure(other, hull)) << scale;
    EXPECT_EQ(other.base(), scaled(hull.base(), scale)) << scale;
  }
}

TEST_P(BuildHull, IsCertifiedFarFromTheOrigin) {
  for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
    const TriangleMesh& mesh = GetParam().mesh;
    const double far = 1e6 * bounding_box(mesh).diagonal();
    const TriangleMesh away = moved(mesh, {far, -0.7 * far, 0.3 * far});
    const HullOptions options{.target_faces = kFaces / 4, .side = side};
    const HullResult result = build_hull(away, options);
    EXPECT_LT(result.hull.base_face_count(), mesh.face_count() / 2);
    check(away, options, result);
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, BuildHull, testing::ValuesIn(meshes_to_simplify()),
                         [](const auto& parameter) { return parameter.param.name; });

#ifndef PROHULL_TESTS_ARE_SLOW
TEST(BuildHullOfAGyroid, OfHighGenus) {
  const TriangleMesh gyroid = make_sample("gyroid", 22000);
  for (const HullSide side : {HullSide::Outer, HullSide::Inner}) {
    const HullOptions options{.target_faces = 2000, .side = side};
    check(gyroid, options, build_hull(gyroid, options));
  }
}
#endif

TEST(BuildHullOptions, SelfIntersectionsAreRefusedByStrategyUnlessTold) {
  constexpr auto kAllowed = SelfIntersections::Allowed, kRefused = SelfIntersections::Refused;
  EXPECT_TRUE(HullOptions{}.refuses_self_intersections());
  for (const Strategy papers : {Strategy::Paper1, Strategy::Paper2}) {
    EXPECT_FALSE(HullOptions{.strategy = papers}.refuses_self_intersections());
    EXPECT_TRUE((HullOptions{.strategy = papers, .self_intersections = kRefused}.refuses_self_intersections()));
    EXPECT_TRUE((HullOptions{.side = HullSide::Inner, .strategy = papers}.refuses_self_intersections()));
  }
  EXPECT_FALSE((HullOptions{.self_intersections = kAllowed}.refuses_self_intersections()));
  EXPECT_TRUE((HullOptions{.side = HullSide::Inner, .self_intersections = kAllowed}.refuses_self_intersections()));
}

TEST(BuildHullOptions, OutOfTheirRangesAreRefused) {
  const TriangleMesh mesh = octahedron();
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const HullOptions& wrong :
       {HullOptions{.target_faces = 3}, HullOptions{.target_faces = 0}, HullOptions{.guards = {.max_valence = 2}},
        HullOptions{.guards = {.min_compactness_ratio = -0.1}}, HullOptions{.guards = {.min_compactness_ratio = 1.1}},
        HullOptions{.guards = {.min_compactness_ratio = nan}}, HullOptions{.guards = {.sufficient_compactness = -1}},
        HullOptions{.guards = {.sufficient_compactness = 2}}, HullOptions{.guards = {.sufficient_compactness = nan}},
        HullOptions{.guards = {.max_normal_deviation = -0.1}}, HullOptions{.guards = {.max_normal_deviation = 1.6}},
        HullOptions{.guards = {.max_normal_deviation = nan}}, HullOptions{.guards = {.max_overhang = nan}},
        HullOptions{.tolerances = PerFace<double>(8, nan)},
        HullOptions{.tolerances = PerFace<double>(8, 1), .deviations = PerVertex<double>(6, nan)},
        HullOptions{.tolerances = PerFace<double>(8, 1), .deviations = PerVertex<double>(6, infinity)}})
    EXPECT_EQ(error_of([&] { build_hull(mesh, wrong); }).defect(), Defect::InvalidOption);
  EXPECT_NO_THROW(build_hull(
      mesh, {.target_faces = 4, .guards = {.max_valence = 3, .min_compactness_ratio = 1, .max_normal_deviation = 0}}));
}

TEST(BuildHullInput, OtherThanAClosedManifoldIsRefused) {
  TriangleMesh open = octahedron(), bad = octahedron(), fin = octahedron();
  open.triangles.pop_back();
  bad.positions[VertexId{2}].x = std::numeric_limits<double>::quiet_NaN();
  fin.triangles.push_back({VertexId{0}, VertexId{2}, VertexId{3}});
  for (const TriangleMesh& mesh : {open, bad, fin, TriangleMesh{}, soup(octahedron())})
    EXPECT_THROW(build_hull(mesh), InputError);
  EXPECT_THROW(build_hull(inside_out(octahedron())), InputError) << "an outer hull of it would be an inner one";
}

// Two sheets meet along an edge, which has four faces; half-edges can be paired across them so that all fits.
TEST(BuildHullInput, AnEdgeOfFourFacesIsRefusedInAnyOrderOfThem) {
  HalfEdgeMesh ring(torus(6, 3));
  Star star;
  std::uint32_t e = 0;
  do {
    gather_star(ring, EdgeId{e++}, star);
  } while (satisfies_link_condition(star));
  ring.collapse(star.edge, ring.position(star.o) * 0.5 + ring.position(star.d) * 0.5);
  TriangleMesh mesh = ring.triangle_mesh();
  ASSERT_GT(inspect(mesh).non_manifold_edges, 0u);
  std::mt19937 random(test_seed());
  for (int i = 0; i < 50; ++i) {
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
    EXPECT_THROW(build_hull(mesh, {.target_faces = 20}), InputError);
  }
}

TEST(BuildHullInput, AFaceWithTheSameVertexTwiceIsRefused) {
  TriangleMesh mesh = octahedron();
  mesh.triangles.push_back({VertexId{0}, VertexId{0}, VertexId{1}});
  mesh.triangles.push_back({VertexId{0}, VertexId{0}, VertexId{2}});
  EXPECT_THROW(build_hull(mesh), InputError);
}

// The star of their edges is all that there is: it has no link.
TEST(BuildHullInput, LeavesTwoTrianglesBackToBackAsTheyAre) {
  const TriangleMesh sheet = make({{5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
  const TriangleMesh mesh = together(sheet, sphere(2));
  for (const Strategy strategy : {Strategy::Lazy, Strategy::Paper1, Strategy::Paper2}) {
    const TriangleMesh hull = build_hull(mesh, {.target_faces = 20, .strategy = strategy}).hull.base();
    EXPECT_TRUE(verify_enclosure(mesh, hull).encloses);
    EXPECT_LT(hull.face_count(), mesh.face_count());
  }
}

TEST(BuildHullInput, UnusedVerticesAndFacesWithoutAreaAreKept) {
  TriangleMesh mesh = sphere(3);
  mesh.positions.push_back({9, 9, 9});
  // Split an edge in one of its faces only; a triangle without area closes the gap.
  const auto [a, b, c] = mesh.triangles[FaceId{5}];
  const VertexId middle = mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]) * 0.5);
  mesh.positions[middle] = mesh.positions[a];
  mesh.triangles[FaceId{5}] = {a, middle, c};
  mesh.triangles.push_back({middle, b, c});
  mesh.triangles.push_back({a, b, middle});
  ASSERT_TRUE(inspect(mesh).is_closed_manifold());
  ASSERT_GT(inspect(mesh).zero_area_faces, 0u);
  for (const auto intersections : {SelfIntersections::Allowed, SelfIntersections::Refused}) {
    const HullOptions options{.target_faces = 40, .self_intersections = intersections};
    check(mesh, options, build_hull(mesh, options));
  }
}

TEST(BuildHullProgress, GoesForwardAndCancels) {
  const TriangleMesh mesh = make_sample("asteroid", 4000);
  for (const Strategy strategy : {Strategy::Lazy, Strategy::Paper1})
    expect_progress("build", 4, [&](const Progress& progress) {
      build_hull(mesh, {.target_faces = 40, .strategy = strategy, .progress = progress});
    });
}

#ifndef PROHULL_TESTS_ARE_SLOW
constexpr std::size_t kFacesForRounds = 24000;  // so many that space is split into cells

TEST(BuildHullInRounds, KeepsItsPromisesAndIsTheSameForAnyNumberOfThreads) {
  for (const auto& [sample, side] : {std::pair("pony", HullSide::Outer), std::pair("bracket", HullSide::Inner)}) {
    const TriangleMesh mesh = make_sample(sample, kFacesForRounds);
    HullOptions options{.target_faces = 800, .side = side, .threads = 1};
    const HullResult one = build_hull(mesh, options);
    check(mesh, options, one);
    options.threads = 0;
    const HullResult many = build_hull(mesh, options);
    EXPECT_EQ(many.hull, one.hull);
    EXPECT_EQ(many.linear_programs, one.linear_programs);
    EXPECT_EQ(total(many.refusals), total(one.refusals));
  }
}

// A round may remove half of the faces, and must not go beyond the target.
TEST(BuildHullInRounds, StopsAtAnyTarget) {
  const TriangleMesh mesh = make_sample("pony", kFacesForRounds);
  for (const std::size_t part : {95, 80, 75, 60, 50, 40}) {
    const std::size_t target = mesh.face_count() * part / 100;
    const HullResult result = build_hull(mesh, {.target_faces = target});
    EXPECT_EQ(result.stopped, Stopped::TargetReached);
    EXPECT_LE(result.hull.base_face_count(), target);
    EXPECT_GE(result.hull.base_face_count() + 1, target);
  }
}

TEST(BuildHullInRounds, GoesForwardAndCancels) {
  const TriangleMesh mesh = make_sample("pony", kFacesForRounds);
  expect_progress("build", 10,
                  [&](const Progress& progress) { build_hull(mesh, {.target_faces = 100, .progress = progress}); });
}

TEST(BuildHullInRounds, LevelsOfTheSameSizeAreAsTightAsIfBuiltForIt) {
  const TriangleMesh mesh = make_sample("pony", kFacesForRounds);
  const double volume = inspect(mesh).volume;
  const ProgressiveHull all = build_hull(mesh, {.target_faces = 1000}).hull;
  for (const std::size_t faces : {15000, 9000, 5000, 2000}) {
    const double of_level = inspect(all.level(faces)).volume / volume - 1;
    const double of_hull = inspect(build_hull(mesh, {.target_faces = faces}).hull.base()).volume / volume - 1;
    EXPECT_LT(of_level, 1.1 * of_hull) << faces << " faces";
  }
}
#endif

TEST(BuildHull, OfAnotherSeedIsAnotherHull) {
  const TriangleMesh mesh = make_sample("asteroid", kFaces);
  const auto hull = [&](std::uint64_t seed) {
    return build_hull(mesh, {.target_faces = 100, .seed = seed}).hull.base();
  };
  EXPECT_EQ(hull(5), hull(5));
  EXPECT_NE(hull(5), hull(6));
}

TEST(BuildHullLimits, ValenceIsKeptAndNothingIsDoneForATargetThatIsReached) {
  const TriangleMesh mesh = make_sample("asteroid", kFaces);
  for (const unsigned valence : {6u, 8u, 12u}) {
    const HullResult result = build_hull(mesh, {.target_faces = kFaces / 8, .guards = {.max_valence = valence}});
    // A vertex keeps its valence or loses some once it is made.
    const TriangleMesh base = result.hull.base();
    PerVertex<unsigned> faces(base.vertex_count(), 0);
    for (const auto& t : base.triangles)
      for (const VertexId v : t) ++faces[v];
    for (const VertexId v : base.positions.ids())
      if (std::ranges::find(mesh.positions, base.positions[v]) == mesh.positions.end()) {
        EXPECT_LE(faces[v], valence);
      }
  }
  const HullResult nothing = build_hull(mesh, {.target_faces = 10 * kFaces});
  EXPECT_EQ(nothing.stopped, Stopped::TargetReached);
  EXPECT_TRUE(nothing.hull.splits().empty());
  EXPECT_EQ(nothing.hull.base(), mesh);
}

TEST(BuildHullStrategies, AddLittleVoid) {
  const TriangleMesh mesh = make_sample("pony", 4000);
  const double volume = signed_volume(mesh);
  for (const Strategy strategy : {Strategy::Lazy, Strategy::Paper1, Strategy::Paper2}) {
    const double outer =
        signed_volume(build_hull(mesh, {.target_faces = 1000, .strategy = strategy}).hull.base()) / volume - 1;
    EXPECT_GT(outer, 0);
    EXPECT_LT(outer, 0.1) << "strategy " << int(strategy);
    const double inner =
        signed_volume(
            build_hull(mesh, {.target_faces = 1000, .side = HullSide::Inner, .strategy = strategy}).hull.base()) /
            volume -
        1;
    EXPECT_LT(inner, 0);
    EXPECT_GT(inner, -0.1) << "strategy " << int(strategy);
  }
}

TEST(BuildHullStrategies, RefusalsHaveNames) {
  EXPECT_EQ(name_of(refusal_names(), Refusal::LinkCondition), "link_condition");
  EXPECT_EQ(name_of(refusal_names(), Refusal::SelfIntersection), "self_intersection");
  EXPECT_EQ(refusal_names().size(), kRefusalKinds);
}

TEST(BuildHullStrategies, RefusalsAreDescribedInWords) {
  RefusalCounts counts;
  EXPECT_EQ(describe_refusals(counts), "");
  for (int i = 0; i < 1200; ++i) counts.count(Refusal::LinkCondition);
  counts.count(Refusal::Compactness);
  EXPECT_EQ(describe_refusals(counts), "1,200 would pinch the surface, 1 would make a triangle too thin");
}

/// How far the farthest vertex lies outside of the box of the mesh, along an axis, relative to the diagonal of the box.
double overhang(const TriangleMesh& hull, const TriangleMesh& mesh) {
  const Box box = bounding_box(mesh), around = bounding_box(hull);
  double most = 0;
  for (int axis = 0; axis < 3; ++axis)
    most = std::max({most, box.min[axis] - around.min[axis], around.max[axis] - box.max[axis]});
  return most / box.diagonal();
}

TEST(BuildHull, MakesNoSpikes) {
  HullOptions unguarded{.target_faces = 8, .guards = kRelaxedGuards.back()};
  HullOptions guarded = unguarded;
  guarded.guards.max_overhang = 0.1;
  double most = 0;
  for (const char* const name : {"asteroid", "bracket", "pony", "torus"}) {
    const TriangleMesh mesh = make_sample(name, 1000);
    EXPECT_LE(overhang(build_hull(mesh, guarded).hull.base(), mesh), 0.1) << name;
    most = std::max(most, overhang(build_hull(mesh, unguarded).hull.base(), mesh));
  }
  EXPECT_GT(most, 0.1) << "without the guard there are some";
}

TEST(BuildHull, SaysThatSpikesAreInTheWay) {
  const TriangleMesh mesh = make_sample("asteroid", 1000);
  const HullResult result = build_hull(mesh, {.target_faces = 4, .guards = {32, 0, 0, std::numbers::pi / 2, 0}});
  EXPECT_EQ(overhang(result.hull.base(), mesh), 0);
  EXPECT_GT(result.blocked[Refusal::Overhang], 0u);
}

TEST(BuildHull, RefusesAnOverhangBelowZero) {
  EXPECT_THROW(build_hull(octahedron(), {.guards = {.max_overhang = -0.1}}), InputError);
}

}  // namespace
}  // namespace prohull
