// Which proof applies to a hull and its original, and what the user is told beside the verdict.
#include "prohull/verification.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "meshes.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "prohull/sample.h"

namespace prohull {
namespace {

using namespace meshes;

const TriangleMesh kSmall = box({0, 0, 0}, {1, 1, 1}), kLarge = box({-1, -1, -1}, {2, 2, 2});

TriangleMesh without_a_face(TriangleMesh mesh) {
  mesh.triangles.pop_back();
  return mesh;
}

/// One triangle more, outside of kLarge.
TriangleMesh with_a_stray_triangle(TriangleMesh mesh) {
  return together(std::move(mesh), make({{9, 0, 0}, {9, 1, 0}, {9, 0, 1}}, {{0, 1, 2}}));
}

bool says(const Verification& found, std::string_view words) {
  for (const std::string& note : found.notes)
    if (note.find(words) != std::string::npos) return true;
  return false;
}

TEST(VerifyHull, OfAClosedOriginalTheSolidMustBeEnclosed) {
  const Verification found = verify_hull(kLarge, kSmall);
  EXPECT_TRUE(found.encloses);
  EXPECT_EQ(found.proof, "enclosure");
  EXPECT_TRUE(found.original_closed);
  EXPECT_FALSE(found.every_triangle);
  EXPECT_DOUBLE_EQ(found.hull_volume, 27);
  EXPECT_DOUBLE_EQ(found.original_volume, 1);
  EXPECT_DOUBLE_EQ(found.void_ratio, 26);
  EXPECT_TRUE(found.notes.empty());
  const Verification reversed = verify_hull(kSmall, kLarge);
  EXPECT_FALSE(reversed.encloses);
  EXPECT_EQ(reversed.faces_outside, 12u);
  EXPECT_FALSE(reversed.worst.empty());
}

TEST(VerifyHull, OfAnOpenOriginalEveryTriangleMustBeCovered) {
  const Verification found = verify_hull(kLarge, without_a_face(kSmall));
  EXPECT_TRUE(found.encloses);
  EXPECT_EQ(found.proof, "coverage");
  EXPECT_FALSE(found.original_closed);
  EXPECT_TRUE(found.every_triangle);
  EXPECT_TRUE(std::isnan(found.original_volume));
  EXPECT_TRUE(std::isnan(found.void_ratio));
  EXPECT_TRUE(says(found, "not closed"));
  const Verification stray = verify_hull(kLarge, with_a_stray_triangle(kSmall));
  EXPECT_FALSE(stray.encloses);
  EXPECT_EQ(stray.faces_outside, 1u);
}

TEST(VerifyHull, ThatEncloseASolidMayLeaveATriangleOfItUncovered) {
  // The inner tetrahedron faces inwards and lies far outside, so that the solid does not count it after the other,
  // equal one that faces outwards: together they wind around nothing.
  const TriangleMesh away = tetrahedron({9, 9, 9}, {10, 9, 9}, {9, 10, 9}, {9, 9, 10});
  const TriangleMesh original = together(together(kSmall, away), inside_out(away));
  const Verification solid = verify_hull(kLarge, original);
  const Verification all = verify_hull(kLarge, original, HullSide::Outer, {.every_triangle = true});
  EXPECT_EQ(all.proof, "enclosure");
  EXPECT_TRUE(all.every_triangle);
  EXPECT_FALSE(all.encloses);
  EXPECT_GT(all.faces_outside, 0u);
  EXPECT_TRUE(all.original_closed);
  EXPECT_GE(all.faces_outside, solid.faces_outside);
  EXPECT_TRUE(verify_hull(kLarge, kSmall, HullSide::Outer, {.every_triangle = true}).encloses);
}

TEST(VerifyHull, OfAnInnerHullTheOriginalMustEncloseIt) {
  const Verification found = verify_hull(kSmall, kLarge, HullSide::Inner);
  EXPECT_TRUE(found.encloses);
  EXPECT_EQ(found.side, HullSide::Inner);
  EXPECT_DOUBLE_EQ(found.void_ratio, 1.0 / 27 - 1);
  EXPECT_FALSE(verify_hull(kLarge, kSmall, HullSide::Inner).encloses);
}

TEST(VerifyHull, RefusesWhatAnInnerHullCannotProve) {
  EXPECT_THROW(verify_hull(kSmall, without_a_face(kLarge), HullSide::Inner), InputError);
  EXPECT_THROW(verify_hull(kSmall, kLarge, HullSide::Inner, {.every_triangle = true}), InputError);
}

TEST(VerifyHull, ReplaysAProgressiveHull) {
  const TriangleMesh mesh = make_sample("asteroid", 1000);
  const ProgressiveHull hull = build_hull(mesh, {.target_faces = 100}).hull;
  const Verification found = verify_hull(hull, mesh);
  EXPECT_TRUE(found.encloses);
  EXPECT_EQ(found.proof, "replay");
  EXPECT_EQ(found.splits, hull.splits().size());
  EXPECT_GT(found.signs, found.splits);
  EXPECT_DOUBLE_EQ(found.void_ratio, signed_volume(hull.base()) / signed_volume(mesh) - 1);
  const Verification open = verify_hull(hull, without_a_face(mesh));
  EXPECT_TRUE(open.encloses) << "the finest level covers the rest";
  EXPECT_EQ(open.proof, "replay");
  const Verification foreign = verify_hull(hull, kSmall);
  EXPECT_FALSE(foreign.encloses);
  EXPECT_FALSE(foreign.why_not.empty());
  const Verification stray = verify_hull(hull, with_a_stray_triangle(mesh));
  EXPECT_FALSE(stray.encloses);
  EXPECT_TRUE(stray.why_not.empty());
  EXPECT_EQ(stray.faces_outside, 1u);
}

TEST(VerifyHull, ReplaysAnInnerHullByItsOwnSide) {
  const TriangleMesh mesh = make_sample("asteroid", 1000);
  const ProgressiveHull hull = build_hull(mesh, {.target_faces = 100, .side = HullSide::Inner}).hull;
  EXPECT_TRUE(verify_hull(hull, mesh).encloses);
  EXPECT_EQ(verify_hull(hull, mesh).side, HullSide::Inner);
  EXPECT_THROW(verify_hull(hull, without_a_face(mesh)), InputError);
}

TEST(VerifyHull, LeavesOutFacesThatAreNotFiniteAndSaysSo) {
  TriangleMesh original = kSmall;
  const VertexId far = original.positions.push_back({std::numeric_limits<double>::infinity(), 0, 0});
  original.triangles.push_back({VertexId{0}, VertexId{1}, far});
  const Verification found = verify_hull(kLarge, original);
  EXPECT_TRUE(found.encloses);
  EXPECT_TRUE(found.original_closed) << "what is left is";
  EXPECT_TRUE(says(found, "1 face of the original is not finite"));
}

TEST(VerifyHull, TurnsMeshesThatAreInsideOutAndSaysSo) {
  const Verification found = verify_hull(kLarge, inside_out(kSmall));
  EXPECT_TRUE(found.encloses);
  EXPECT_EQ(found.turned_original_faces, 12u);
  EXPECT_EQ(found.turned_hull_faces, 0u);
  EXPECT_TRUE(says(found, "12 faces of the original face inwards"));
  EXPECT_EQ(verify_hull(inside_out(kLarge), kSmall).turned_hull_faces, 12u);
}

TEST(VerifyHull, TellsOfSizesThatDifferAsUnitsDo) {
  const TriangleMesh mesh = make_sample("asteroid", 200);
  for (const double hull_size : {1.0, 1.3}) {
    const TriangleMesh hull = scaled(mesh, hull_size);
    EXPECT_TRUE(says(verify_hull(hull, scaled(mesh, 1000)), "1,000 times smaller"));
    EXPECT_TRUE(says(verify_hull(hull, scaled(mesh, 0.001)), "1,000 times larger"));
    EXPECT_TRUE(says(verify_hull(hull, scaled(mesh, 25.4)), "25.4 times smaller"));
    EXPECT_TRUE(says(verify_hull(hull, scaled(mesh, 1 / 25.4)), "25.4 times larger"));
    for (const double same_unit : {0.1, 0.5, 1.0, 3.0, 100.0, 1e5})
      EXPECT_FALSE(says(verify_hull(hull, scaled(mesh, same_unit)), "times")) << same_unit;
  }
  const ProgressiveHull levels = build_hull(mesh, {.target_faces = 100}).hull;
  EXPECT_TRUE(says(verify_hull(levels, scaled(mesh, 0.001)), "1,000 times larger"));
}

TEST(VerifyHull, TellsProgressThatNeverRunsBackAndCanBeCancelled) {
  double last = 0;
  const auto watch = [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    return true;
  };
  const TriangleMesh mesh = make_sample("asteroid", 2000);
  EXPECT_TRUE(verify_hull(mesh, mesh, HullSide::Outer, {.every_triangle = true, .progress = watch}).encloses);
  EXPECT_EQ(last, 1);
  EXPECT_THROW(verify_hull(mesh, mesh, HullSide::Outer, {.progress = [](std::string_view, double) { return false; }}),
               Cancelled);
}

}  // namespace
}  // namespace prohull
