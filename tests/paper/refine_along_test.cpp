#include "paper/refine_along.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "paper/engines.h"
#include "prohull/detail/random_segments.h"
#include "prohull/hull_builder.h"
#include "prohull/mesh_query.h"
#include "prohull/sample.h"

namespace prohull {
namespace {

const ProgressiveHull& pony() {
  static const ProgressiveHull hull = build_hull(make_sample("pony", 4000), {.target_faces = 200}).hull;
  return hull;
}

TEST(RefineAlong, FindsTheFacesOfTheOriginalAndSplitsOnlyNearby) {
  const Segment across{{0.1, -2, 0.2}, {-0.1, 2, 0.25}};
  const RefinedAlong refined = refine_along(pony(), across);
  const auto hits = MeshQuery(QueryIndex(pony().original())).all_hits(across);
  ASSERT_EQ(hits.size(), 2u);
  ASSERT_EQ(refined.found.size(), 2u);
  EXPECT_TRUE(refined.missed.empty());
  EXPECT_EQ(refined.found[0], hits[0].t);
  EXPECT_EQ(refined.found[1], hits[1].t);
  EXPECT_GT(refined.hull.face_count(), pony().base_face_count());
  EXPECT_LT(refined.hull.face_count(), pony().original_face_count() / 2);
}

TEST(RefineAlong, MissesWhatThePaperMisses) {
  const ProgressiveHull hull = build_hull(make_sample("gyroid", 24000), {.target_faces = 1000}).hull;
  const QueryIndex published = index_called("paper-refinement", hull), exact(hull);
  MeshQuery paper(published), all(exact);
  std::size_t missed = 0;
  for (const Segment& segment : random_segments(bounding_box(hull.original()), 2000, 1)) {
    const std::vector<Hit> found = paper.all_hits(segment);
    const std::size_t crossings = all.all_hits(segment).size();
    if (found.size() == crossings) continue;
    const RefinedAlong refined = refine_along(hull, segment);
    EXPECT_EQ(refined.found.size(), found.size());
    for (const Hit& hit : found) EXPECT_NE(std::ranges::find(refined.found, hit.t), refined.found.end());
    EXPECT_EQ(refined.missed.size(), crossings - found.size());
    ++missed;
  }
  EXPECT_GT(missed, 0u);
}

TEST(RefineAlong, LeavesTheHullWhereTheSegmentPassesItBy) {
  const RefinedAlong refined = refine_along(pony(), {{-3, -3, 3}, {3, -3, 3}});
  EXPECT_EQ(refined.hull, pony().base());
  EXPECT_TRUE(refined.found.empty());
  EXPECT_TRUE(refined.missed.empty());
}

}  // namespace
}  // namespace prohull
