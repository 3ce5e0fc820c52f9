#include "robot/motion/motion.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <thread>

#include "meshes.h"
#include "prohull/error.h"
#include "random.h"
#include "robot_of_joints.h"
#include "robot_testing.h"

namespace prohull::robot {
namespace {

using meshes::box;

constexpr double kHalfTurn = std::numbers::pi;
constexpr double kQuarterTurn = std::numbers::pi / 2;
constexpr Vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

TEST(LinkPoses, OfAPendulumOfTwoLinks) {
  const Robot pendulum =
      robot_of(3, {joint(JointType::Revolute, 0, 1, {0, 0, 3}, kY), joint(JointType::Revolute, 1, 2, {0, 0, -1}, kY)});
  const std::vector<Pose> poses = link_poses(pendulum, std::vector<double>{kQuarterTurn, -kQuarterTurn});
  expect_near(placed(poses[0], {1, 2, 3}), {1, 2, 3});
  expect_near(placed(poses[1], {0, 0, -1}), {-1, 0, 3});  // a quarter turn about y takes -z to -x
  expect_near(placed(poses[2], {0, 0, -1}), {-1, 0, 2});
}

TEST(LinkPoses, OfASlideAndAWheel) {
  Robot robot =
      robot_of(3, {joint(JointType::Prismatic, 0, 1, {1, 0, 0}, kZ), joint(JointType::Continuous, 1, 2, {}, kX)});
  robot.joints[0].origin.rotation = {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};  // takes z to x
  const std::vector<Pose> poses = link_poses(robot, std::vector<double>{0.5, 3 * kHalfTurn});
  expect_near(poses[1].translation, {1.5, 0, 0});
  expect_near(placed(poses[2], {0, 1, 0}), {1.5, 0, -1});
}

TEST(LinkPoses, TurnsAboutAnAnchor) {
  Robot robot = robot_of(2, {joint(JointType::Revolute, 0, 1, {0, 0, 5}, kZ)});
  robot.joints[0].anchor = {1, 0, 0};
  const std::vector<Pose> poses = link_poses(robot, std::vector<double>{kQuarterTurn});
  expect_near(placed(poses[1], {1, 0, 0}), {1, 0, 5});
  expect_near(poses[1].translation, {1, -1, 5});
}

TEST(LinkPoses, MovesALinkByAllJointsInARow) {
  const Robot robot =
      robot_of(2, {joint(JointType::Prismatic, 0, 1, {1, 0, 0}, kX), joint(JointType::Revolute, 0, 1, {}, kZ),
                   joint(JointType::Prismatic, 0, 1, {}, kX)});
  const std::vector<Pose> poses = link_poses(robot, std::vector<double>{10, kQuarterTurn, 0.5});
  expect_near(poses[1].translation, {11, 0.5, 0});
}

TEST(LinkPoses, FollowsChainsOfMimics) {
  // 0 follows 1, and 1 follows 2: the order of the joints does not matter
  const Robot robot = robot_of(
      4, {mimicking(joint(JointType::Prismatic, 0, 1, {}, kX), 1, -1, 0),
          mimicking(joint(JointType::Prismatic, 0, 2, {}, kX), 2, 2, 0.25), joint(JointType::Prismatic, 0, 3, {}, kX)});
  const std::vector<Pose> poses = link_poses(robot, std::vector<double>{7., 7., 1.});
  expect_near(poses[3].translation, {1, 0, 0});
  expect_near(poses[2].translation, {2.25, 0, 0});
  expect_near(poses[1].translation, {-2.25, 0, 0});
}

TEST(LinkPoses, KeepsThePositionsOfACircleOfMimics) {
  const Robot robot = robot_of(4, {mimicking(joint(JointType::Prismatic, 0, 1, {}, kX), 1, 2, 0),
                                   mimicking(joint(JointType::Prismatic, 0, 2, {}, kX), 0, 2, 0),
                                   mimicking(joint(JointType::Prismatic, 0, 3, {}, kX), 2, 2, 0)});
  const std::vector<Pose> poses = link_poses(robot, std::vector<double>{1., 2., 3.});
  expect_near(poses[1].translation, {1, 0, 0});
  expect_near(poses[2].translation, {2, 0, 0});
  expect_near(poses[3].translation, {3, 0, 0});
}

TEST(LinkPoses, LeavesJointsThatAreNotReadAtRest) {
  const Robot robot = robot_of(4, {joint(JointType::Ball, 0, 1, kX, kX), joint(JointType::Planar, 0, 2, kY, kX),
                                   joint(JointType::Floating, 0, 3, kZ, kX)});
  const std::vector<Pose> poses = link_poses(robot, std::vector<double>{1., 1., 1.});
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(poses[i].rotation, Pose().rotation);
  EXPECT_EQ(poses[2].translation, kY);
}

TEST(LinkPoses, NeedsNoStackForLongChains) {
  constexpr std::size_t kLinks = 10'000;
  std::vector<Joint> joints;
  for (std::size_t i = 1; i < kLinks; ++i) {
    joints.push_back(joint(JointType::Prismatic, i - 1, i, {}, kX));
    if (i + 1 < kLinks) joints.back().mimic = Mimic{i, 1, 0};
  }
  const Robot robot = robot_of(kLinks, joints);
  std::vector<double> positions(joints.size());
  positions.back() = 2;
  expect_near(link_poses(robot, positions).back().translation, {2. * (kLinks - 1), 0, 0});
}

TEST(RestPositions, AreZeroWhereLimitsAllowItAndTheMiddleElsewhere) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Joint free = joint(JointType::Revolute, 0, 1, {}, kX);
  const Robot robot = robot_of(
      2, {free, limited(free, -1, 3), limited(free, 1, 3), limited(free, -3, -2), limited(free, 1, kInfinity)});
  EXPECT_EQ(rest_positions(robot), (std::vector<double>{0, 0, 2, -2.5, 0}));
  const Robot gripper = robot_of(3, {limited(free, -2, 2), mimicking(limited(free, 1, 3), 0, 2, 0)});
  EXPECT_NEAR(rest_positions(gripper)[0], 1, 1e-12) << "so that both are within their limits";
  Joint drawn = limited(free, -1, 3);
  drawn.rest = 2;
  EXPECT_EQ(rest_positions(robot_of(2, {drawn, limited(drawn, -1, 1)})), (std::vector<double>{2, 0}));
}

TEST(RandomPositions, KeepTheLimitsAndReachThem) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Joint revolute = joint(JointType::Revolute, 0, 1, {}, kX),
              prismatic = joint(JointType::Prismatic, 0, 1, {}, kX);
  const Robot robot =
      robot_of(2, {limited(revolute, -0.5, 2), limited(prismatic, 0.1, 0.2), prismatic,
                   joint(JointType::Continuous, 0, 1, {}, kX), revolute, limited(prismatic, 0.3, kInfinity),
                   limited(prismatic, -1e16, 1e16), mimicking(limited(revolute, -2, 1), 0, -2, 0.5)});
  const std::vector<std::pair<double, double>> expected{
      {-0.25, 1.25}, {0.1, 0.2}, {0, 0}, {-kHalfTurn, kHalfTurn}, {-kHalfTurn, kHalfTurn}, {0.3, 0.3}, {0, 0}, {-2, 1}};
  std::vector<double> least(expected.size(), kInfinity), greatest(expected.size(), -kInfinity);
  for (std::size_t k = 0; k < 10'000; ++k) {
    const std::vector<double> positions = random_positions(robot, test_seed(), k);
    ASSERT_EQ(positions.size(), expected.size());
    EXPECT_EQ(positions[7], -2 * positions[0] + 0.5);
    for (std::size_t j = 0; j < positions.size(); ++j) {
      least[j] = std::min(least[j], positions[j]);
      greatest[j] = std::max(greatest[j], positions[j]);
    }
  }
  for (std::size_t j = 0; j < expected.size(); ++j) {
    const auto& [lower, upper] = expected[j];
    EXPECT_GE(least[j], lower) << j;
    EXPECT_LE(greatest[j], upper) << j;
    EXPECT_LE(least[j], lower + 0.01 * (upper - lower)) << j;
    EXPECT_GE(greatest[j], upper - 0.01 * (upper - lower)) << j;
  }
}

TEST(RandomPositions, DependOnSeedAndNumberOnly) {
  const Robot robot =
      robot_of(3, {joint(JointType::Continuous, 0, 1, {}, kX), joint(JointType::Continuous, 1, 2, {}, kX)});
  EXPECT_EQ(random_positions(robot, 3, 4), random_positions(robot, 3, 4));
  EXPECT_NE(random_positions(robot, 3, 4), random_positions(robot, 3, 5));
  EXPECT_NE(random_positions(robot, 3, 4), random_positions(robot, 4, 4));
  EXPECT_NE(random_positions(robot, 3, 4)[0], random_positions(robot, 3, 4)[1]);
}

// A wall, a rod on a hinge at x = 1, and a lever on a hinge at the end of the rod, at x = 2, all in one plane. The rod
// stays where it is; the lever turns, and its end reaches the wall.
struct Lever {
  static constexpr double kLength = 2.2, kHalfWidth = 0.1;
  Robot robot = robot_of(3, {limited(joint(JointType::Revolute, 0, 1, {1, 0, 0}, kZ), 0, 0),
                             joint(JointType::Continuous, 1, 2, {1, 0, 0}, kZ)});

  /// Each box grown by a margin on all sides.
  static std::vector<TriangleMesh> bodies(double margin) {
    const Vec3 m{margin, margin, margin};
    return {box(Vec3{-2, -5, -1} - m, Vec3{0, 5, 1} + m), box(Vec3{0.1, -0.01, -1} - m, Vec3{0.9, 0.01, 1} + m),
            box(Vec3{0, -kHalfWidth, -1} - m, Vec3{kLength, kHalfWidth, 1} + m)};
  }

  /// Whether a corner of the lever is in the wall: 2 + x cos(angle) - y sin(angle) <= 0.
  static bool is_hit(double angle, double margin) {
    const double length = kLength + margin, width = kHalfWidth + margin;
    return 2 + length * std::cos(angle) - width * std::abs(std::sin(angle)) <= margin;
  }

  std::size_t hits(double margin, std::size_t configurations, std::uint64_t seed) const {
    std::size_t count = 0;
    for (std::size_t k = 0; k < configurations; ++k) count += is_hit(random_positions(robot, seed, k)[1], margin);
    return count;
  }
};

TEST(CheckMotion, CountsWhatTheAnglesSay) {
  const Lever lever;
  const MotionOptions options{.configurations = 1000, .seed = test_seed()};
  const MotionResult result =
      check_motion(lever.robot, {Lever::bodies(0), Lever::bodies(0.02), Lever::bodies(0.1)}, options);
  const std::size_t visual = lever.hits(0, 1000, options.seed), hull = lever.hits(0.02, 1000, options.seed),
                    convex = lever.hits(0.1, 1000, options.seed);
  ASSERT_GT(visual, 0U);
  ASSERT_GT(hull, visual);
  ASSERT_GT(convex, hull);
  EXPECT_EQ(result.configurations, 1000U);
  EXPECT_EQ(result.seed, options.seed);
  ASSERT_EQ(result.pairs.size(), 3U);
  EXPECT_EQ(result.pairs[0].kind, PairKind::Adjacent);
  EXPECT_EQ(result.pairs[2].kind, PairKind::Adjacent);
  const MotionPair& pair = result.pairs[1];
  EXPECT_EQ(pair.a, 0U);
  EXPECT_EQ(pair.b, 2U);
  EXPECT_EQ(pair.kind, PairKind::Sometimes);
  EXPECT_EQ(pair.visual, visual);
  EXPECT_EQ(pair.hull, hull);
  EXPECT_EQ(pair.convex, convex);
  EXPECT_EQ(result.false_hull(), hull - visual);
  EXPECT_EQ(result.false_convex(), convex - visual);
  EXPECT_EQ(result.missed(), 0U);
  EXPECT_EQ(result.visual_configurations, visual);
  EXPECT_EQ(result.hull_configurations, hull);
  EXPECT_EQ(result.convex_configurations, convex);
  EXPECT_GT(result.visual_us, 0);
  EXPECT_GT(result.hull_us, 0);
}

TEST(CheckMotion, FindsHullsThatDoNotEnclose) {
  const Lever lever;
  const MotionOptions options{.configurations = 1000, .seed = test_seed()};
  const MotionResult result =
      check_motion(lever.robot, {Lever::bodies(0), Lever::bodies(-0.005), Lever::bodies(0.1)}, options);
  const std::size_t missed = lever.hits(0, 1000, options.seed) - lever.hits(-0.005, 1000, options.seed);
  ASSERT_GT(missed, 0U);
  EXPECT_EQ(result.missed(), missed);
  EXPECT_EQ(result.false_hull(), 0U);
}

TEST(CheckMotion, DoesNotCallAPairFreeThatCollides) {
  const Lever lever;
  std::vector<TriangleMesh> wrong = Lever::bodies(0);
  wrong[2] = box({0, 0, 0}, {0.01, 0.01, 0.01});
  const MotionResult result = check_motion(lever.robot, {Lever::bodies(0), wrong, {}}, {.configurations = 300});
  EXPECT_EQ(result.pairs[1].hull, 0U);
  EXPECT_GT(result.missed(), 0U);
  EXPECT_EQ(result.pairs[1].kind, PairKind::Sometimes);
  const std::vector<TriangleMesh> meshes = Lever::bodies(0);
  const MotionResult unmoved = check_motion(lever.robot, {meshes, meshes, meshes}, {.configurations = 0});
  EXPECT_EQ(unmoved.pairs[1].kind, PairKind::Sometimes) << "nothing is known about it";
}

bool same_counts(const MotionPair& a, const MotionPair& b) {
  return a.a == b.a && a.b == b.b && a.kind == b.kind && a.visual == b.visual && a.hull == b.hull &&
         a.convex == b.convex && a.false_hull == b.false_hull && a.false_convex == b.false_convex &&
         a.missed == b.missed;
}

TEST(CheckMotion, CountsTheSameWithAnyNumberOfThreads) {
  const Lever lever;
  const Bodies bodies{Lever::bodies(0), Lever::bodies(0.02), Lever::bodies(0.1)};
  const MotionResult one = check_motion(lever.robot, bodies, {.configurations = 500, .seed = 7, .threads = 1});
  const MotionResult two = check_motion(lever.robot, bodies, {.configurations = 500, .seed = 7, .threads = 2});
  ASSERT_EQ(one.pairs.size(), two.pairs.size());
  for (std::size_t p = 0; p < one.pairs.size(); ++p) EXPECT_TRUE(same_counts(one.pairs[p], two.pairs[p])) << p;
  EXPECT_EQ(one.visual_configurations, two.visual_configurations);
  EXPECT_EQ(one.hull_configurations, two.hull_configurations);
  EXPECT_EQ(one.convex_configurations, two.convex_configurations);
  EXPECT_GT(one.false_convex(), 0U);
}

std::vector<TriangleMesh> cubes(const std::vector<bool>& there) {
  std::vector<TriangleMesh> meshes;
  for (const bool is_there : there) meshes.push_back(is_there ? box({-1, -1, -1}, {1, 1, 1}) : TriangleMesh());
  return meshes;
}

PairKind kind_of(const MotionResult& result, std::size_t a, std::size_t b) {
  for (const MotionPair& pair : result.pairs)
    if (pair.a == a && pair.b == b) return pair.kind;
  ADD_FAILURE() << "no pair " << a << ", " << b;
  return PairKind::Sometimes;
}

TEST(CheckMotion, TellsAdjacentPairsFromOthers) {
  // 0 - (1 without geometry, fixed to it) - 2 and 3, which share the empty parent; 4 and 5 are fixed to 2; 6 moves far
  // from all; 7 hangs on 5 by a fixed and a moving joint
  Robot robot = robot_of(8, {joint(JointType::Fixed, 0, 1, {}, kX), joint(JointType::Continuous, 1, 2, {}, kX),
                             joint(JointType::Continuous, 1, 3, {}, kX), joint(JointType::Fixed, 2, 4, {}, kX),
                             joint(JointType::Fixed, 4, 5, {}, kX), joint(JointType::Continuous, 3, 6, {100, 0, 0}, kX),
                             joint(JointType::Fixed, 5, 7, {}, kX), joint(JointType::Continuous, 5, 7, {}, kX)});
  robot.links[1].visual.clear();
  const std::vector<TriangleMesh> meshes = cubes({true, false, true, true, true, true, true, true});
  const MotionResult result = check_motion(robot, {meshes, meshes, meshes}, {.configurations = 20});
  EXPECT_EQ(result.pairs.size(), 21U) << "an empty link is in no pair";
  EXPECT_EQ(kind_of(result, 0, 2), PairKind::Adjacent);
  EXPECT_EQ(kind_of(result, 0, 3), PairKind::Adjacent);
  EXPECT_EQ(kind_of(result, 2, 3), PairKind::Always) << "both hang on the same link, and may collide";
  EXPECT_EQ(kind_of(result, 2, 5), PairKind::Adjacent) << "fixed joints connect them";
  EXPECT_EQ(kind_of(result, 0, 4), PairKind::Always) << "link 2 is between them";
  EXPECT_EQ(kind_of(result, 3, 6), PairKind::Adjacent);
  EXPECT_EQ(kind_of(result, 0, 6), PairKind::Never);
  EXPECT_EQ(kind_of(result, 5, 7), PairKind::Adjacent);
  EXPECT_EQ(kind_of(result, 4, 7), PairKind::Always) << "the second joint of the row moves";
  EXPECT_EQ(result.hull_configurations, 0U) << "pairs that always collide do not count";
}

/// A crane: its slider has no geometry, and what it turns comes back to the base.
Robot crane(JointType slider) {
  Robot robot =
      robot_of(3, {limited(joint(slider, 0, 1, {2, 0, 0}, kX), -3, 3), joint(JointType::Continuous, 1, 2, {}, kZ)});
  robot.links[1].visual.clear();
  return robot;
}

TEST(CheckMotion, ComparesLinksBetweenWhichTwoJointsMove) {
  const std::vector<TriangleMesh> meshes = cubes({true, false, true});
  const auto kind_with = [&](JointType slider) {
    return kind_of(check_motion(crane(slider), {meshes, meshes, meshes}, {.configurations = 20}), 0, 2);
  };
  EXPECT_EQ(kind_with(JointType::Fixed), PairKind::Adjacent);
  EXPECT_EQ(kind_with(JointType::Prismatic), PairKind::Sometimes);
}

MotionResult with_cubes(const Robot& robot, const std::vector<bool>& there) {
  const std::vector<TriangleMesh> meshes = cubes(there);
  return check_motion(robot, {meshes, meshes, meshes}, {.configurations = 20});
}

/// The pairs of links that an SRDF disables, as "link1 link2 reason".
std::vector<std::string> disabled(const Robot& robot, const MotionResult& result) {
  std::vector<std::string> found;
  const std::string text = srdf_of(robot, result, true);
  for (std::size_t at = 0; (at = text.find("<disable_collisions", at)) != std::string::npos; ++at) {
    std::string pair;
    std::size_t quote = at;
    for (int word = 0; word < 3; ++word) {
      const std::size_t begin = text.find('"', quote) + 1, end = text.find('"', begin);
      if (word > 0) pair += ' ';
      pair.append(text, begin, end - begin);
      quote = end + 1;
    }
    found.push_back(pair);
  }
  return found;
}

using Pairs = std::vector<std::string>;

TEST(CheckMotion, KnowsNothingAboutLinksThatStayAtRest) {
  // 0 and 2 are never in collision, and 1 and 2 are neighbours, as far as random positions tell
  const auto disabled_with = [](const Joint& first) {
    const Robot robot = robot_of(3, {first, joint(JointType::Continuous, 1, 2, {5, 0, 0}, kX)});
    return disabled(robot, with_cubes(robot, {true, true, true}));
  };
  const auto at_5 = [](JointType type) { return joint(type, 0, 1, {5, 0, 0}, kX); };
  const Pairs only_neighbours{"link0 link1 Adjacent", "link1 link2 Adjacent"};
  EXPECT_EQ(disabled_with(at_5(JointType::Continuous)),
            (Pairs{"link0 link1 Adjacent", "link0 link2 sampled", "link1 link2 Adjacent"}));
  EXPECT_EQ(disabled_with(limited(at_5(JointType::Prismatic), 0, 1)).size(), 3U);
  EXPECT_EQ(disabled_with(at_5(JointType::Prismatic)), only_neighbours);
  EXPECT_EQ(disabled_with(limited(at_5(JointType::Prismatic), 0, 1e5)), only_neighbours);
  EXPECT_EQ(disabled_with(at_5(JointType::Ball)), only_neighbours);
  EXPECT_EQ(disabled_with(at_5(JointType::Planar)), Pairs{"link1 link2 Adjacent"});
  EXPECT_EQ(disabled_with(at_5(JointType::Floating)), Pairs{"link1 link2 Adjacent"});
  // in collision in all configurations, but only while it rests
  EXPECT_EQ(disabled_with(joint(JointType::Floating, 0, 1, {-5, 0, 0}, kX)), Pairs{"link1 link2 Adjacent"});
  const Robot two_trees = robot_of(2, {});
  EXPECT_EQ(disabled(two_trees, with_cubes(two_trees, {true, true})), Pairs{});
}

TEST(CheckMotion, KnowsNothingAboutLinksInARowWithAJointAtRest) {
  for (const bool ball_first : {false, true}) {
    const Joint turns = joint(JointType::Continuous, 0, 1, {5, 0, 0}, kX), ball = joint(JointType::Ball, 0, 1, {}, kX);
    const Robot robot = robot_of(
        3, {ball_first ? ball : turns, ball_first ? turns : ball, joint(JointType::Continuous, 1, 2, {5, 0, 0}, kX)});
    EXPECT_EQ(disabled(robot, with_cubes(robot, {true, true, true})),
              (Pairs{"link0 link1 Adjacent", "link1 link2 Adjacent"}));
  }
}

TEST(CheckMotion, KnowsNothingAboutLinksThatFollowAJointAtRest) {
  const auto kind_with = [](const Joint& followed) {
    const Robot robot = robot_of(5, {followed, mimicking(joint(JointType::Prismatic, 0, 2, {}, kX), 2, 1, 0),
                                     mimicking(joint(JointType::Prismatic, 0, 3, {}, kX), 0, 1, 0),
                                     joint(JointType::Continuous, 2, 4, {50, 0, 0}, kX)});
    return kind_of(with_cubes(robot, {true, true, true, true, true}), 0, 4);
  };
  const Joint slide = joint(JointType::Prismatic, 0, 1, {}, kX);
  EXPECT_EQ(kind_with(slide), PairKind::Sometimes);
  EXPECT_EQ(kind_with(limited(slide, 0, 1)), PairKind::Never);
}

TEST(CheckMotion, DoesNotTakeASkippedLinkForAnEmptyOne) {
  Robot robot =
      robot_of(3, {joint(JointType::Continuous, 0, 1, {2, 0, 0}, kZ), joint(JointType::Fixed, 1, 2, {2, 0, 0}, kZ)});
  EXPECT_EQ(kind_of(with_cubes(robot, {true, false, true}), 0, 2), PairKind::Sometimes);
  robot.links[1].visual = {{OtherForm{"ellipsoid"}}};
  EXPECT_EQ(kind_of(with_cubes(robot, {true, false, true}), 0, 2), PairKind::Sometimes);
  std::swap(robot.links[1].visual, robot.links[1].collision);
  EXPECT_EQ(kind_of(with_cubes(robot, {true, false, true}), 0, 2), PairKind::Sometimes);
  robot.links[1].collision.clear();
  EXPECT_EQ(kind_of(with_cubes(robot, {true, false, true}), 0, 2), PairKind::Adjacent);
}

TEST(CheckMotion, DisablesNoPairOfALinkWithoutAHull) {
  // all would be adjacent, or never in collision
  const Robot robot =
      robot_of(4, {joint(JointType::Continuous, 0, 1, {5, 0, 0}, kX), joint(JointType::Fixed, 1, 2, {5, 0, 0}, kX),
                   joint(JointType::Continuous, 0, 3, {-5, 0, 0}, kX)});
  const std::vector<TriangleMesh> visual = cubes({true, true, true, true}), hulls = cubes({true, false, true, true});
  const MotionResult result = check_motion(robot, {visual, hulls, visual}, {.configurations = 20});
  EXPECT_EQ(disabled(robot, result), (Pairs{"link0 link2 sampled", "link0 link3 Adjacent", "link2 link3 sampled"}));
}

TEST(CheckMotion, MissesNothingWhereThereIsNoHull) {
  const Lever lever;
  std::vector<TriangleMesh> hulls = Lever::bodies(-0.005);  // the wall's one does not enclose
  hulls[2] = TriangleMesh();
  const MotionResult result =
      check_motion(lever.robot, {Lever::bodies(0), hulls, Lever::bodies(0)}, {.configurations = 1000});
  EXPECT_GT(result.pairs[1].visual, result.pairs[1].hull);
  EXPECT_EQ(result.missed(), 0U);
}

TEST(CheckMotion, TakesTheVisualGeometryWhereThereIsNoHull) {
  const Lever lever;
  std::vector<TriangleMesh> hulls = Lever::bodies(0.02);
  hulls[0] = TriangleMesh();
  const MotionResult result = check_motion(lever.robot, {Lever::bodies(0), hulls, {}}, {.configurations = 300});
  const MotionPair& pair = result.pairs[1];
  EXPECT_GT(pair.visual, 0U);
  EXPECT_GE(pair.hull, pair.visual);
  EXPECT_EQ(pair.convex, pair.hull);
  EXPECT_EQ(pair.kind, PairKind::Sometimes) << "a pair without hulls is not said to be free";
}

TEST(CheckMotion, LeavesBrokenFacesOut) {
  const Lever lever;
  std::vector<TriangleMesh> visual = Lever::bodies(0);
  const VertexId nan = visual[2].positions.push_back({std::nan(""), 0, 0});
  visual[2].triangles.push_back({VertexId(0), VertexId(1), nan});
  const MotionOptions options{.configurations = 300, .seed = 5};
  const MotionResult result = check_motion(lever.robot, {visual, Lever::bodies(0.02), Lever::bodies(0.1)}, options);
  EXPECT_EQ(result.pairs[1].visual, lever.hits(0, 300, 5));
}

TEST(CheckMotion, StopsWhereItIsAskedTo) {
  const Lever lever;
  const std::vector<TriangleMesh> meshes = Lever::bodies(0);
  MotionOptions options{.configurations = 1'000'000};
  int calls = 0;
  options.progress = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "move");
    EXPECT_LE(fraction, 1);
    return ++calls < 3;
  };
  EXPECT_THROW(check_motion(lever.robot, {meshes, meshes, meshes}, options), Cancelled);
  EXPECT_EQ(calls, 3);
}

TEST(CheckMotion, StopsWhileItMeasuresTimes) {
  const Lever lever;
  const std::vector<TriangleMesh> meshes = Lever::bodies(0);
  MotionOptions options{.configurations = 1, .threads = 1};
  int calls = 0;
  options.progress = [&](std::string_view, double fraction) {
    EXPECT_EQ(fraction, 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(25));  // so that each question is asked
    return ++calls < 8;  // one is about the configuration, one about the checks in it, six about their times
  };
  EXPECT_THROW(check_motion(lever.robot, {meshes, meshes, meshes}, options), Cancelled);
  EXPECT_EQ(calls, 8);
}

TEST(CheckMotion, TakesRobotsWithoutGeometry) {
  const MotionResult result = check_motion(Robot(), {});
  EXPECT_TRUE(result.pairs.empty());
  EXPECT_EQ(result.hull_us, 0);
}

/// Random configurations prove nothing: two links of the arm sample collide where none of 1,000 has found them.
TEST(SrdfOf, ListsSampledPairsOnlyOnRequest) {
  Robot robot = robot_of(4, {});
  robot.name = "a&b";
  robot.links[0].name = "z";
  robot.links[1].name = "<b>";
  MotionResult motion;
  motion.configurations = 20, motion.seed = 3;
  motion.pairs = {
      {0, 1, PairKind::Adjacent}, {0, 2, PairKind::Sometimes}, {0, 3, PairKind::Always}, {1, 3, PairKind::Never}};
  EXPECT_EQ(srdf_of(robot, motion), R"(<?xml version="1.0" encoding="utf-8"?>
<!-- Of links whose collision geometry is proven to cover them: pairs that joints connect, and pairs proven to meet never or always. All others have to be checked. -->
<robot name="a&amp;b">
  <disable_collisions link1="&lt;b&gt;" link2="z" reason="Adjacent"/>
</robot>
)");
  EXPECT_EQ(srdf_of(robot, motion, true), R"(<?xml version="1.0" encoding="utf-8"?>
<!-- The reason "sampled" is what 20 random configurations, seed 3, say of a pair: it is no proof. -->
<robot name="a&amp;b">
  <disable_collisions link1="&lt;b&gt;" link2="link3" reason="sampled"/>  <!-- in collision in none of them -->
  <disable_collisions link1="&lt;b&gt;" link2="z" reason="Adjacent"/>
  <disable_collisions link1="link3" link2="z" reason="sampled"/>  <!-- in collision in 95 % or more of them -->
</robot>
)");
  EXPECT_EQ(disabled_pairs(robot, srdf_of(robot, motion), "a.srdf"), (std::vector<LinkPair>{{0, 1}}));
  EXPECT_EQ(disabled_pairs(robot, srdf_of(robot, motion, true), "a.srdf"),
            (std::vector<LinkPair>{{0, 1}, {0, 3}, {1, 3}}));
  EXPECT_EQ(name_of(PairKind::Never), "sampled-never");
  EXPECT_EQ(pairs_always_together(motion), (std::vector<LinkPair>{{0, 1}, {0, 3}}));
}

TEST(DisabledPairs, LeavesOutLinksThatTheRobotDoesNotHave) {
  const Robot robot = robot_of(2, {});
  const std::string names = R"(link1="link0" link2="link1")";
  EXPECT_EQ(disabled_pairs(robot, "<robot><disable_collisions " + names + "/></robot>", "").size(), 1U);
  EXPECT_TRUE(disabled_pairs(robot, R"(<robot><disable_collisions link1="link0" link2="x"/></robot>)", "").empty());
  EXPECT_THROW(disabled_pairs(robot, R"(<robot><disable_collisions link1="link0"/></robot>)", ""), InputError);
  EXPECT_THROW(disabled_pairs(robot, "<sdf/>", ""), InputError);
  EXPECT_THROW(disabled_pairs(robot, "<robot>", ""), InputError);
}

}  // namespace
}  // namespace prohull::robot
