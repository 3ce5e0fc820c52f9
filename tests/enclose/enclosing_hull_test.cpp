#include "prohull/enclosing_hull.h"

#include <gtest/gtest.h>

#include <array>

#include "geometry/float32.h"
#include "meshes.h"
#include "progress.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/mesh_report.h"
#include "prohull/sample.h"

namespace prohull {
namespace {

using namespace meshes;

EnclosingHull only(const EnclosingHulls& made) {
  EXPECT_EQ(made.hulls.size(), 1u);
  return made.hulls[0];
}

EnclosingHulls hull_of(const TriangleMesh& mesh, std::size_t faces, const EnclosingOptions& options = {}) {
  return enclosing_hulls(mesh, std::array{faces}, options);
}

/// A wrapper for tests of the ladder alone: the box around all, in so many faces that it can be simplified.
TriangleMesh box_around(const TriangleMesh& triangles, double, double offset, const Progress&) {
  const Box around = bounding_box(triangles);
  const Vec3 room = Vec3{1, 1, 1} * offset;
  return subdivided(subdivided(box(around.min - room, around.max + room)));
}

TriangleMesh without_a_face(TriangleMesh mesh) {
  mesh.triangles.pop_back();
  return mesh;
}

TEST(EnclosingHull, OfAClosedMeshIsThatOfBuildHull) {
  const TriangleMesh mesh = make_sample("asteroid", 2000);
  const EnclosingHull hull = only(hull_of(mesh, 200));
  EXPECT_EQ(hull.mesh, build_hull(mesh, {.target_faces = 200}).hull.base());
  EXPECT_TRUE(hull.certified);
  EXPECT_EQ(hull.proof, "replay");
  EXPECT_TRUE(hull.target_reached);
  ASSERT_TRUE(hull.levels);
  EXPECT_EQ(hull.levels->original(), mesh);
}

TEST(EnclosingHull, OfOneBudgetIsTheOnlyOne) {
  const TriangleMesh mesh = make_sample("asteroid", 2000);
  const EnclosingHull hull = enclosing_hull(mesh, 200);
  EXPECT_EQ(hull.mesh, only(hull_of(mesh, 200)).mesh);
  EXPECT_TRUE(hull.certified && hull.target_reached && hull.within_bounds && hull.notes.empty());
  EXPECT_EQ(hull.void_ratio, signed_volume(hull.mesh) / signed_volume(mesh) - 1);
  EXPECT_EQ(hull.wrap_alpha, 0);
}

TEST(EnclosingHull, HasALevelForEachBudgetInTheirOrder) {
  const TriangleMesh mesh = make_sample("asteroid", 2000);
  const EnclosingHulls made = enclosing_hulls(mesh, std::array<std::size_t, 3>{400, 1000, 100});
  ASSERT_EQ(made.hulls.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t faces = std::array{400, 1000, 100}[i];
    EXPECT_EQ(made.hulls[i].target_faces, faces);
    EXPECT_EQ(made.hulls[i].mesh.face_count(), faces);
    EXPECT_TRUE(verify_enclosure(mesh, made.hulls[i].mesh).encloses);
    ASSERT_TRUE(made.hulls[i].levels);
    EXPECT_EQ(made.hulls[i].levels->base(), made.hulls[i].mesh);
  }
  EXPECT_THROW(enclosing_hulls(mesh, {}), InputError);
}

TEST(EnclosingHull, KeepsTheBoundsWithAsFewFacesAsItCan) {
  const TriangleMesh mesh = make_sample("asteroid", 2000);
  const double volume = signed_volume(mesh);
  for (const bool tight : {false, true}) {
    EnclosingOptions options{.bounds = {.max_void_ratio = 0.05}, .tight = tight};
    const EnclosingHull hull = only(hull_of(mesh, 4, options));
    EXPECT_TRUE(hull.certified && hull.within_bounds);
    EXPECT_LE(signed_volume(hull.mesh), 1.05 * volume);
    EXPECT_GT(signed_volume(hull.mesh), 1.04 * volume) << "nearly used up";
    options.bounds = {.max_added_volume = 0.05 * volume};
    EXPECT_EQ(only(hull_of(mesh, 4, options)).mesh, hull.mesh);
  }
  const EnclosingHull inner =
      only(hull_of(mesh, 4, {.hull = {.side = HullSide::Inner}, .bounds = {.max_void_ratio = 0.05}}));
  EXPECT_TRUE(inner.certified);
  EXPECT_GE(signed_volume(inner.mesh), 0.95 * volume);
}

TEST(EnclosingHull, CoversWhatRepairHasDropped) {
  // A cavity.
  const TriangleMesh mesh = together(make_sample("asteroid", 500), inside_out(scaled(octahedron(), 0.1)));
  const EnclosingHulls filled = hull_of(mesh, 100);
  EXPECT_EQ(filled.input.repairs.dropped_components, 1u);
  EXPECT_EQ(filled.input.dropped.face_count(), octahedron().face_count());
  EXPECT_TRUE(only(filled).certified);
  EXPECT_EQ(inspect(only(filled).mesh).components, 1u);
  EXPECT_TRUE(verify_cover(filled.input.dropped, only(filled).mesh).encloses);
  const EnclosingHulls kept = hull_of(mesh, 100, {.keep_cavities = true});
  EXPECT_TRUE(only(kept).certified);
  EXPECT_EQ(kept.input.repairs.dropped_components, 0u);
  EXPECT_EQ(inspect(only(kept).mesh).components, 2u);
  // A face without area that sticks out: the hull of the rest does not cover it.
  TriangleMesh hair = make_sample("asteroid", 500);
  const VertexId tip = hair.positions.push_back({5, 0, 0});
  hair.triangles.push_back({VertexId(0), tip, tip});
  EXPECT_FALSE(
      verify_cover(hair, build_hull(make_sample("asteroid", 500), {.target_faces = 100}).hull.base()).encloses);
  const EnclosingHulls around = hull_of(hair, 100, {.wrap = box_around});
  EXPECT_EQ(around.input.dropped.face_count(), 1u);
  EXPECT_TRUE(only(around).certified);
  EXPECT_TRUE(verify_cover(hair, only(around).mesh).encloses);
}

TEST(EnclosingHull, RefusesWhatIsNotClosedWithoutAWrapper) {
  const TriangleMesh open = without_a_face(octahedron());
  EXPECT_THROW(hull_of(open, 100), InputError);
  EXPECT_THROW(hull_of(open, 100, {.repair = Repair::None, .wrap = box_around}), InputError);
  EXPECT_THROW(hull_of(open, 100, {.hull = {.side = HullSide::Inner}, .wrap = box_around}), InputError);
  EXPECT_THROW(hull_of({}, 100, {.wrap = box_around}), InputError);
}

TEST(EnclosingHull, OfAWrapMovesTowardsTheTriangles) {
  const TriangleMesh open = without_a_face(subdivided(octahedron()));
  const EnclosingHulls made = hull_of(open, 40, {.wrap = box_around});
  const EnclosingHull hull = only(made);
  EXPECT_TRUE(hull.certified);
  EXPECT_EQ(hull.proof, "coverage");
  EXPECT_TRUE(verify_cover(open, hull.mesh).encloses);
  EXPECT_FALSE(made.input.closed);
  EXPECT_NE(made.input.obstacle.find("open edges"), std::string::npos) << made.input.obstacle;
  EXPECT_LT(signed_volume(hull.mesh), 0.97 * made.solids[hull.solid].volume);

  const EnclosingHull level = only(hull_of(open, 40, {.levels = true, .wrap = box_around}));
  ASSERT_TRUE(level.levels) << "asked for, so they stay where they are";
  EXPECT_EQ(level.levels->base(), level.mesh);
  EXPECT_TRUE(level.certified);
}

TEST(EnclosingHull, OfAWrapIsNotTrusted) {
  const auto too_small = [](const TriangleMesh&, double, double, const Progress&) {
    return subdivided(box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}));
  };
  const EnclosingHull hull = only(hull_of(without_a_face(octahedron()), 40, {.wrap = too_small}));
  EXPECT_FALSE(hull.certified);
  const auto open = [](const TriangleMesh& mesh, double, double, const Progress&) { return mesh; };
  EXPECT_THROW(hull_of(without_a_face(octahedron()), 40, {.wrap = open}), InputError);
}

TEST(EnclosingHull, TriesCoarserWrapsUntilOneIsAsAsked) {
  std::vector<double> alphas;
  const auto wrapper = [&](const TriangleMesh& mesh, double alpha, double offset, const Progress& progress) {
    alphas.push_back(alpha / bounding_box(mesh).diagonal());
    // Eight boxes that cannot be one until alpha is great.
    TriangleMesh wrap = box_around(mesh, alpha, offset, progress);
    if (alphas.size() == 1)
      for (int i = 1; i < 8; ++i) wrap = together(wrap, moved(octahedron(), {10.0 * i, 0, 0}));
    return wrap;
  };
  const EnclosingHulls made = hull_of(without_a_face(octahedron()), 20, {.wrap = wrapper});
  EXPECT_EQ(alphas.size(), 2u);
  EXPECT_DOUBLE_EQ(alphas[0], 1.0 / 50);
  EXPECT_DOUBLE_EQ(alphas[1], 1.0 / 20);
  EXPECT_EQ(only(made).solid, 1u);
  EXPECT_TRUE(only(made).target_reached);
  ASSERT_EQ(only(made).notes.size(), 1u);
  EXPECT_NE(only(made).notes[0].find("no legal collapse"), std::string::npos) << only(made).notes[0];
}

TEST(EnclosingHull, CanBeCancelledAnywhere) {
  const TriangleMesh open = without_a_face(make_sample("asteroid", 1000));
  const UnthrottledProgress unthrottled;
  int calls = 0;
  EnclosingOptions options{.hull = {.threads = 1}, .wrap = box_around};
  options.progress = [&](std::string_view, double) { return ++calls > 0; };
  hull_of(open, 40, options);
  const int all = calls;
  for (int most = 0; most < all; most += 1 + all / 20) {
    calls = 0;
    options.progress = [&](std::string_view, double) { return ++calls <= most; };
    EXPECT_THROW(hull_of(open, 40, options), Cancelled) << most << " of " << all;
  }
}

#ifdef PROHULL_HAS_WRAP

/// Everything that is wrong with meshes.
std::vector<std::pair<std::string, TriangleMesh>> defective_meshes() {
  const TriangleMesh rock = make_sample("asteroid", 1000);
  TriangleMesh duplicated = together(octahedron(), octahedron());
  TriangleMesh sheet = make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  TriangleMesh two_sided = make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
  TriangleMesh needle = make({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 1}}, {{0, 1, 2}, {0, 1, 3}});
  TriangleMesh not_finite = rock;
  not_finite.positions[VertexId(3)].y = std::numeric_limits<double>::quiet_NaN();
  TriangleMesh fin = octahedron();
  fin.triangles.push_back({VertexId(0), VertexId(2), fin.positions.push_back({2, 2, 1})});
  return {{"open", without_a_face(rock)},
          {"duplicated", duplicated},
          {"sheet", sheet},
          {"two-sided sheet", two_sided},
          {"needle", needle},
          {"not finite", not_finite},
          {"fin", fin},
          {"overlapping", together(octahedron(), moved(octahedron(), {0.5, 0.1, 0.2}))},
          {"far away", moved(without_a_face(rock), {1e4, -1e4, 1e4})}};
}

TEST(EnclosingHull, CoversWhateverIsWrong) {
  for (const auto& [name, mesh] : defective_meshes())
    for (const bool float32 : {false, true}) {
      const EnclosingHulls made =
          hull_of(mesh, 100, {.hull = {.relax_guards = true, .float32_coordinates = float32}, .wrap = alpha_wrap});
      const EnclosingHull hull = only(made);
      EXPECT_TRUE(hull.certified) << name;
      EXPECT_TRUE(verify_cover(made.input.original, hull.mesh).encloses) << name;
      EXPECT_EQ(hull.self_intersections, 0u) << name;
      EXPECT_LE(hull.mesh.face_count(), 100u) << name;
      for (const Vec3& p : hull.mesh.positions) ASSERT_TRUE(!float32 || is_float32(p)) << name;
    }
}

TEST(EnclosingHull, SealsHolesUpToTheirSize) {
  // A ball of radius 1 with an opening some 0.6 across.
  TriangleMesh ball = sphere(4), open{ball.positions, {}};
  for (const FaceId f : ball.triangles.ids())
    if (ball.triangle(f).a.z < 0.95) open.triangles.push_back(ball.triangles[f]);
  const double solid = signed_volume(ball);
  const auto volume = [&](double seal) {
    return signed_volume(only(hull_of(open, 500, {.seal_holes = seal, .wrap = alpha_wrap})).mesh);
  };
  EXPECT_LT(volume(0), 0.5 * solid) << "the wrap goes in";
  EXPECT_GT(volume(0.8), 0.9 * solid);
  const EnclosingHulls shell = hull_of(open, 500, {.wrap = alpha_wrap});
  ASSERT_FALSE(only(shell).notes.empty());
  EXPECT_NE(only(shell).notes[0].find("--seal-holes"), std::string::npos) << only(shell).notes[0];
}

TEST(AlphaWrap, CanBeCancelled) {
  EXPECT_THROW(alpha_wrap(make_sample("asteroid", 1000), 0.02, 0.001, [](std::string_view, double) { return false; }),
               Cancelled);
}

#endif

}  // namespace
}  // namespace prohull
