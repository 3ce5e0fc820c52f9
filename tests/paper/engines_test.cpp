#include "paper/engines.h"

#include <gtest/gtest.h>

#include "meshes.h"
#include "prohull/detail/random_segments.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "random.h"

namespace prohull {
namespace {

TEST(Engines, AreCalledByTheirNames) {
  const ProgressiveHull hull = build_hull(meshes::sphere(2), {.target_faces = 40}).hull;
  for (const std::string_view name : all_engine_names()) {
    if (name == "auto" || name == "filter") continue;  // which answer as bvh, and for two hulls
    EXPECT_EQ(index_called(name, hull).engine_name(), name);
  }
  for (const char* name : {"fast", "filter"}) EXPECT_THROW(index_called(name, hull), InputError);
  for (const char* name : {"fast", "filter", "walk", "refinement"})
    EXPECT_THROW(index_called(name, hull.original()), InputError);
}

TEST(Engines, ThatRefineAnswerPointsAsTheTreeDoes) {
  const ProgressiveHull hull = build_hull(meshes::sphere(2), {.target_faces = 40}).hull;
  MeshQuery refined{index_called("refinement", hull)}, query{QueryIndex(hull)};
  for (const Vec3& p : random_points(bounding_box(hull.original()), 400, test_seed())) {
    ASSERT_EQ(refined.contains(p), query.contains(p));
    ASSERT_EQ(refined.closest_point(p)->face, query.closest_point(p)->face);
  }
}

TEST(Engines, ThatMissCrossingsRefuseToTellWhatIsInside) {
  const ProgressiveHull hull = build_hull(meshes::sphere(2), {.target_faces = 40}).hull;
  MeshQuery published{index_called("paper-refinement", hull)}, walk{index_called("walk", hull)};
  EXPECT_THROW(published.contains({0, 0, 0}), InputError);
  EXPECT_THROW(published.signed_distance({0, 0, 0}), InputError);
  EXPECT_EQ(published.closest_point({0, 0, 2})->face, walk.closest_point({0, 0, 2})->face);
  EXPECT_TRUE(walk.contains({0, 0, 0}));  // the tree over the mesh tells
}

}  // namespace
}  // namespace prohull
