#include "prohull/convex_cover.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "cover/best_cut.h"
#include "effort.h"
#include "input_error.h"
#include "meshes.h"
#include "progress.h"
#include "prohull/convex_hull.h"
#include "prohull/error.h"
#include "prohull/sample.h"
#include "prohull/union_verification.h"
#include "random.h"

namespace prohull {
namespace {

std::vector<TriangleMesh> meshes_of(const ConvexCover& cover) {
  std::vector<TriangleMesh> meshes;
  for (const ConvexPiece& piece : cover.pieces) meshes.push_back(piece.mesh);
  return meshes;
}

/// A unit cube with a cavity of an eighth.
TriangleMesh hollow_cube() {
  return meshes::together(meshes::box({0, 0, 0}, {1, 1, 1}),
                          meshes::inside_out(meshes::box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75})));
}

/// Two bars that share a corner.
TriangleMesh angle_of_bars() {
  return meshes::make({{0, 0, 0},
                       {3, 0, 0},
                       {3, 1, 0},
                       {1, 1, 0},
                       {1, 3, 0},
                       {0, 3, 0},
                       {0, 0, 1},
                       {3, 0, 1},
                       {3, 1, 1},
                       {1, 1, 1},
                       {1, 3, 1},
                       {0, 3, 1}},
                      {{0, 3, 2},  {0, 2, 1},  {0, 5, 4},  {0, 4, 3},   {6, 8, 9}, {6, 7, 8}, {6, 10, 11},
                       {6, 9, 10}, {0, 1, 7},  {0, 7, 6},  {1, 2, 8},   {1, 8, 7}, {2, 3, 9}, {2, 9, 8},
                       {3, 4, 10}, {3, 10, 9}, {4, 5, 11}, {4, 11, 10}, {5, 0, 6}, {5, 6, 11}});
}

TriangleMesh two_boxes_apart() {
  TriangleMesh both = meshes::box({0, 0, 0}, {1, 1, 1});
  append(both, meshes::box({3, 0, 0}, {4, 1, 1}));
  return both;
}

TriangleMesh small_torus() { return meshes::torus(effort(16u, 9u), effort(8u, 5u)); }

// The segment has no volume, and cuts are judged by volumes.
TEST(ConvexCover, OfASolidAndAFaceWithoutAreaBesideItHasAPieceForEach) {
  TriangleMesh mesh = meshes::sphere(1);
  append(mesh, meshes::make({{3, 0, 0}, {13, 0, 0}}, {{0, 0, 1}}));
  const ConvexCover cover = convex_cover(mesh, {.max_pieces = 4});
  EXPECT_TRUE(cover.verdict.certified);
  EXPECT_GT(cover.pieces.size(), 1u);
  EXPECT_LT(cover.void_ratio, 0.5);
}

TEST(ConvexCover, FillsCavitiesAndTellsTheirVolume) {
  const ConvexCover cover = convex_cover(hollow_cube(), {.max_pieces = 3});
  EXPECT_TRUE(cover.verdict.certified && cover.verdict.encloses_solid == Answer::Yes);
  EXPECT_EQ(cover.pieces.size(), 1u) << "they count as filled";
  EXPECT_DOUBLE_EQ(cover.original_volume, 1);
  EXPECT_NEAR(cover.void_ratio, 0, 1e-8);
  EXPECT_EQ(cover.notes,
            std::vector<std::string>{"cavities of the mesh count as filled: with them it has 14.29 % more volume"});
  EXPECT_TRUE(convex_cover(hollow_cube(), {.max_pieces = 3, .bounds = {.max_void_ratio = 0.05}}).within_bounds);
}

// More pieces of it reach as far.
TEST(ConvexCover, ThatMissesABoundIsNoFartherThanFewerPieces) {
  const TriangleMesh bracket = make_sample("bracket", 300);
  const ConvexCover plain = convex_cover(bracket, {.max_pieces = 24}),
                    missed = convex_cover(bracket, {.max_pieces = 24, .bounds = {.max_distance = 1e-3}});
  EXPECT_FALSE(missed.within_bounds);
  EXPECT_LE(missed.verdict.distance().upper, plain.verdict.distance().upper);
  EXPECT_LT(missed.pieces.size(), plain.pieces.size());
}

TEST(ConvexCover, OfABoxIsTheBox) {
  const ConvexCover cover = convex_cover(meshes::box({0, 0, 0}, {1, 2, 3}));
  ASSERT_EQ(cover.pieces.size(), 1u);
  EXPECT_EQ(cover.pieces[0].mesh.vertex_count(), 8u);
  EXPECT_TRUE(cover.verdict.certified && cover.verdict.encloses_solid == Answer::Yes);
  EXPECT_NEAR(cover.void_ratio, 0, 1e-6);
  EXPECT_LT(cover.verdict.distance().upper, 1e-8);
}

TEST(ConvexCover, OfABoxWithAHoleIsFourPiecesHoweverManyMayBe) {
  const ConvexCover cover = convex_cover(make_sample("box", 60));
  EXPECT_EQ(cover.pieces.size(), 4u);
  EXPECT_TRUE(cover.verdict.certified && cover.verdict.encloses_solid == Answer::Yes);
  EXPECT_NEAR(cover.void_ratio, 0, 1e-6);
}

TEST(ConvexCover, OfABoxWithoutALidCoversWhatItsOpeningLeadsInto) {
  const TriangleMesh box = meshes::box({0, 0, 0}, {1, 2, 3});
  TriangleMesh bucket{box.positions, {}};
  for (std::uint32_t f = 2; f < box.face_count(); ++f) bucket.triangles.push_back(box.triangles[FaceId{f}]);
  const ConvexCover cover = convex_cover(bucket);
  EXPECT_TRUE(cover.verdict.certified && cover.verdict.encloses_solid == Answer::Yes);
  EXPECT_FALSE(cover.verdict.original_closed);
  EXPECT_NEAR(cover.void_ratio, 0, 1e-6);
}

TEST(ConvexCover, FindsTheCutThatLeavesNoVoid) {
  const ConvexCover cover = convex_cover(angle_of_bars(), {.max_pieces = 2});
  EXPECT_EQ(cover.pieces.size(), 2u);
  EXPECT_TRUE(cover.verdict.certified);
  EXPECT_LT(cover.void_ratio, 0.02) << "their convex hull has 40 % void";
}

TEST(ConvexCover, MovesNoCutAgainThatGetsNoBetter) {
  const cover::ValuesOfPlanes below_zero = [](auto planes, double) { return std::vector<double>(planes.size(), -1); };
  const cover::Plane plane{{1, 0, 0}, 0.5};
  EXPECT_EQ(cover::with_least_value(plane, {{0, 0, 0}, {1, 1, 1}}, below_zero).offset, plane.offset);
}

TEST(ConvexCover, SeparatesComponents) {
  const ConvexCover cover = convex_cover(two_boxes_apart(), {.max_pieces = 5});
  EXPECT_EQ(cover.pieces.size(), 2u);
  EXPECT_NEAR(cover.void_ratio, 0, 1e-4);
}

TEST(ConvexCover, OfSamplesIsCertifiedAndSmallerThanTheConvexHull) {
  for (const SampleInfo& sample : samples()) {
    if (sample.name == "gyroid") continue;  // of 22,000 faces
    if (kTestsAreSlow && sample.name != "bracket") continue;
    const TriangleMesh mesh = make_sample(sample.name, 300);
    const ConvexCover few = convex_cover(mesh, {.max_pieces = 4});
    EXPECT_TRUE(few.verdict.certified && few.verdict.encloses_solid == Answer::Yes) << sample.name;
    EXPECT_LE(few.pieces.size(), 4u);
    for (const ConvexPiece& piece : few.pieces) EXPECT_LE(piece.mesh.vertex_count(), 64u) << sample.name;
    EXPECT_LE(few.volume, signed_volume(convex_hull(mesh)) * 1.05) << sample.name;
    EXPECT_TRUE(verify_union(meshes_of(few), mesh).certified) << sample.name;
  }
}

// No hull of few faces has them all.
TEST(ConvexCover, OfManyPartsThatOverlapCutsWhatTheyAreTogether) {
  TriangleMesh fan;
  constexpr int kParts = 390;
  for (int i = 0; i < kParts; ++i) {
    TriangleMesh part = meshes::box({0.5, -0.05, 0}, {1, 0.05, 0.2});
    const double angle = 5.0 * i / kParts, c = std::cos(angle), s = std::sin(angle);
    for (Vec3& p : part.positions) p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    append(fan, part);
  }
  const ConvexCover cover = convex_cover(fan, {.max_pieces = 4, .threads = 1});
  EXPECT_TRUE(cover.verdict.certified);
  EXPECT_EQ(cover.pieces.size(), 4U);
  EXPECT_LT(cover.volume, 0.5);  // the convex hull has 0.61
}

TEST(ConvexCover, OfMorePiecesIsSmaller) {
  const TriangleMesh mesh = meshes::torus(effort(24u, 9u), effort(10u, 5u));
  double last = std::numeric_limits<double>::infinity();
  for (const std::size_t pieces : {1u, 4u, 10u}) {
    const ConvexCover cover = convex_cover(mesh, {.max_pieces = pieces});
    EXPECT_LT(cover.volume, last * 0.95) << pieces;
    last = cover.volume;
  }
}

TEST(ConvexCover, HasAsFewPiecesAsKeepTheBounds) {
  const TriangleMesh mesh = meshes::torus(effort(14u, 9u), effort(7u, 5u));
  const ConvexCover near = convex_cover(mesh, {.max_pieces = 20, .bounds = {.max_void_ratio = 0.25}});
  EXPECT_TRUE(near.within_bounds);
  EXPECT_LE(near.void_ratio, 0.25);
  const ConvexCover fewer = convex_cover(mesh, {.max_pieces = near.pieces.size() - 1});
  EXPECT_GT(fewer.void_ratio, 0.25);
  const ConvexCover too_few = convex_cover(mesh, {.max_pieces = 2, .bounds = {.max_distance = 0.01}});
  EXPECT_FALSE(too_few.within_bounds);
  EXPECT_TRUE(too_few.verdict.certified);
  EXPECT_GT(too_few.verdict.distance().upper, 0.01);
}

TEST(ConvexCover, ThatMayHaveMorePiecesHasNoMoreForABound) {
  const TriangleMesh mesh = make_sample("asteroid", 1000);
  const double max_distance = 0.03 * bounding_box(mesh).diagonal();
  const auto pieces = [&](std::size_t most) {
    return convex_cover(mesh, {.max_pieces = most, .bounds = {.max_distance = max_distance}}).pieces.size();
  };
  EXPECT_LE(pieces(64), pieces(24));
}

TEST(ConvexCover, TakesAnyTriangles) {
  TriangleMesh open = small_torus();
  open.triangles.resize(open.face_count() - 9);
  TriangleMesh soup;
  for (const FaceId f : open.triangles.ids()) {
    const auto [a, b, c] = open.triangle(f);
    std::array<VertexId, 3> t{soup.positions.push_back(a), soup.positions.push_back(b), soup.positions.push_back(c)};
    soup.triangles.push_back(t);
  }
  TriangleMesh with_nan = small_torus();
  with_nan.positions[VertexId(5)].x = std::numeric_limits<double>::quiet_NaN();
  const TriangleMesh plate = meshes::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const TriangleMesh needle = meshes::make({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}});
  const std::pair<const char*, TriangleMesh> all[]{{"open", open},
                                                   {"soup", soup},
                                                   {"not finite", with_nan},
                                                   {"plate", plate},
                                                   {"needle", needle},
                                                   {"inside out", meshes::inside_out(small_torus())},
                                                   {"huge", meshes::scaled(small_torus(), 1e9)},
                                                   {"tiny", meshes::scaled(small_torus(), 1e-9)},
                                                   {"far away", meshes::moved(small_torus(), {1e6, 0, 0})}};
  for (const auto& [name, mesh] : all) {
    const ConvexCover cover = convex_cover(mesh, {.max_pieces = 2});
    EXPECT_TRUE(cover.verdict.certified) << name;
    EXPECT_TRUE(verify_union(meshes_of(cover), mesh, {.finite_only = true}).certified) << name;
  }
}

TEST(ConvexCover, OfASolidThatRepeatsItselfInsideOutCoversTheInside) {
  const TriangleMesh solid = meshes::octahedron();
  const ConvexCover cover = convex_cover(meshes::together(meshes::inside_out(solid), solid), {.max_pieces = 2});
  EXPECT_TRUE(cover.verdict.certified && cover.verdict.encloses_solid == Answer::Yes && cover.notes.empty());
}

// No hull around them is cut for that.
TEST(ConvexCover, OfOnePieceIsTheConvexHullOfLooseTriangles) {
  TriangleMesh loose = small_torus();
  for (std::size_t i = 0; i < loose.face_count(); i += 2)
    std::swap(loose.triangles[FaceId(i)][0], loose.triangles[FaceId(i)][1]);
  loose.triangles.resize(loose.face_count() / 2);
  const ConvexCover cover = convex_cover(loose, {.max_pieces = 1});
  ASSERT_EQ(cover.pieces.size(), 1u);
  EXPECT_TRUE(cover.verdict.certified && cover.notes.empty());
  EXPECT_NEAR(cover.volume / signed_volume(convex_hull(loose)), 1, 1e-6);
}

// A hull around them has a void of its own.
TEST(ConvexCover, OfTrianglesThatEncloseNothingCutsTheseThemselves) {
  const TriangleMesh fins =
      meshes::make({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  const ConvexCover cover = convex_cover(fins, {.max_pieces = 3});
  EXPECT_TRUE(cover.verdict.certified);
  EXPECT_NE(cover.verdict.encloses_solid, Answer::Yes);
  EXPECT_LT(cover.volume, 0.01 * signed_volume(convex_hull(fins)));
  EXPECT_LT(cover.verdict.distance().upper, 0.01);
}

// As of a floor with a hole: parts of a plane have no volumes to compare.
TEST(ConvexCover, OfFlatTrianglesGoesAroundTheirHole) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  TriangleMesh frame;
  for (const double half : {5.0, 2.0})
    for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
      frame.positions.push_back({half * x, half * y * c, half * y * s});
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    frame.triangles.push_back({VertexId{i}, VertexId{j}, VertexId{4 + i}});
    frame.triangles.push_back({VertexId{j}, VertexId{4 + j}, VertexId{4 + i}});
  }
  const ConvexCover cover = convex_cover(frame, {.max_pieces = 8, .bounds = {.max_distance = 0.2}});
  EXPECT_TRUE(cover.verdict.certified && cover.within_bounds);
  EXPECT_EQ(cover.pieces.size(), 4U);
  EXPECT_LT(convex_cover(frame, {.max_pieces = 8}).verdict.distance().upper, 0.2);
  frame.triangles.resize(2);
  EXPECT_EQ(convex_cover(frame, {.max_pieces = 8, .bounds = {.max_distance = 0.2}}).pieces.size(), 1U);
  frame.triangles.resize(1);
  EXPECT_EQ(convex_cover(frame, {.max_pieces = 8}).pieces.size(), 1U);
  frame.triangles = {{VertexId{0}, VertexId{1}, VertexId{2}}, {VertexId{0}, VertexId{2}, VertexId{3}}};
  EXPECT_EQ(convex_cover(frame, {.max_pieces = 8}).pieces.size(), 1U);
  EXPECT_EQ(convex_cover(frame, {.max_pieces = 8, .bounds = {.max_distance = 0.2}}).pieces.size(), 1U);
}

TEST(ConvexCover, KeepsFloat32Coordinates) {
  const TriangleMesh mesh = meshes::torus(effort(20u, 12u), effort(9u, 6u));
  const ConvexCover cover = convex_cover(mesh, {.max_pieces = 6, .float32_coordinates = true});
  EXPECT_TRUE(cover.verdict.certified);
  for (const ConvexPiece& piece : cover.pieces)
    for (const Vec3& p : piece.mesh.positions)
      for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(p[axis], static_cast<double>(static_cast<float>(p[axis])));
}

/// A piece of this part once had a spike that reached out by 40 % of the diagonal.
TEST(ConvexCover, OfFloat32CoordinatesIsHardlyLarger) {
  const TriangleMesh mesh = make_sample("bracket", effort(3000u, 300u));
  const std::size_t pieces = effort(8u, 4u);
  const ConvexCover usual = convex_cover(mesh, {.max_pieces = pieces});
  const ConvexCover rounded = convex_cover(mesh, {.max_pieces = pieces, .float32_coordinates = true});
  EXPECT_LT(rounded.volume, usual.volume * 1.01);
  EXPECT_LT(rounded.verdict.distance().upper, usual.verdict.distance().upper * 1.01);
}

TEST(ConvexCover, TakesTheShapeThatIsAskedFor) {
  for (const PieceShape shape : {PieceShape::Box, PieceShape::Capsule, PieceShape::Ball}) {
    const ConvexCover cover = convex_cover(small_torus(), {.max_pieces = effort(4u, 2u), .shape = shape});
    EXPECT_TRUE(cover.verdict.certified);
    for (const ConvexPiece& piece : cover.pieces)
      EXPECT_EQ(piece.primitive.index(), shape == PieceShape::Box ? 1u : shape == PieceShape::Capsule ? 2u : 3u);
  }
}

// A square of a normal overflowed: the volume and the reach were those of pieces without size.
TEST(ConvexCover, OfRoundShapesIsMeasuredAtAnySize) {
  for (const PieceShape shape : {PieceShape::Capsule, PieceShape::Ball})
    for (const double size : {0x1p-270, 0x1p270}) {
      const TriangleMesh mesh = meshes::scaled(meshes::box({0, 0, 0}, {1, 2, 3}), size);
      const ConvexCover cover = convex_cover(mesh, {.max_pieces = 1, .shape = shape});
      EXPECT_GT(cover.volume, cover.original_volume);
      EXPECT_GT(cover.verdict.distance().upper, 0.1 * size);
    }
}

TEST(ConvexCover, TakesAShapeOnlyAsFarAsTheBoundsAllow) {
  TriangleMesh mesh = meshes::box({0, 0, 0}, {1, 1, 1});
  append(mesh, meshes::tetrahedron({3, 0, 0}, {4, 0, 0}, {3, 1, 0}, {3, 0, 1}));
  const ConvexCover cover =
      convex_cover(mesh, {.max_pieces = 2, .bounds = {.max_void_ratio = 0.1}, .shape = PieceShape::Box});
  ASSERT_EQ(cover.pieces.size(), 2u);
  EXPECT_TRUE(cover.within_bounds);
  const auto boxes = std::count_if(cover.pieces.begin(), cover.pieces.end(), [](const ConvexPiece& piece) {
    return std::holds_alternative<OrientedBox>(piece.primitive);
  });
  EXPECT_EQ(boxes, 1) << "the box is one, the tetrahedron is not";
}

TEST(ConvexCover, SaysWhereShapesAreLargerThanTheConvexHull) {
  const TriangleMesh plate = meshes::box({0, 0, 0}, {4, 4, 0.1});
  const auto notes = [&](const ConvexCoverOptions& options) { return convex_cover(plate, options).notes; };
  EXPECT_TRUE(notes({.max_pieces = 1, .shape = PieceShape::Box}).empty());
  const std::vector<std::string> found = notes({.max_pieces = 1, .shape = PieceShape::Ball});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("in the shape of a sphere have"), std::string::npos) << found[0];
  EXPECT_TRUE(
      notes({.max_pieces = 1, .bounds = {.max_void_ratio = 0.1}, .shape = PieceShape::Ball}).empty());  // a polytope
}

TEST(ConvexCover, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = meshes::torus(effort(24u, 9u), effort(10u, 5u));
  const std::size_t pieces = effort(6u, 3u);
  const ConvexCover one = convex_cover(mesh, {.max_pieces = pieces, .threads = 1});
  const ConvexCover all = convex_cover(mesh, {.max_pieces = pieces});
  EXPECT_EQ(meshes_of(one), meshes_of(all));
}

TEST(ConvexCover, CanBeCancelled) {
  const UnthrottledProgress unthrottled;
  for (const std::string_view last : {"cut", "fit", "verify"}) {
    ConvexCoverOptions options{.max_pieces = effort(4u, 2u)};
    options.progress = [&](std::string_view stage, double) { return stage != last; };
    EXPECT_THROW(convex_cover(small_torus(), options), Cancelled) << last;
  }
}

TEST(ConvexCover, RefusesWhatItCannotDo) {
  const TriangleMesh box = meshes::box({0, 0, 0}, {1, 1, 1});
  EXPECT_THROW(convex_cover(box, {.max_pieces = 0}), InputError);
  EXPECT_THROW(convex_cover(box, {.max_vertices = 3}), InputError);
  EXPECT_THROW(convex_cover(box, {.bounds = {.max_distance = -1}}), InputError);
  EXPECT_THROW(convex_cover(TriangleMesh{}), InputError);
  const TriangleMesh tiny = meshes::tetrahedron({0, 0, 0}, {1e-160, 0, 0}, {0, 1e-160, 0}, {0, 0, 1e-160});
  const std::string refusal = error_of([&] { convex_cover(tiny); }).what();
  EXPECT_NE(refusal.find("across"), std::string::npos) << refusal;
}

}  // namespace
}  // namespace prohull
