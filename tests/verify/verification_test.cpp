// Which proof applies to a hull and its original, and what the user is told beside the verdict.
#include "prohull/verification.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "geometry/triangle_predicates.h"
#include "meshes.h"
#include "progress.h"
#include "prohull/detail/inside_out.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "prohull/sample.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

const TriangleMesh kSmallCube = box({0, 0, 0}, {1, 1, 1}), kLargeCube = box({-1, -1, -1}, {2, 2, 2});

TriangleMesh without_a_face(TriangleMesh mesh) {
  mesh.triangles.pop_back();
  return mesh;
}

/// One triangle more, outside of kLargeCube.
TriangleMesh with_a_stray_triangle(TriangleMesh mesh) {
  return together(std::move(mesh), make({{9, 0, 0}, {9, 1, 0}, {9, 0, 1}}, {{0, 1, 2}}));
}

bool says(const Verification& found, std::string_view words) {
  for (const std::string& note : found.notes)
    if (note.find(words) != std::string::npos) return true;
  return false;
}

/// A box with a spike that was pushed in through it and out of the other side: there its faces look inwards, and bound
/// nothing. Only the tip, at z = -2, sticks out.
TriangleMesh box_with_a_spike_inside_out() {
  TriangleMesh mesh = subdivided(kSmallCube);
  for (const VertexId v : mesh.positions.ids())
    if (mesh.positions[v] == Vec3{0.5, 0.5, 1}) mesh.positions[v].z = -2;
  return mesh;
}

TEST(VerifyHull, OfAClosedOriginalTheSolidMustBeEnclosedAndEveryTriangleCovered) {
  const Verification found = verify_hull(kLargeCube, kSmallCube);
  EXPECT_TRUE(found.encloses);
  EXPECT_EQ(found.proof, "enclosure");
  EXPECT_TRUE(found.original_closed);
  EXPECT_EQ(found.covers_triangles, Answer::Yes);
  EXPECT_TRUE(found.why_not.empty());
  EXPECT_DOUBLE_EQ(found.hull_volume, 27);
  EXPECT_DOUBLE_EQ(found.original_volume, 1);
  EXPECT_DOUBLE_EQ(found.void_ratio, 26);
  EXPECT_TRUE(found.notes.empty());
  const Verification reversed = verify_hull(kSmallCube, kLargeCube);
  EXPECT_FALSE(reversed.encloses);
  EXPECT_EQ(reversed.faces_outside, 12u);
  EXPECT_FALSE(reversed.worst.empty());
  EXPECT_FALSE(reversed.why_not.empty());
}

TEST(VerifyHull, AnswersForTheSolidAndForTheTrianglesApart) {
  const auto answers = [](const Verdict& found) { return std::pair(found.encloses_solid, found.covers_triangles); };
  const TriangleMesh folded = box_with_a_spike_inside_out(), open = without_a_face(kSmallCube);
  EXPECT_EQ(answers(verify_hull(kLargeCube, kSmallCube)), std::pair(Answer::Yes, Answer::Yes));
  EXPECT_EQ(answers(verify_hull(kSmallCube, kLargeCube)), std::pair(Answer::No, Answer::No));
  EXPECT_EQ(answers(verify_hull(kLargeCube, folded)), std::pair(Answer::Yes, Answer::No));
  EXPECT_EQ(answers(verify_hull(kLargeCube, folded, HullSide::Outer, {.solid_only = true})),
            std::pair(Answer::Yes, Answer::NotAsked));
  EXPECT_EQ(answers(verify_hull(kLargeCube, open)), std::pair(Answer::NotAsked, Answer::Yes));
  EXPECT_EQ(answers(verify_hull(kLargeCube, open, HullSide::Outer, {.closed = &kSmallCube})),
            std::pair(Answer::Yes, Answer::Yes));
  EXPECT_EQ(answers(verify_hull(kSmallCube, kLargeCube, HullSide::Inner)), std::pair(Answer::Yes, Answer::Yes));
}

TEST(VerifyHull, SaysNoToAFoldThatSticksOut) {
  const TriangleMesh original = box_with_a_spike_inside_out();
  const Verification found = verify_hull(kLargeCube, original);
  EXPECT_FALSE(found.encloses);
  EXPECT_NE(found.why_not.find("folds"), std::string::npos) << found.why_not;
  ASSERT_FALSE(found.worst.empty());
  EXPECT_DOUBLE_EQ(found.worst[0].distance, 1);
  const Triangle t = original.triangle(found.worst[0].face);
  EXPECT_TRUE(std::min({t.a.z, t.b.z, t.c.z}) == -2) << "the face has its number in the original";
  const Verification solid = verify_hull(kLargeCube, original, HullSide::Outer, {.solid_only = true});
  EXPECT_TRUE(solid.encloses) << solid.why_not;
  EXPECT_EQ(solid.covers_triangles, Answer::NotAsked);
  EXPECT_TRUE(verify_hull(box({-1, -1, -2}, {2, 2, 2}), original).encloses);
}

TEST(VerifyHull, SaysNoToFacesWithoutAreaThatStickOut) {
  TriangleMesh original = together(kSmallCube, make({{1, 1, 1}, {9, 9, 9}, {5, 5, 5}}, {{0, 1, 2}, {2, 1, 0}}));
  EXPECT_FALSE(verify_hull(kLargeCube, original).encloses);
  EXPECT_TRUE(verify_hull(kLargeCube, original, HullSide::Outer, {.solid_only = true}).encloses);
}

TEST(VerifyHull, SaysNoToAShellThatCoversTheTrianglesOnly) {
  const TriangleMesh shell = together(kLargeCube, inside_out(box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75})));
  EXPECT_FALSE(verify_hull(shell, kSmallCube).encloses);
}

TEST(VerifyHull, SaysYesToCavitiesAndToPartsThatOverlap) {
  const TriangleMesh hollow = together(kSmallCube, inside_out(box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75})));
  EXPECT_TRUE(verify_hull(kLargeCube, hollow).encloses);
  EXPECT_TRUE(verify_hull(hollow, hollow).encloses);
  const TriangleMesh overlapping = together(kSmallCube, moved(kSmallCube, {0.5, 0.5, 0.5}));
  EXPECT_TRUE(verify_hull(kLargeCube, overlapping).encloses);
  EXPECT_TRUE(verify_hull(overlapping, overlapping).encloses);
}

/// Slabs that all pass through each other.
TriangleMesh star_of_slabs(int slabs) {
  TriangleMesh all;
  for (int i = 0; i < slabs; ++i) {
    TriangleMesh slab = box({-3, -0.2, 0}, {3, 0.2, 1});
    const double turn = 3.1 * i / slabs;
    for (Vec3& p : slab.positions)
      p = {p.x * std::cos(turn) - p.y * std::sin(turn), p.x * std::sin(turn) + p.y * std::cos(turn), p.z};
    append(all, slab);
  }
  return all;
}

TEST(VerifyHull, OfManyPartsThatPassThroughEachOtherTakesFewSteps) {
  const TriangleMesh star = star_of_slabs(40);
  const Verification same = verify_hull(star, star, HullSide::Outer, {.max_steps = 1000});
  EXPECT_TRUE(same.certified) << same.why_not << ": a mesh of outward components encloses and covers itself";
  EXPECT_TRUE(verify_cover(star_of_slabs(20), star, {.max_steps = 1000}).encloses) << "every other slab";

  TriangleMesh turned = star;
  for (std::size_t f = 0; f < 12; ++f) {
    auto& [a, b, c] = turned.triangles[FaceId(std::uint32_t(f))];
    std::swap(b, c);
  }
  EXPECT_FALSE(verify_cover(star_of_slabs(40), turned).encloses) << "the slab that is inside out digs into the others";
}

TEST(VerifyHull, OfAnOpenOriginalEveryTriangleMustBeCovered) {
  const Verification found = verify_hull(kLargeCube, without_a_face(kSmallCube));
  EXPECT_TRUE(found.encloses);
  EXPECT_EQ(found.proof, "coverage");
  EXPECT_FALSE(found.original_closed);
  EXPECT_EQ(found.covers_triangles, Answer::Yes);
  EXPECT_TRUE(std::isnan(found.original_volume));
  EXPECT_TRUE(std::isnan(found.void_ratio));
  EXPECT_TRUE(says(found, "not closed"));
  const Verification stray = verify_hull(kLargeCube, with_a_stray_triangle(kSmallCube));
  EXPECT_FALSE(stray.encloses);
  EXPECT_EQ(stray.faces_outside, 1u);
}

TEST(VerifyHull, AsksForTrianglesThatTogetherBoundNothing) {
  const TriangleMesh away = tetrahedron({9, 9, 9}, {10, 9, 9}, {9, 10, 9}, {9, 9, 10});
  const TriangleMesh original = together(together(kSmallCube, away), inside_out(away));
  const Verification found = verify_hull(kLargeCube, original);
  EXPECT_FALSE(found.encloses);
  EXPECT_EQ(found.faces_outside, 8u);
  EXPECT_TRUE(verify_hull(kLargeCube, original, HullSide::Outer, {.solid_only = true}).encloses);
}

TEST(VerifyHull, OfAnInnerHullTheOriginalMustEncloseIt) {
  const Verification found = verify_hull(kSmallCube, kLargeCube, HullSide::Inner);
  EXPECT_TRUE(found.encloses);
  EXPECT_EQ(found.side, HullSide::Inner);
  EXPECT_DOUBLE_EQ(found.void_ratio, 1.0 / 27 - 1);
  EXPECT_FALSE(verify_hull(kLargeCube, kSmallCube, HullSide::Inner).encloses);
}

TEST(VerifyHull, RefusesWhatAnInnerHullCannotProve) {
  EXPECT_THROW(verify_hull(kSmallCube, without_a_face(kLargeCube), HullSide::Inner), InputError);
}

TEST(VerifyHull, OfAnInnerHullEveryTriangleMustLieInTheSolid) {
  const TriangleMesh hull = box_with_a_spike_inside_out();
  const Verification found = verify_hull(hull, kLargeCube, HullSide::Inner);
  EXPECT_FALSE(found.encloses);
  EXPECT_NE(found.why_not.find("folds of the hull"), std::string::npos) << found.why_not;
  EXPECT_GT(found.faces_outside, 0u);
  EXPECT_TRUE(verify_hull(hull, kLargeCube, HullSide::Inner, {.solid_only = true}).encloses);
  EXPECT_TRUE(verify_hull(hull, box({-1, -1, -2}, {2, 2, 2}), HullSide::Inner).encloses);
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
  const Verification foreign = verify_hull(hull, kSmallCube);
  EXPECT_FALSE(foreign.encloses);
  EXPECT_FALSE(foreign.why_not.empty());
  const Verification stray = verify_hull(hull, with_a_stray_triangle(mesh));
  EXPECT_FALSE(stray.encloses);
  EXPECT_FALSE(std::isnan(stray.hull_volume)) << "the replay holds";
  EXPECT_EQ(stray.faces_outside, 1u);
}

TEST(VerifyHull, OfAProgressiveHullTheBaseMeshMustCoverEveryTriangle) {
  const TriangleMesh mesh = box_with_a_spike_inside_out();
  const ProgressiveHull hull = build_hull(mesh, {.target_faces = 1000}).hull;  // no collapse: the spike sticks out
  const Verification found = verify_hull(hull, mesh);
  EXPECT_FALSE(found.encloses);
  EXPECT_GT(found.faces_outside, 0u);
  EXPECT_FALSE(std::isnan(found.hull_volume)) << "the replay holds";
  EXPECT_TRUE(verify_hull(hull, mesh, {.solid_only = true}).encloses);
}

TEST(VerifyHull, TellsThatFinerLevelsMayLeaveAFoldUncovered) {
  TriangleMesh mesh = sphere(3);
  const auto [u, v, w] = mesh.triangles[FaceId{0}];
  mesh.positions[v] = mesh.positions[v] + (mesh.positions[w] - mesh.positions[v]) * 1.5;
  const ProgressiveHull hull = build_hull(mesh, {.target_faces = 30}).hull;
  const Verification found = verify_hull(hull, mesh);
  EXPECT_TRUE(found.encloses) << found.why_not;
  EXPECT_GT(found.faces_beside_solid, 0u);
  EXPECT_TRUE(says(found, "the base mesh covers"));
  EXPECT_FALSE(verify_hull(hull.original(), mesh).encloses);
}

TEST(VerifyHull, OfAFinestLevelThatWasMadeOfTheOriginalThatLevelMustEncloseIt) {
  const TriangleMesh rock = make_sample("asteroid", 500), around = scaled(sphere(3), 3);
  const ProgressiveHull hull = build_hull(around, {.target_faces = 100}).hull;
  EXPECT_FALSE(verify_hull(hull, rock).encloses) << "it does not say that its finest level is another mesh";
  const ProgressiveHull wrap = hull.with_finest_level(FinestLevel::Wrap);
  const Verification found = verify_hull(wrap, rock);
  EXPECT_TRUE(found.encloses) << found.why_not;
  EXPECT_EQ(found.proof, "replay");
  EXPECT_GT(found.splits, 0u);
  EXPECT_DOUBLE_EQ(found.original_volume, signed_volume(rock));

  const Verification outside = verify_hull(wrap, moved(rock, {3, 0, 0}));
  EXPECT_FALSE(outside.encloses);
  EXPECT_GT(outside.faces_outside, 0u);
  EXPECT_FALSE(verify_hull(wrap, scaled(sphere(2), 3.01)).encloses);
  EXPECT_FALSE(verify_hull(wrap, together(rock, inside_out(moved(octahedron(), {4, 0, 0})))).encloses);
}

TEST(VerifyHull, OfLevelsThatDoNotEncloseEachOtherItBelievesNoFinestLevel) {
  const TriangleMesh around = scaled(sphere(3), 3);
  const ProgressiveHull hull = build_hull(around, {.target_faces = 100}).hull;
  PerVertex<Vec3> positions = hull.positions();
  positions[hull.made_vertex(hull.splits().size() - 1)] = {0, 0, 0};
  const ProgressiveHull dented(hull.side(), hull.original_vertex_count(), std::move(positions), hull.base_corners(),
                               hull.splits());
  EXPECT_FALSE(verify_hull(dented.with_finest_level(FinestLevel::Wrap), octahedron()).encloses);
}

TEST(VerifyHull, ReplaysAnInnerHullByItsOwnSide) {
  const TriangleMesh mesh = make_sample("asteroid", 1000);
  const ProgressiveHull hull = build_hull(mesh, {.target_faces = 100, .side = HullSide::Inner}).hull;
  EXPECT_TRUE(verify_hull(hull, mesh).encloses);
  EXPECT_EQ(verify_hull(hull, mesh).side, HullSide::Inner);
  EXPECT_THROW(verify_hull(hull, without_a_face(mesh)), InputError);
}

TEST(VerifyHull, LeavesOutFacesThatAreNotFiniteOnlyIfThatIsAllowed) {
  TriangleMesh original = kSmallCube;
  const VertexId far = original.positions.push_back({std::numeric_limits<double>::infinity(), 0, 0});
  original.triangles.push_back({VertexId{0}, VertexId{1}, far});
  EXPECT_FALSE(verify_hull(kLargeCube, original).encloses);
  EXPECT_NE(verify_hull(kLargeCube, original).why_not.find("not finite"), std::string::npos);
  const Verification found = verify_hull(kLargeCube, original, HullSide::Outer, {.finite_only = true});
  EXPECT_TRUE(found.encloses);
  EXPECT_EQ(found.non_finite_faces, 1u);
  EXPECT_TRUE(found.original_closed) << "what is left is";
  EXPECT_TRUE(says(found, "1 face of the original is not finite"));
}

TEST(VerifyHull, MeasuresPartsThatOverlapOnceOnly) {
  const TriangleMesh two = together(box({0, 0, 0}, {2, 2, 2}), box({1, 0.5, 0.5}, {4, 1.5, 1.5}));  // 8 + 2
  const Verification found = verify_hull(box({0, 0, 0}, {4, 2, 2}), two);
  EXPECT_TRUE(found.encloses);
  EXPECT_DOUBLE_EQ(found.original_volume, 10);
  EXPECT_NEAR(found.void_ratio, 0.6, 1e-12);
  EXPECT_NEAR(verify_hull(two, two).void_ratio, 0, 1e-12);
  const TriangleMesh twice = together(box({0, 0, 0}, {2, 2, 2}), box({0, 0, 0}, {1, 2, 2}));  // share faces
  EXPECT_DOUBLE_EQ(verify_hull(box({0, 0, 0}, {2, 2, 2}), twice).original_volume, 8);
  const TriangleMesh hollow = together(box({0, 0, 0}, {3, 3, 3}), inside_out(box({1, 1, 1}, {2, 2, 2})));
  EXPECT_DOUBLE_EQ(verify_hull(box({0, 0, 0}, {3, 3, 3}), hollow).original_volume, 26);
}

TEST(VerifyHull, HasNoVoidOfAnOriginalWithoutVolume) {
  TriangleMesh flat = box({0, 0, 0}, {1, 1, 1});
  for (Vec3& p : flat.positions) p.z = 0;
  const Verification found = verify_hull(box({0, 0, -1}, {1, 1, 1}), flat);
  EXPECT_TRUE(found.encloses);
  EXPECT_TRUE(std::isnan(found.void_ratio));
}

// Five sides of a box, and its lid.
TEST(VerifyHull, ComparesWithAClosedMeshThatStandsForAnOpenOne) {
  const TriangleMesh closed = box({0, 0, 0}, {1, 1, 1});
  TriangleMesh open = closed;
  open.triangles.resize(open.triangles.size() - 2);
  const VerificationOptions with{.closed = &closed};
  const TriangleMesh inside = box({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5});
  EXPECT_THROW(verify_hull(inside, open, HullSide::Inner), InputError) << "it has no inside";
  const Verification inner = verify_hull(inside, open, HullSide::Inner, with);
  EXPECT_TRUE(inner.encloses && inner.encloses_solid == Answer::Yes && !inner.original_closed);
  EXPECT_EQ(inner.cap_faces, 2u);
  EXPECT_FALSE(verify_hull(box({0.5, 0.5, 0.5}, {1.5, 0.75, 0.75}), open, HullSide::Inner, with).encloses);
  EXPECT_TRUE(verify_hull(kLargeCube, open, HullSide::Outer, with).encloses);
  TriangleMesh more = open;  // a fin that no face of the closed mesh stands for
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{-90, 0, 0}, Vec3{-90, 1, 0}}) more.positions.push_back(p);
  const auto n = static_cast<std::uint32_t>(more.vertex_count());
  more.triangles.push_back({VertexId{n - 3}, VertexId{n - 2}, VertexId{n - 1}});
  const Verification fin = verify_hull(kLargeCube, more, HullSide::Outer, with);
  EXPECT_FALSE(fin.encloses);
  ASSERT_EQ(fin.worst.size(), 1u);
  EXPECT_EQ(fin.worst[0].face, FaceId{static_cast<std::uint32_t>(more.face_count() - 1)});
}

/// A prism whose outline is an 8. Its solid is the lobe at x < 2.5, more or less; the other lobe is inside out.
TriangleMesh prism_of_an_eight() {
  TriangleMesh mesh;
  for (const double z : {0, 1})
    for (const Vec3& p : {Vec3{0, -3, z}, Vec3{5, 1, z}, Vec3{5, -1, z}, Vec3{0, 3, z}}) mesh.positions.push_back(p);
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back({VertexId{a}, VertexId{b}, VertexId{c}});
  };
  add(4, 5, 6), add(4, 6, 7), add(0, 2, 1), add(0, 3, 2);
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    add(i, next, 4 + next), add(i, 4 + next, 4 + i);
  }
  return mesh;
}

// The triangles that the stand-in leaves out were asked all the same: "yes" to all, or no certificate.
TEST(VerifyHull, IsNotAskedForTrianglesBesideAStandInWithSolidOnly) {
  const TriangleMesh closed = prism_of_an_eight(), hull = box({-1, -4, -1}, {4, 4, 2});
  for (const double z : {0.4, 5.0}) {
    const TriangleMesh loose = make({{1, 0, z}, {1.5, 0, z}, {1, 0.5, z}}, {{0, 1, 2}});
    const TriangleMesh open = together(without_a_face(closed), loose);
    const Verification all = verify_hull(hull, open, HullSide::Outer, {.closed = &closed});
    EXPECT_EQ(all.covers_triangles, Answer::No);
    const Verification solid = verify_hull(hull, open, HullSide::Outer, {.solid_only = true, .closed = &closed});
    EXPECT_TRUE(solid.certified) << solid.why_not;
    EXPECT_EQ(solid.encloses_solid, Answer::Yes);
    EXPECT_EQ(solid.covers_triangles, Answer::NotAsked);
  }
}

TEST(VerifyHull, TurnsMeshesThatAreInsideOutAndSaysSo) {
  const Verification found = verify_hull(kLargeCube, inside_out(kSmallCube));
  EXPECT_TRUE(found.encloses);
  EXPECT_EQ(found.turned_original_faces, 12u);
  EXPECT_EQ(found.inverted_hull_faces, 0u);
  EXPECT_TRUE(says(found, "12 faces of the original look inwards"));
}

TEST(OutwardSolid, TurnsComponentsOfNegativeVolumeThatAreNoCavities) {
  const std::string turned = ": it was turned, so that its inside counts as solid";
  const TriangleMesh cube = box({-1, -1, -1}, {1, 1, 1}), cavity = inside_out(scaled(cube, 0.5));
  const TriangleMesh beside = inside_out(moved(scaled(cube, 2), {9, 0, 0}));
  for (const TriangleMesh& mesh : {cube, together(cube, cavity)}) {
    EXPECT_EQ(outward_solid(mesh, "it").mesh, mesh);
    EXPECT_EQ(outward_solid(mesh, "it").turned, "");
  }
  EXPECT_EQ(outward_solid(inside_out(cube), "it").turned, "it is inside out" + turned);
  EXPECT_EQ(outward_solid(inside_out(together(cube, cavity)), "it").mesh, together(cube, cavity));
  EXPECT_EQ(outward_solid(inside_out(together(cube, cavity)), "it").turned, "it is inside out" + turned);
  EXPECT_EQ(outward_solid(together(cube, beside), "it").turned,
            "the component of face 12 of it is inside out" + turned);
  EXPECT_EQ(outward_solid(together(together(cube, beside), moved(beside, {0, 9, 0})), "it").turned,
            "the component of face 12 of it is inside out, as is 1 other" + turned);
  const TriangleMesh small_bar = inside_out(box({-0.5, -0.5, -1.5}, {0.5, 0.5, 1.5}));
  const OutwardSolid crossed = outward_solid(together(cube, small_bar), "it");
  EXPECT_EQ(crossed.turned, "the component of face 12 of it is inside out and crosses or repeats others" + turned);
  EXPECT_EQ(crossed.mesh, together(cube, inside_out(small_bar)));
  const TriangleMesh bar = inside_out(box({-0.5, -0.5, -9}, {0.5, 0.5, 9}));  // larger than the cube, and crosses it
  EXPECT_EQ(outward_solid(together(cube, bar), "it").mesh, together(cube, inside_out(bar)));
  EXPECT_TRUE(says(verify_hull(kLargeCube, together(cube, bar)),
                   "24 faces of the original count as turned, as its volume is negative: 12 of these look inwards"));
}

TEST(VerifyHull, RefusesAHullThatIsInsideOut) {
  const Verification all = verify_hull(inside_out(kLargeCube), kSmallCube);
  EXPECT_FALSE(all.encloses);
  EXPECT_EQ(all.inverted_hull_faces, 12u);
  EXPECT_NE(all.why_not.find("all faces of the hull look inwards"), std::string::npos) << all.why_not;
  const Verification one = verify_hull(together(kLargeCube, inside_out(moved(kSmallCube, {9, 9, 9}))), kSmallCube);
  EXPECT_FALSE(one.encloses);
  EXPECT_EQ(one.inverted_hull_faces, 12u);
  EXPECT_NE(one.why_not.find("12 faces of the hull look inwards"), std::string::npos) << one.why_not;
  EXPECT_FALSE(verify_hull(inside_out(kSmallCube), kLargeCube, HullSide::Inner).encloses);
  EXPECT_THROW(verify_hull(inside_out(without_a_face(kLargeCube)), kSmallCube), InputError);
}

TEST(VerifyHull, DoesNotTurnAPartThatCrossesAnother) {
  const TriangleMesh cube = box({-1, -1, -1}, {1, 1, 1}), bar = inside_out(box({-0.5, -0.5, -1.5}, {0.5, 0.5, 1.5}));
  const TriangleMesh in_the_hole = box({-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25});
  const Verification found = verify_hull(together(cube, bar), in_the_hole);
  EXPECT_FALSE(found.encloses) << "the bar is a hole";
  EXPECT_EQ(found.inverted_hull_faces, 0u);
  EXPECT_EQ(verify_hull(kLargeCube, together(cube, bar)).turned_original_faces, 0u);
}

TEST(VerifyHull, RefusesCoordinatesThatOverflow) {
  EXPECT_THROW(verify_hull(scaled(kLargeCube, 1e101), kSmallCube), InputError);
  EXPECT_THROW(verify_hull(kLargeCube, scaled(kSmallCube, 1e101)), InputError);
  EXPECT_TRUE(verify_hull(scaled(kLargeCube, 1e99), scaled(kSmallCube, 1e99)).encloses);
}

/// What is said of a convex hull by the planes of its faces alone.
bool is_inside_of_all_planes(const TriangleMesh& hull, const TriangleMesh& original) {
  for (const FaceId f : hull.triangles.ids())
    for (const Vec3& p : original.positions)
      if (side(hull.triangle(f), p) == Side::Outside) return false;
  return true;
}

TEST(VerifyHull, IsRightAboutATetrahedronOfWhichAVertexWasMovedFarOut) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> factor(0.8, 2), exponent(0, 80), drift(-9, 9);
  int yes = 0, no = 0;
  for (int i = 0; i < 400; ++i) {
    TriangleMesh hull = tetrahedron({-3, -4, -2}, {5, 0, -2}, {-3, 4, -2}, {0, 0, 5});
    for (Vec3& p : hull.positions) p = p * factor(random);
    const TriangleMesh original = i % 2 ? scaled(octahedron(), 0.5) : hull;
    Vec3& far = hull.positions[VertexId(std::uint32_t(i) / 2 % 4)];
    far = (far + Vec3{drift(random), drift(random), drift(random)}) * std::pow(10, exponent(random));
    if (signed_volume(hull) <= 0) continue;
    const bool encloses = is_inside_of_all_planes(hull, original);
    EXPECT_EQ(verify_hull(hull, original).encloses, encloses) << "tetrahedron " << i;
    (encloses ? yes : no) += 1;
  }
  EXPECT_GT(yes, 20);
  EXPECT_GT(no, 20);
}

TEST(VerifyHull, TellsOfSizesThatDifferAsUnitsDo) {
  const TriangleMesh mesh = make_sample("asteroid", 200);
  for (const double hull_size : {1.0, 1.3}) {
    const TriangleMesh hull = scaled(mesh, hull_size);
    for (const double unit : {1000.0, 0.001, 25.4, 1 / 25.4}) {
      const double ratio = std::max(unit / hull_size, hull_size / unit);
      const std::string text = fmt::format("is {:.4g} times {}", ratio, unit > 1 ? "smaller" : "larger");
      EXPECT_TRUE(says(verify_hull(hull, scaled(mesh, unit)), text)) << text;
    }
    for (const double same_unit : {0.1, 0.5, 1.0, 3.0, 18.0, 55.0, 100.0, 1e5})
      EXPECT_FALSE(says(verify_hull(hull, scaled(mesh, same_unit)), "times")) << same_unit;
  }
  const ProgressiveHull levels = build_hull(mesh, {.target_faces = 100}).hull;
  EXPECT_TRUE(says(verify_hull(levels, scaled(mesh, 0.001)), "times larger"));
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
  EXPECT_TRUE(verify_hull(mesh, mesh, HullSide::Outer, {.progress = watch}).encloses);
  EXPECT_EQ(last, 1);
  EXPECT_THROW(verify_hull(mesh, mesh, HullSide::Outer, {.progress = [](std::string_view, double) { return false; }}),
               Cancelled);
}

TEST(VerifyHull, AsksWhetherToGoOnWhileOneFaceIsCutByMany) {
  const UnthrottledProgress every_call;
  int asked = 0;
  const auto count = [&](std::string_view, double) { return ++asked > 0; };
  verify_hull(sphere(3), tetrahedron({-9, -9, 0}, {9, -9, 0}, {0, 9, 0}, {0, 0, 9}), HullSide::Outer,
              {.progress = count});
  EXPECT_GT(asked, 200) << "the four faces alone would be told of a few times";
}

}  // namespace
}  // namespace prohull
