#include "prohull/union_verification.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "effort.h"
#include "input_error.h"
#include "progress.h"
#include "prohull/convex_hull.h"
#include "prohull/error.h"
#include "prohull/sample.h"
#include "random.h"
#include "verify/nearest_face.h"
#include "verify/oracle.h"
#include "verify/random_chains.h"

namespace prohull {
namespace {

using namespace meshes;
using Pieces = std::vector<TriangleMesh>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string message_of(const std::function<void()>& call) { return error_of(call).what(); }

/// The small cubes of a cube of side 3, but for one.
Pieces small_cubes(int left_out = -1) {
  Pieces pieces;
  for (int i = 0; i < 27; ++i) {
    const Vec3 min{double(i % 3), double(i / 3 % 3), double(i / 9)};
    if (i != left_out) pieces.push_back(box(min, min + Vec3{1, 1, 1}));
  }
  return pieces;
}
const TriangleMesh kBlock = box({0, 0, 0}, {3, 3, 3});
constexpr int kMiddle = 13;

TEST(UnionOfPieces, MayShareWalls) {
  const double third = 1.0 / 3;
  const TriangleMesh original = box({0, 0, 0}, {1, 1, 1});
  Pieces pieces{box({0, 0, 0}, {third, 1, 1}), box({third, 0, 0}, {1, 1, 1})};
  const UnionVerification found = verify_union(pieces, original);
  EXPECT_TRUE(found.certified) << found.why_not;
  EXPECT_TRUE(found.original_closed);
  EXPECT_NEAR(found.void_ratio, 0, 1e-6);
  EXPECT_TRUE(verify_union(small_cubes(), kBlock).certified);
}

TEST(UnionOfPieces, LeavesASlitOfOneUlp) {
  const double third = 1.0 / 3;
  const TriangleMesh original = box({0, 0, 0}, {1, 1, 1});
  Pieces pieces{box({0, 0, 0}, {third, 1, 1}), box({std::nextafter(third, 1), 0, 0}, {1, 1, 1})};
  const UnionVerification found = verify_union(pieces, original);
  EXPECT_FALSE(found.certified);
  EXPECT_EQ(found.faces_outside, 8u);
  ASSERT_FALSE(found.worst.empty());
  EXPECT_NEAR(found.worst[0].point.x, third, 1e-15);
}

TEST(UnionOfPieces, IsFoundTooSmallByOneUlpInAnyCoordinate) {
  const Pieces pieces{box({0, 0, 0}, {0.3, 1, 1}), box({0.3, 0, 0}, {1, 1, 1})};
  const TriangleMesh original = box({0, 0, 0}, {1, 1, 1});
  ASSERT_TRUE(verify_union(pieces, original).certified);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (const VertexId v : pieces[i].positions.ids())
      for (int axis = 0; axis < 3; ++axis) {
        Pieces mutant = pieces;
        double& x = mutant[i].positions[v][axis];
        x = std::nextafter(x, 0.5);
        const bool slides_along_the_wall = axis == 0 && x > 0.2 && x < 0.4;
        const UnionVerification found = verify_union(mutant, original);
        EXPECT_FALSE(found.certified && !slides_along_the_wall) << i << ' ' << index(v) << ' ' << axis;
        x = std::nextafter(std::nextafter(x, x < 0.5 ? -1 : 2), x < 0.5 ? -1 : 2);
        if (!slides_along_the_wall) {
          EXPECT_TRUE(verify_union(mutant, original).certified);
        }
      }
}

TEST(UnionOfPieces, HasNoHoleWhereItLiesInTheMidstOfTheOriginal) {
  const UnionVerification found = verify_union(Pieces{box({1, 1, 1}, {2, 2, 2})}, kBlock);
  EXPECT_EQ(found.faces_outside, 12u);
  EXPECT_EQ(found.holes, 0u);
  const UnionVerification ball = verify_union(std::vector<Ball>{{{1.5, 1.5, 1.5}, 1}}, kBlock, true);
  EXPECT_EQ(ball.faces_outside, 12u);
  EXPECT_EQ(ball.holes, 0u);
}

TEST(UnionOfPieces, LeavesAHoleInside) {
  const UnionVerification found = verify_union(small_cubes(kMiddle), kBlock);
  EXPECT_FALSE(found.certified);
  EXPECT_EQ(found.faces_outside, 0u);
  EXPECT_EQ(found.holes, 1u);
  EXPECT_NE(found.why_not.find("inside open"), std::string::npos) << found.why_not;
  EXPECT_FALSE(verify_union(small_cubes(kMiddle), kBlock, {.solid_only = true}).certified);
}

TEST(UnionOfPieces, OutsideOfASurfaceTouchesAllTrianglesButNotTheInside) {
  Pieces pieces = small_cubes(kMiddle);
  const UnionVerification found = verify_union(pieces, box({1, 1, 1}, {2, 2, 2}));
  EXPECT_FALSE(found.certified);
  EXPECT_EQ(found.faces_outside, 0u);
  EXPECT_GE(found.holes, 1u);
}

TEST(UnionOfPieces, TurnsPiecesThatAreInsideOut) {
  Pieces pieces = small_cubes();
  pieces[3] = inside_out(pieces[3]);
  const UnionVerification found = verify_union(pieces, kBlock);
  EXPECT_TRUE(found.certified) << found.why_not;
  EXPECT_EQ(found.turned_pieces, 1u);
}

TEST(UnionOfPieces, TakesPiecesThatAreNotConvex) {
  const TriangleMesh ring = torus(24, 12);
  const UnionVerification found = verify_union(Pieces{ring, box({5, 5, 5}, {6, 6, 6})}, ring);
  EXPECT_TRUE(found.certified) << found.why_not;
  EXPECT_TRUE(std::isnan(found.union_volume));
  TriangleMesh smaller = ring;
  smaller.positions[VertexId(0)].x = std::nextafter(smaller.positions[VertexId(0)].x, 0);  // farthest out
  EXPECT_FALSE(verify_union(Pieces{smaller}, ring).certified);
}

TEST(UnionOfPieces, AnswersForTheSolidAndForTheTrianglesApart) {
  const auto answers = [](const Verdict& found) { return std::pair(found.encloses_solid, found.covers_triangles); };
  EXPECT_EQ(answers(verify_union(small_cubes(), kBlock)), std::pair(Answer::Yes, Answer::Yes));
  EXPECT_EQ(answers(verify_union(small_cubes(kMiddle), kBlock)), std::pair(Answer::No, Answer::Yes));
  EXPECT_EQ(answers(verify_union(small_cubes(), kBlock, {.solid_only = true})),
            std::pair(Answer::Yes, Answer::NotAsked));
  EXPECT_EQ(answers(verify_union(Pieces{small_cubes()[0]}, kBlock)), std::pair(Answer::Undecided, Answer::No));
}

TEST(UnionOfPieces, AsksOfAnOpenOriginalOnlyTheTriangles) {
  TriangleMesh open = kBlock;
  open.triangles.pop_back();
  open.triangles.push_back(open.triangles[FaceId(0)]);
  open.triangles.push_back({open.positions.push_back({kInfinity, 0, 0}), VertexId(0), VertexId(1)});
  EXPECT_FALSE(verify_union(small_cubes(kMiddle), open).certified) << "nobody knows where the last triangle is";
  const UnionVerification found = verify_union(small_cubes(kMiddle), open, {.finite_only = true});
  EXPECT_TRUE(found.certified) << found.why_not;
  EXPECT_FALSE(found.original_closed);
  ASSERT_EQ(found.notes.size(), 2u);
  EXPECT_NE(found.notes[0].find("1 face of the original is not finite"), std::string::npos);
}

TEST(UnionOfPieces, RefusesWhatIsNoSolidByItsNumber) {
  const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1});
  TriangleMesh open = cube, infinite = cube;
  open.triangles.pop_back();
  infinite.positions[VertexId(0)].x = kInfinity;
  const TriangleMesh tangled = together(cube, inside_out(box({2, 2, 2}, {2.5, 2.5, 2.5})));
  const TriangleMesh flat = box({0, 0, 0}, {1, 1, 0});
  const auto refusal = [&](const TriangleMesh& piece) {
    return message_of([&] { verify_union(Pieces{cube, piece}, cube); });
  };
  EXPECT_NE(refusal(open).find("piece 2: the piece's mesh is not closed"), std::string::npos) << refusal(open);
  EXPECT_NE(refusal(infinite).find("piece 2:"), std::string::npos);
  EXPECT_NE(refusal({}).find("piece 2:"), std::string::npos);
  EXPECT_NE(refusal(tangled).find("piece 2: it intersects itself"), std::string::npos) << refusal(tangled);
  EXPECT_NE(refusal(flat).find("piece 2: it has no volume"), std::string::npos) << refusal(flat);
  EXPECT_THROW(verify_union(Pieces{}, cube), InputError);
}

TEST(UnionOfPieces, EndsWhenCancelled) {
  const VerificationOptions options{.progress = [](std::string_view, double) { return false; }};
  EXPECT_THROW(verify_union(small_cubes(), kBlock, options), Cancelled);
}

/// The convex hull of a few corners of a grid; it may be empty.
TriangleMesh random_polytope(RandomChains& chains, int corners) {
  TriangleMesh points;
  for (int i = 0; i < corners; ++i) points.positions.push_back(chains.corner());
  for (std::uint32_t i = 2; i < points.positions.size(); ++i)
    points.triangles.push_back({VertexId(i - 2), VertexId(i - 1), VertexId(i)});
  return convex_hull(points);
}

TEST(UnionOfPieces, AgreesWithBruteForce) {
  RandomChains chains(test_seed());
  std::mt19937 random(test_seed());
  int accepted = 0, rejected = 0;
  for (int i = 0; i < rounds(150); ++i) {
    TriangleMesh original = random_polytope(chains, 5);
    if (original.face_count() == 0) continue;
    original = moved(scaled(original, 0.5), {0.75, 0.75, 0.75});
    Pieces pieces;
    while (pieces.size() < 3) {
      TriangleMesh piece = random_polytope(chains, 9);
      if (piece.face_count() == 0) continue;
      if (chains.uniform(0, 3) == 0) {  // a hair's breadth, in or out: then kernels are no longer all of it
        double& x = piece.positions[VertexId(0)][chains.uniform(0, 2)];
        x = std::nextafter(x, chains.uniform(-9, 9));
      }
      pieces.push_back(chains.uniform(0, 4) == 0 ? inside_out(piece) : piece);
    }
    TriangleMesh all;
    for (const TriangleMesh& piece : pieces) append(all, signed_volume(piece) < 0 ? inside_out(piece) : piece);
    const oracle::Chain chain(all);
    bool covers = true;
    std::size_t outside = 0;
    for (const FaceId f : original.triangles.ids()) outside += !chain.covers(original.triangle(f), random);
    covers = outside == 0 && oracle::Chain(original).is_enclosed_by(chain, random);
    const UnionVerification found = verify_union(pieces, original);
    ASSERT_EQ(found.certified, covers) << "round " << i;
    ASSERT_EQ(found.faces_outside, outside) << "round " << i;
    ++(covers ? accepted : rejected);
  }
  std::printf("%d cover, %d do not\n", accepted, rejected);
  EXPECT_GT(accepted, 0);
  EXPECT_GT(rejected, 0);
}

/// The corners lie on the sphere of radius 3, exactly.
const TriangleMesh kInscribed =
    convex_hull(make({{1, 2, 2}, {-2, -1, 2}, {2, -2, 1}, {-1, 2, -2}, {2, 1, -2}}, {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}}));

TEST(UnionOfBalls, MayTouchCornersButNotByOneUlpLess) {
  const UnionVerification found = verify_union(std::vector<Ball>{{{0, 0, 0}, 3}}, kInscribed, true);
  EXPECT_TRUE(found.certified) << found.why_not;
  const UnionVerification less = verify_union(std::vector<Ball>{{{0, 0, 0}, std::nextafter(3, 0)}}, kInscribed, false);
  EXPECT_FALSE(less.certified);
  EXPECT_EQ(less.faces_outside, kInscribed.face_count());
  EXPECT_TRUE(less.notes.empty()) << "no point of doubt";
}

TEST(UnionOfBalls, MayTouchEachOther) {
  const TriangleMesh segment = make({{-2, 0, 0}, {2, 0, 0}}, {{0, 1, 1}});
  EXPECT_TRUE(verify_union(std::vector<Ball>{{{-1, 0, 0}, 1}, {{1, 0, 0}, 1}}, segment, false).certified);
  const double less = std::nextafter(1, 0);
  EXPECT_FALSE(verify_union(std::vector<Ball>{{{-1, 0, 0}, 1}, {{1 + 1e-15, 0, 0}, 1}}, segment, false).certified);
  EXPECT_FALSE(verify_union(std::vector<Ball>{{{-1, 0, 0}, less}, {{1, 0, 0}, 1}}, segment, false).certified);
}

// No point outside is known, so that none is told.
TEST(UnionOfBalls, WithAPointInDoubtAreUndecided) {
  // The balls meet at x = 1/3, which no middle of middles hits.
  const TriangleMesh segment = make({{-1, 0, 0}, {1, 0, 0}}, {{0, 1, 1}});
  const double third = 1.0 / 3;
  const std::vector<Ball> balls{{{third - 2, 0, 0}, 2}, {{third + 2, 0, 0}, 2}};
  const UnionVerification found = verify_union(balls, segment, false);
  EXPECT_FALSE(found.certified);
  EXPECT_EQ(found.faces_outside, 0u);
  EXPECT_TRUE(found.worst.empty());
  EXPECT_FALSE(found.point_outside);
  EXPECT_EQ(found.faces_undecided, 1u);
  ASSERT_EQ(found.undecided.size(), 1u);
  EXPECT_NEAR(found.undecided[0].point.x, third, 1e-9);
  EXPECT_NE(found.why_not.find("undecided"), std::string::npos) << found.why_not;
}

// The balls meet at x = 1/3. There, a segment that is cut like a triangle has a million parts.
TEST(UnionOfBalls, AreUndecidedOfASegmentAfterFewParts) {
  const std::vector<Ball> balls{{{1.0 / 3 - 2, 0, 0}, 2}, {{1.0 / 3 + 2, 0, 0}, 2}};
  const UnthrottledProgress unthrottled;
  for (const double middle : {-1.0, 0.25, 1.0}) {
    int calls = 0;
    const Progress count = [&](std::string_view, double) { return ++calls > 0; };
    const TriangleMesh segment = make({{middle, 0, 0}, {1, 0, 0}, {-1, 0, 0}}, {{0, 1, 2}});
    EXPECT_EQ(verify_union(balls, segment, false, {.progress = count}).faces_undecided, 1U) << middle;
    EXPECT_LT(calls, 20) << middle << ": one for 256 steps";
  }
}

TEST(UnionOfBalls, ThatLeaveAPointOutsideBesideOneInDoubtDoNotCover) {
  const double third = 1.0 / 3;
  const std::vector<Ball> balls{{{third - 2, 0, 0}, 2}, {{third + 2, 0, 0}, 2}};
  const TriangleMesh original = make({{-1, 0, 0}, {1, 0, 0}, {0.5, 0.25, 0}}, {{0, 1, 1}, {0, 1, 2}});
  const UnionVerification found = verify_union(balls, original, false);
  EXPECT_FALSE(found.certified);
  EXPECT_EQ(found.faces_outside, 1u);
  EXPECT_EQ(found.faces_undecided, 1u);
  ASSERT_TRUE(found.point_outside);
  EXPECT_EQ(found.point_outside->face, FaceId{1});
  const auto& weights = found.point_outside->weights;
  EXPECT_EQ(weights[0] + weights[1] + weights[2], 1);
  for (const Ball& ball : balls) EXPECT_FALSE(oracle::contains(ball, original.triangle(FaceId{1}), weights));
}

TEST(UnionOfBalls, AreUndecidedInsideWhereTheyTouch) {
  const double third = 1.0 / 3;  // all balls meet at (1/3, 1/3, 1/3), and nowhere else have nothing to spare
  std::vector<Ball> balls;
  for (int axis = 0; axis < 3; ++axis)
    for (const double away : {-2.0, 2.0}) {
      balls.push_back({{third, third, third}, 2});
      balls.back().center[axis] += away;
    }
  const UnionVerification found = verify_union(balls, box({0, 0, 0}, {1, 1, 1}), true);
  EXPECT_FALSE(found.certified);
  EXPECT_EQ(found.faces_outside + found.faces_undecided + found.holes, 0u);
  EXPECT_TRUE(found.inside_undecided);
  EXPECT_NE(found.why_not.find("undecided"), std::string::npos) << found.why_not;
}

std::vector<Ball> balls_around_small_cubes(int left_out = -1) {
  std::vector<Ball> balls;
  for (int i = 0; i < 27; ++i)
    if (i != left_out) balls.push_back({{i % 3 + 0.5, i / 3 % 3 + 0.5, i / 9 + 0.5}, 0.9});
  return balls;
}

TEST(UnionOfBalls, AnswersForTheSolidOnlyWhereItIsAsked) {
  const UnionVerification surface = verify_union(balls_around_small_cubes(kMiddle), kBlock, false);
  EXPECT_EQ(surface.covers_triangles, Answer::Yes);
  EXPECT_EQ(surface.encloses_solid, Answer::NotAsked);
  const UnionVerification inside = verify_union(balls_around_small_cubes(kMiddle), kBlock, true);
  EXPECT_EQ(inside.covers_triangles, Answer::Yes);
  EXPECT_EQ(inside.encloses_solid, Answer::No);
}

TEST(UnionOfBalls, AreUndecidedAfterAsManyStepsAsAreAllowed) {
  const UnionVerification surface = verify_union(balls_around_small_cubes(), kBlock, false, {.max_steps = 1});
  EXPECT_FALSE(surface.certified || surface.is_any(Answer::No));
  EXPECT_EQ(surface.covers_triangles, Answer::Undecided);
  EXPECT_EQ(surface.faces_undecided, kBlock.face_count());
  const UnionVerification inside =
      verify_union(balls_around_small_cubes(), kBlock, true, {.solid_only = true, .max_steps = 1});
  EXPECT_FALSE(inside.certified || inside.is_any(Answer::No));
  EXPECT_TRUE(inside.inside_undecided);
  EXPECT_NE(inside.why_not.find("takes too long"), std::string::npos) << inside.why_not;
  EXPECT_TRUE(verify_union(balls_around_small_cubes(), kBlock, true, {.max_steps = 1'000'000}).certified);
}

TEST(UnionOfBalls, TakeStepsForThoseNearAPartOfALongTriangleOnly) {
  constexpr int kCount = 1000;
  const TriangleMesh strip = make({{0, 0, 0}, {kCount, 0, 0}, {kCount, 0.1, 0}}, {{0, 1, 2}});
  std::vector<Ball> balls;
  for (int i = 0; i < kCount; ++i) balls.push_back({{i + 0.5, 0, 0}, 0.6});
  const UnionVerification found = verify_union(balls, strip, false, {.max_steps = 150 * kCount});
  EXPECT_TRUE(found.certified) << found.why_not;
}

TEST(UnionOfBalls, LeavesAHoleInside) {
  EXPECT_TRUE(verify_union(balls_around_small_cubes(), kBlock, true).certified);
  EXPECT_TRUE(verify_union(balls_around_small_cubes(kMiddle), kBlock, false).certified);
  const UnionVerification found = verify_union(balls_around_small_cubes(kMiddle), kBlock, true);
  EXPECT_FALSE(found.certified);
  EXPECT_EQ(found.faces_outside, 0u);
  EXPECT_EQ(found.holes, 1u);
  EXPECT_NE(found.why_not.find("inside open"), std::string::npos) << found.why_not;
}

TEST(UnionOfBalls, OutsideOfTheSolidNeedNotCover) {
  const TriangleMesh hollow = together(kBlock, inside_out(box({1, 1, 1}, {2, 2, 2})));
  std::vector<Ball> balls = balls_around_small_cubes(kMiddle);
  EXPECT_TRUE(verify_union(balls, hollow, true).certified);
}

TEST(UnionOfBalls, NamesTheFarthestTriangle) {
  std::vector<Ball> balls = balls_around_small_cubes(0);
  const UnionVerification found = verify_union(balls, kBlock, false);
  EXPECT_FALSE(found.certified);
  EXPECT_EQ(found.faces_outside, 6u);
  ASSERT_FALSE(found.worst.empty());
  EXPECT_EQ(found.worst[0].point, (Vec3{0, 0, 0}));
  EXPECT_NEAR(found.worst[0].distance, std::sqrt(0.5 + 2.25) - 0.9, 1e-9);
}

TEST(UnionOfBalls, RefusesBallsByTheirNumber) {
  const std::vector<Ball> balls{{{0, 0, 0}, 1}, {{0, 0, 0}, -1}};
  EXPECT_NE(message_of([&] { verify_union(balls, kBlock, false); }).find("ball 2:"), std::string::npos);
  EXPECT_THROW(verify_union(std::vector<Ball>{}, kBlock, false), InputError);
}

TEST(UnionOfBalls, AgreesWithPointsInExactArithmetic) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> coordinate(-1, 1), radius(0.8, 1.6);
  const TriangleMesh original = sphere(1);
  int accepted = 0, unseen = 0;
  for (int i = 0; i < rounds(60); ++i) {
    std::vector<Ball> balls;
    for (int k = 0; k < 5; ++k)
      balls.push_back({{coordinate(random), coordinate(random), coordinate(random)}, radius(random)});
    const bool covers = verify_union(balls, original, true).certified;
    accepted += covers;
    bool all_points = true;
    for (int k = 0; k < 3000 && all_points; ++k) {
      const Triangle t = original.triangle(FaceId(unsigned(k) % original.face_count()));
      std::uniform_int_distribution<int> weight(0, 16);
      const int u = weight(random), v = std::min(weight(random), 16 - u), depth = k < 1500 ? 16 : weight(random);
      const double scale = depth / 256.0;
      const std::array<double, 3> weights{u * scale, v * scale, (16 - u - v) * scale};
      all_points =
          std::any_of(balls.begin(), balls.end(), [&](const Ball& ball) { return oracle::contains(ball, t, weights); });
    }
    ASSERT_LE(covers, all_points) << "round " << i;
    unseen += !covers && all_points;
  }
  std::printf("%d cover\n", accepted);
  EXPECT_GT(accepted, 0);
  EXPECT_LE(unseen, rounds(60) / 10 + 1);  // small gaps between the points
}

void expect_bounds(const DistanceBounds& found, double expected) {
  EXPECT_LE(found.lower, expected * (1 + 1e-9));
  EXPECT_GE(found.upper, expected * (1 - 1e-9));
  EXPECT_LE(found.upper, found.lower * 1.011 + 1e-3);
}

// How often a piece winds around its parts was asked without end.
TEST(UnionOfPieces, AreUndecidedWhereAPieceTakesTooManySteps) {
  TriangleMesh piece;
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> anywhere(-1, 1);
  const auto point = [&] { return Vec3{anywhere(random), anywhere(random), anywhere(random)}; };
  for (int i = 0; i < 20; ++i) {
    const Vec3 a = point(), b = point(), c = point(), d = point();
    piece = together(piece, dot(cross(b - a, c - a), d - a) < 0 ? tetrahedron(a, b, c, d) : tetrahedron(a, c, b, d));
  }
  const TriangleMesh far = make({{9, 0, 0}, {9.1, 0, 0}, {9, 0.1, 0}}, {{0, 1, 2}});
  const UnionVerification found = verify_union(Pieces{piece}, far, {.max_steps = 1000});
  EXPECT_EQ(found.covers_triangles, Answer::Undecided);
  EXPECT_EQ(found.faces_undecided, 1u);
  EXPECT_NE(found.why_not.find("ended before"), std::string::npos) << found.why_not;
  EXPECT_FALSE(found.certified);
  EXPECT_EQ(verify_union(Pieces{piece}, far).covers_triangles, Answer::No);
}

TEST(UnionReach, IsMeasuredOutsideOfTheSolid) {
  const TriangleMesh original = box({0, 0, 0}, {1, 1, 1});
  expect_bounds(union_reach(Pieces{box({-0.1, -0.1, -0.1}, {1.2, 1.2, 1.2})}, original), 0.2 * std::sqrt(3));
  expect_bounds(union_reach(Pieces{box({0.1, 0.1, 0.1}, {0.9, 0.9, 0.9}), original}, original), 0);
  expect_bounds(union_reach(Pieces{box({0.4, 0.4, 0.4}, {0.6, 0.6, 1.5})}, inside_out(original)), 0.5);
}

TEST(UnionReach, OfBalls) {
  const TriangleMesh original = box({0, 0, 0}, {1, 1, 1});
  expect_bounds(union_reach(std::vector<Ball>{{{0.5, 0.5, 0.5}, 1}}, original), 0.5);
  expect_bounds(union_reach(std::vector<Ball>{{{0.5, 0.5, 0.5}, 0.4}, {{0.5, 0.25, 0.75}, 0.5}}, original), 0.25);
  expect_bounds(union_reach(std::vector<Ball>{{{0.5, 0.5, 0.5}, 0.4}}, original), 0);
}

TEST(UnionReach, OfBallsIsBoundedByHowDeepTheirCentresLieBeforeAnySearch) {
  const TriangleMesh rod = box({0, 0, 0}, {100, 1, 1});
  std::vector<Ball> balls;
  for (int i = 0; i < 100; ++i) balls.push_back({{i + 0.5, 0.5, 0.5}, 0.9});
  EXPECT_NEAR(union_reach(balls, rod, {.max_cells = 1}).upper, 0.4, 1e-9);
}

TEST(UnionReach, FromOpenTrianglesIsThatOfTheSurfaceOfTheUnion) {
  TriangleMesh open = box({0, 0, 0}, {4, 1, 1});
  open.triangles.pop_back();
  // The wall that the pieces share is far from the open end's triangles, but inside of the union.
  const Pieces pieces{box({0, 0, 0}, {2, 1, 1}), box({2, 0, 0}, {4, 1, 1})};
  EXPECT_LT(union_reach(pieces, open).upper, 0.75);
  const std::vector<Ball> balls{{{2, 0.5, 0.5}, 3}, {{2, 0.5, 0.5}, 0.1}};
  const DistanceBounds found = union_reach(balls, open);
  EXPECT_GT(found.lower, 2.4);
  EXPECT_LT(found.upper, 2.6);
}

// The half-spaces of its faces do not make up a ring: what lies in its hole counted as inside of it.
TEST(UnionReach, FromOpenTrianglesReachesIntoTheHoleOfARing) {
  const TriangleMesh ring = torus(64, 32);
  TriangleMesh open = ring;
  open.triangles.pop_back();
  const TriangleMesh within = box({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01});
  EXPECT_GT(distance_bounds(within, open).lower, 0.5);
  EXPECT_EQ(union_reach(Pieces{ring, within}, open).lower, distance_bounds(within, open).lower);
  EXPECT_EQ(union_reach(Pieces{ring, within}, open).upper, distance_bounds(within, open).upper);
}

TEST(UnionReach, NoPointOfTheSurfaceOfAUnionAroundOpenTrianglesIsFarther) {
  const TriangleMesh open{{{0.2, 0.3, 0.5}, {0.8, 0.3, 0.4}, {0.5, 0.7, 0.6}},
                          {{VertexId{0}, VertexId{1}, VertexId{2}}}};
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> at(0, 1);
  const auto point = [&] { return Vec3{at(random), at(random), at(random)}; };
  Pieces pieces;
  std::vector<Box> boxes;
  for (int i = 0; i < 12; ++i) {
    const Vec3 low = point() * 0.6, high = low + Vec3{0.1, 0.1, 0.1} + point() * 0.3;
    pieces.push_back(box(low, high));
    boxes.push_back({low, high});
  }
  const DistanceBounds reach = union_reach(pieces, open);
  const verify::NearestFace nearest(open);
  int exposed = 0;
  for (int i = 0; i < 20'000; ++i) {
    const TriangleMesh& piece = pieces[i % pieces.size()];
    const Triangle t = piece.triangle(FaceId{std::uint32_t(random() % piece.face_count())});
    const double u = at(random), v = at(random) * (1 - u);
    const Vec3 p = t.a + (t.b - t.a) * u + (t.c - t.a) * v;
    if (std::ranges::count_if(boxes, [&](const Box& b) { return b.contains(p); }) > 1) continue;
    ++exposed;
    EXPECT_LE(nearest.nearest(p, 0).distance, reach.upper);
  }
  EXPECT_GT(exposed, 1000);
}

// The small piece lies at the corner that is farthest away. Its faces have no normals in double precision.
TEST(UnionReach, APieceWithoutNormalsHidesNothing) {
  const TriangleMesh far = make({{10, 10, 10}, {11, 10, 10}, {10, 11, 10}}, {{0, 1, 2}});
  const TriangleMesh small = box({-1e-170, -1e-170, -1e-170}, {1e-170, 1e-170, 1e-170});
  EXPECT_NEAR(union_reach(Pieces{box({0, 0, 0}, {1, 1, 1}), small}, far).upper, std::sqrt(300), 0.2);
}

// The middle of its box is outside of such a piece.
TEST(UnionVolume, OfPiecesThatAreThereTwiceCountsThemOnce) {
  const TriangleMesh slanted = tetrahedron({0, 0, 0}, {4, 0.5, 0}, {4, 4, 0.25}, {3.5, 4, 4});
  const double volume = std::abs(signed_volume(slanted));
  for (const double place : {5.0, 11.0, 30.0}) {
    const TriangleMesh piece = signed_volume(slanted) > 0 ? slanted : inside_out(slanted);
    EXPECT_NEAR(union_volume(Pieces{piece, piece, moved(piece, {place, 3, 7})}), 2 * volume, 1e-6 * volume) << place;
  }
}

TEST(UnionVolume, CountsOverlapsOnce) {
  const TriangleMesh cube = box({0, 0, 0}, {1, 1, 1});
  EXPECT_NEAR(union_volume(Pieces{cube}), 1, 1e-7);
  EXPECT_NEAR(union_volume(Pieces{cube, cube, cube}), 1, 1e-7);
  EXPECT_NEAR(union_volume(Pieces{cube, box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75})}), 1, 1e-7);
  EXPECT_NEAR(union_volume(Pieces{cube, box({0.5, 0, 0}, {1.5, 1, 1})}), 1.5, 1e-7);
  EXPECT_NEAR(union_volume(Pieces{cube, box({1, 0, 0}, {2, 1, 1}), box({5, 5, 5}, {6, 6, 6})}), 3, 1e-7);
  EXPECT_NEAR(union_volume(small_cubes()), 27, 1e-6);
  EXPECT_NEAR(union_volume(Pieces{moved(cube, {1e4, 0, 0}), moved(cube, {1e4 + 0.5, 0, 0})}), 1.5, 1e-6);
}

// A tetrahedron of a campaign, whose void was -5e-9.
TEST(UnionVolume, FarFromTheOriginIsNoLessThanThatOfAPiece) {
  const TriangleMesh piece = tetrahedron({-4764914.664184279, 5392716.7202296015, -1561132.3407013682},
                                         {-4764914.651857092, 5392716.157642355, -1561131.8598227266},
                                         {-4764913.164184279, 5392717.7202296015, -1561133.8407013682},
                                         {-4764913.203213532, 5392716.924670614, -1561133.1835054602});
  const TriangleMesh outwards = signed_volume(piece) > 0 ? piece : inside_out(piece);
  const double volume = signed_volume(outwards), found = union_volume(Pieces{outwards});
  EXPECT_GE(found, volume);
  EXPECT_LE(found, (1 + 1e-7) * volume);
}

TEST(UnionVolume, OfBalls) {
  const double ball = 4 * std::numbers::pi / 3;
  EXPECT_NEAR(union_volume(std::vector<Ball>{{{1, 2, 3}, 1}}), ball, 1e-6 * ball);
  EXPECT_NEAR(union_volume(std::vector<Ball>{{{1, 2, 3}, 1}, {{1, 2, 3}, 1}, {{1, 2, 3.5}, 0.5}}), ball, 1e-6 * ball);
  EXPECT_NEAR(union_volume(std::vector<Ball>{{{0, 0, 0}, 1}, {{9, 0, 0}, 2}}), 9 * ball, 1e-5 * ball);
  const double lens = 5 * std::numbers::pi / 12;  // of unit balls at the distance 1
  for (const Vec3& to : {Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0.6, 0, 0.8}})
    EXPECT_NEAR(union_volume(std::vector<Ball>{{{0, 0, 0}, 1}, {to, 1}}), 2 * ball - lens, 2e-6 * ball);
}

}  // namespace
}  // namespace prohull
