#include "robot/motion/path_proof.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "meshes.h"
#include "prohull/error.h"
#include "random.h"
#include "robot/motion/kinematics.h"
#include "robot_of_joints.h"
#include "robot_testing.h"
#include "sample_arm.h"

namespace prohull::robot::of_path_proof {
namespace {

constexpr Vec3 kAlongX{1, 0, 0}, kAlongZ{0, 0, 1};

/// Two cubes of side 1, the second of which slides along x; its position is how far it is from the first.
struct Slide {
  Robot robot = robot_of(2, {limited(joint(JointType::Prismatic, 0, 1, {1, 0, 0}, kAlongX), -5, 5)});
  std::vector<PathBody> bodies{path_body("a", 0, meshes::box({0, 0, 0}, {1, 1, 1})),
                               path_body("b", 1, meshes::box({0, 0, 0}, {1, 1, 1}))};

  JointPath path(std::vector<double> times, std::vector<std::vector<double>> positions) const {
    return JointPath(robot, {.joints = {"joint0"}, .times = std::move(times), .positions = std::move(positions)});
  }
  PathPairProof proof(const JointPath& path, const PathProofOptions& options = {}) const {
    const BodyPair pair{0, 1};
    return prove_paths(robot, std::span(&path, 1), bodies, std::span(&pair, 1), options)[0].pairs[0];
  }
};

TEST(PathProof, FindsTheTimeOfAKnownContact) {
  const Slide slide;
  for (const double end : {-0.5, -1e-3}) {
    const JointPath path = slide.path({10, 14}, {{1}, {end}});  // contact at position 0
    const PathPairProof proof = slide.proof(path);
    ASSERT_EQ(proof.verdict, PathVerdict::Meets) << proof.why;
    const double contact = 10 + 4 / (1 - end);
    EXPECT_LE(path.time_at(proof.begin), contact);
    EXPECT_GE(path.time_at(proof.end), contact - 1e-12);
    EXPECT_LT(path.time_at(proof.end) - path.time_at(proof.begin), 1e-9);
    EXPECT_NEAR(proof.positions[0], 0, 1e-9);
  }
  EXPECT_EQ(slide.proof(slide.path({}, {{1}, {1e-6}})).verdict, PathVerdict::Free);
  EXPECT_EQ(slide.proof(slide.path({}, {{1}, {0}})).verdict, PathVerdict::Meets) << "touching counts";
}

TEST(PathProof, KeepsTheTreeOfItsPiecesIfAsked) {
  const Slide slide;
  const PathPairProof free = slide.proof(slide.path({}, {{3}, {0.1}, {2}}), {.keep_trees = true});
  EXPECT_EQ(free.tree.size(), free.cells);
  EXPECT_EQ(std::ranges::count(free.tree, kLeaf), std::ranges::count(free.tree, 0) + 1);
  EXPECT_TRUE(slide.proof(slide.path({}, {{3}, {0.1}, {2}})).tree.empty());
  EXPECT_TRUE(slide.proof(slide.path({}, {{3}, {-0.1}, {2}}), {.keep_trees = true}).tree.empty());
}

TEST(PathProof, FindsTheFirstOfSeveralContacts) {
  const Slide slide;
  const PathPairProof proof = slide.proof(slide.path({0, 1, 2, 3, 4}, {{1}, {-1e-3}, {1}, {-2}, {3}}));
  ASSERT_EQ(proof.verdict, PathVerdict::Meets);
  EXPECT_NEAR(proof.begin, 1 / 1.001, 1e-9);
  EXPECT_NEAR(proof.end, 1 / 1.001, 1e-9);
  const PathPairProof at_once = slide.proof(slide.path({}, {{-0.5}, {3}}));
  EXPECT_EQ(at_once.verdict, PathVerdict::Meets);
  EXPECT_EQ(at_once.begin, 0);
  EXPECT_EQ(at_once.end, 0);
}

TEST(PathProof, DecidesASinglePosition) {
  const Slide slide;
  EXPECT_EQ(slide.proof(slide.path({}, {{1}})).verdict, PathVerdict::Free);
  EXPECT_EQ(slide.proof(slide.path({}, {{-0.5}})).verdict, PathVerdict::Meets);
  const PathPairProof close = slide.proof(slide.path({}, {{1e-15}}));
  EXPECT_EQ(close.verdict, PathVerdict::Open);
  EXPECT_EQ(close.why, "rounding hides whether they touch");
  EXPECT_EQ(slide.proof(slide.path({}, {{1 + 1e-15}}), {.gap = 1}).why,
            "rounding hides whether they are closer than the gap");
  const PathPairProof still = slide.proof(slide.path({}, {{1}, {1}}));
  EXPECT_EQ(still.verdict, PathVerdict::Free);
  EXPECT_TRUE(still.nothing_moves);
  EXPECT_FALSE(slide.proof(slide.path({}, {{1}, {2}})).nothing_moves);
}

TEST(PathProof, KeepsAGap) {
  const Slide slide;
  const JointPath path = slide.path({0, 1, 2}, {{1}, {0.25}, {1}});
  EXPECT_EQ(slide.proof(path, {.gap = 0.249}).verdict, PathVerdict::Free);
  const PathPairProof closer = slide.proof(path, {.gap = 0.5});
  ASSERT_EQ(closer.verdict, PathVerdict::Meets);
  EXPECT_NEAR(closer.begin, 2. / 3, 1e-9);
  EXPECT_NEAR(closer.end, 2. / 3, 1e-9);
  EXPECT_LE(closer.positions[0], 0.5 + 1e-12);
}

// Both rows are far from the other cube; the velocities carry the cubic to it, and the straight line would be free.
TEST(PathProof, FollowsCubicsAndQuintics) {
  const Slide slide;
  PathRows rows{.joints = {"joint0"}, .times = {0, 2}, .positions = {{1}, {1}}, .velocities = {{-3}, {3}}};
  // Position 1 - 3 t (1 - t / 2)^2 - 3 t^2 / 2 (1 - t / 2) = 1 - 3 t + 1.5 t^2, and 0 at 1 - sqrt(1 / 3)
  const PathPairProof cubic = slide.proof(JointPath(slide.robot, rows));
  ASSERT_EQ(cubic.verdict, PathVerdict::Meets);
  EXPECT_NEAR(2 * cubic.begin, 1 - std::sqrt(1. / 3), 1e-9);
  EXPECT_NEAR(2 * cubic.end, 1 - std::sqrt(1. / 3), 1e-9);
  rows.accelerations = {{3}, {3}};  // the same parabola
  const PathPairProof quintic = slide.proof(JointPath(slide.robot, rows));
  EXPECT_NEAR(2 * quintic.end, 1 - std::sqrt(1. / 3), 1e-9);
  rows.velocities[1].clear(), rows.accelerations.clear();
  EXPECT_EQ(slide.proof(JointPath(slide.robot, rows)).verdict, PathVerdict::Free) << "a straight line";
}

/// 1 + 1e-6 - 4 t + 4 t^2
JointPath near_miss(const Slide& slide) {
  const double far = 1 + 1e-6;
  return JointPath(slide.robot, {.joints = {"joint0"}, .positions = {{far}, {far}}, .velocities = {{-4}, {4}}});
}

TEST(PathProof, StaysOpenWhereCellsAreUsedUp) {
  const Slide slide;
  const PathPairProof proof = slide.proof(near_miss(slide), {.cells = 20});
  EXPECT_EQ(proof.verdict, PathVerdict::Open);
  EXPECT_EQ(proof.why, "the number of cells is used up");
  EXPECT_LE(proof.cells, 20U);
  EXPECT_GT(proof.begin, 0.4);
  EXPECT_LE(proof.begin, 0.5);
  EXPECT_GE(proof.end, 0.5);
  EXPECT_LT(proof.end, 0.6);
  const PathPairProof free = slide.proof(near_miss(slide));
  EXPECT_EQ(free.verdict, PathVerdict::Free);
  EXPECT_LT(free.cells, 100U);
}

TEST(PathProof, IsCancelled) {
  const Slide slide;
  EXPECT_THROW(slide.proof(near_miss(slide), {.progress = [](auto, double) { return false; }}), Cancelled);
}

TEST(PathProof, ComparesWithTheWorldInTheFrameOfTheRoot) {
  Robot robot = robot_of(3, {joint(JointType::Fixed, 0, 1, {0, 5, 0}, kAlongX),
                             limited(joint(JointType::Revolute, 1, 2, {0, 0, 0}, kAlongZ), -3, 3)});
  // A lever of length 2 at y = 5 turns from x towards y, where a wall is at y = 6: asin(1 / 2), but for its thickness.
  const std::vector<PathBody> bodies{path_body("lever", 2, meshes::box({0, -1e-9, -1}, {2, 1e-9, 1})),
                                     path_body("wall", {}, meshes::box({-9, 6, -9}, {9, 7, 9}))};
  const BodyPair pair{0, 1};
  const JointPath path(robot, {.joints = {"joint1"}, .positions = {{0}, {1}}});
  const PathProof proof = prove_paths(robot, std::span(&path, 1), bodies, std::span(&pair, 1)).front();
  EXPECT_EQ(proof.verdict(), PathVerdict::Meets);
  EXPECT_NEAR(proof.free_until(), std::asin(0.5), 1e-6) << "separation is as precise as a root";
  EXPECT_NEAR(proof.first()->end, std::asin(0.5), 1e-8);
}

TEST(PathProof, TakesTheJointsThatAreNotOnThePathAtRestAndLetsMimicsFollow) {
  Robot robot = robot_of(3, {limited(joint(JointType::Prismatic, 0, 1, {}, kAlongX), 0, 5),
                             mimicking(joint(JointType::Prismatic, 0, 2, {3, 0, 0}, kAlongX), 0, -1, 0)});
  const std::vector<PathBody> bodies{path_body("a", 1, meshes::box({0, 0, 0}, {1, 1, 1})),
                                     path_body("b", 2, meshes::box({0, 0, 0}, {1, 1, 1}))};
  const BodyPair pair{0, 1};
  const auto end_of = [&](const JointPath& path) {
    return prove_paths(robot, std::span(&path, 1), bodies, std::span(&pair, 1)).front().pairs.front().end;
  };
  EXPECT_NEAR(end_of(JointPath(robot, {.joints = {"joint0"}, .positions = {{0}, {5}}})), 1. / 5, 1e-9);
  const JointPath both(robot, {.joints = {"joint0", "joint1"}, .positions = {{0, 0}, {5, 0}}});
  EXPECT_NEAR(end_of(both), 2. / 5, 1e-9) << "a joint that the path names does not follow";
  robot.joints[0].lower = 2, robot.joints[0].upper = 4, robot.joints[1].mimic.reset();
  const JointPath rest(robot, {.joints = {"joint1"}, .positions = {{4}, {0}}});
  EXPECT_NEAR(end_of(rest), 3. / 4, 1e-9) << "joint0 rests at 3: they touch where b is at 4, or 1";
}

TEST(PathProof, LeavesOpenWhatIsNotKnown) {
  const Slide slide;
  std::vector<PathBody> bodies = slide.bodies;
  bodies[1].unread = "its geometry of type plane is not read";
  const BodyPair pair{0, 1};
  const JointPath path = slide.path({}, {{1}, {2}});
  const PathProof unread = prove_paths(slide.robot, std::span(&path, 1), bodies, std::span(&pair, 1)).front();
  EXPECT_EQ(unread.verdict(), PathVerdict::Open);
  EXPECT_EQ(unread.first()->why, "its geometry of type plane is not read");
  EXPECT_EQ(unread.free_until(), 0);
  Robot forest = robot_of(3, slide.robot.joints);
  bodies = {slide.bodies[1], path_body("c", 2, meshes::box({0, 0, 0}, {1, 1, 1}))};
  const PathProof apart = prove_paths(forest, std::span(&path, 1), bodies, std::span(&pair, 1)).front();
  EXPECT_EQ(apart.verdict(), PathVerdict::Open);
  EXPECT_EQ(apart.first()->why, "no joints connect them");
}

TEST(PathProof, BoundsTheDistanceOverTime) {
  const Slide slide;
  const JointPath path = slide.path({}, {{2}, {0.01}, {2}});
  const BodyPair pair{0, 1};
  const PathProof proof =
      prove_paths(slide.robot, std::span(&path, 1), slide.bodies, std::span(&pair, 1), {.distances = true}).front();
  ASSERT_EQ(proof.verdict(), PathVerdict::Free);
  double end = 0;
  for (const DistanceBound& part : proof.curve) {
    EXPECT_EQ(part.begin, end);
    end = part.end;
    for (const double t : {0.0, 0.3, 1.0}) {
      const double distance =
          path.reach(0, std::lerp(part.begin, part.end, t), std::lerp(part.begin, part.end, t)).middle;
      EXPECT_LE(part.distance, distance);
      EXPECT_GE(part.distance, 0.6 * distance - 1e-12);
    }
  }
  EXPECT_EQ(end, 2);
}

class RandomPaths {
 public:
  double within(double lower, double upper) { return std::uniform_real_distribution(lower, upper)(random_); }

  /// Some joints, some with velocities and accelerations.
  PathRows rows(const Robot& robot, std::size_t count, bool has_velocities, bool has_accelerations) {
    PathRows rows;
    for (const Joint& joint : robot.joints) rows.joints.push_back(joint.name);
    double time = 0;
    for (std::size_t row = 0; row < count; ++row) {
      rows.times.push_back(time += within(0.1, 1));
      std::vector<double> positions, velocities, accelerations;
      for (const Joint& joint : robot.joints) {
        positions.push_back(within(joint.lower, joint.upper));
        velocities.push_back(within(-1, 1)), accelerations.push_back(within(-3, 3));
      }
      rows.positions.push_back(positions);
      if (has_velocities) rows.velocities.push_back(velocities);
      if (has_accelerations) rows.accelerations.push_back(accelerations);
    }
    return rows;
  }

 private:
  std::mt19937 random_{test_seed()};
};

TEST(JointPath, EnclosesAllPositionsBetweenTwoPlaces) {
  RandomPaths random;
  const Robot robot = robot_of(2, {limited(joint(JointType::Revolute, 0, 1, {}, kAlongX), -2, 2)});
  double tightest = 0;
  for (int round = 0; round < 300; ++round) {
    const JointPath path(robot, random.rows(robot, 5, round % 3 > 0, round % 3 > 1));
    double begin = random.within(0, 4), end = random.within(0, 4);
    if (end < begin) std::swap(begin, end);
    if (std::floor(begin) != std::floor(end)) begin = std::floor(begin), end = std::ceil(end);
    const JointReach reach = path.reach(0, begin, end);
    EXPECT_EQ(reach.middle, path.positions_at(middle_place(begin, end))[0]);
    const JointRange all = path.ranges()[0];
    double farthest = 0;
    for (int i = 0; i <= 200; ++i) {
      const double position = path.positions_at(std::lerp(begin, end, i / 200.))[0];
      farthest = std::max(farthest, std::abs(position - reach.middle));
      ASSERT_LE(std::abs(position - reach.middle), reach.half) << "round " << round;
      ASSERT_TRUE(all.lower <= position && position <= all.upper);
    }
    if (begin < end) tightest = std::max(tightest, farthest / reach.half);
  }
  EXPECT_GT(tightest, 0.99);
}

// Hermite's conditions: positions, velocities and accelerations of the rows.
TEST(JointPath, KeepsWhatTheRowsSay) {
  RandomPaths random;
  const Robot robot = robot_of(2, {limited(joint(JointType::Revolute, 0, 1, {}, kAlongX), -2, 2)});
  const PathRows rows = random.rows(robot, 2, true, true);
  const double h = rows.times[1] - rows.times[0], e = 1e-4;
  for (const bool has_accelerations : {true, false}) {
    PathRows used = rows;
    if (!has_accelerations) used.accelerations.clear();
    const JointPath path(robot, used);
    for (const std::size_t row : {std::size_t{0}, std::size_t{1}}) {
      const double side = row == 0 ? 1 : -1;
      const auto at = [&](double steps) { return path.positions_at(static_cast<double>(row) + side * steps * e)[0]; };
      EXPECT_EQ(at(0), rows.positions[row][0]);
      EXPECT_NEAR(side * (-3 * at(0) + 4 * at(1) - at(2)) / (2 * e * h), rows.velocities[row][0], 1e-4);
      if (!has_accelerations) continue;
      EXPECT_NEAR((2 * at(0) - 5 * at(1) + 4 * at(2) - at(3)) / (e * e * h * h), rows.accelerations[row][0], 1e-2);
    }
  }
}

std::vector<PathBody> bodies_of(const Arm& arm) {
  std::vector<PathBody> bodies;
  for (std::size_t i = 0; i < arm.links.size(); ++i)
    bodies.push_back(path_body(arm.robot.links[i].name, i, arm.links[i]));
  return bodies;
}

TEST(PathProof, IsContradictedByNoSample) {
  const Arm arm;
  std::vector<PathBody> bodies = bodies_of(arm);
  bodies.push_back(path_body("post", {}, meshes::box({0.25, -0.05, 0}, {0.35, 0.05, 0.6})));
  std::vector<BodyPair> pairs = pairs_on_path(arm.robot, bodies);
  EXPECT_EQ(pairs.size(), 21U + 8U);
  RandomPaths random;
  std::vector<JointPath> paths;
  for (int i = 0; i < 12; ++i) paths.emplace_back(arm.robot, random.rows(arm.robot, 3, i % 3 > 0, i % 3 > 1));
  const double gap = 0.005;
  const PathProofOptions options{.gap = gap, .cells = 3000, .distances = true};
  const std::vector<PathProof> proofs = prove_paths(arm.robot, paths, bodies, pairs, options);
  std::size_t free = 0, meet = 0, open = 0;
  for (std::size_t p = 0; p < paths.size(); ++p) {
    for (const PathPairProof& pair : proofs[p].pairs) {
      const CollisionIndex& a = bodies[pair.a].shape->parts[0];
      const CollisionIndex& b = bodies[pair.b].shape->parts[0];
      const auto poses_at = [&](const std::vector<double>& positions) {
        const std::vector<Pose> poses = link_poses(arm.robot, positions);
        return PosePair{poses[*bodies[pair.a].link], bodies[pair.b].link ? poses[*bodies[pair.b].link] : Pose{}};
      };
      for (int i = 0; i < 40 && pair.begin > 0; ++i) {
        const double place = random.within(0, pair.begin);
        const PosePair at = poses_at(paths[p].positions_at(place));
        const double distance = separation(a, at.a, b, at.b).upper;
        ASSERT_GT(distance, gap) << "path " << p << ", " << bodies[pair.a].name << " and " << bodies[pair.b].name;
        for (const DistanceBound& bound : pair.bounds)
          if (bound.begin <= place && place <= bound.end) {
            ASSERT_GE(distance, bound.distance);
          }
      }
      free += pair.verdict == PathVerdict::Free, open += pair.verdict == PathVerdict::Open;
      if (pair.verdict != PathVerdict::Meets) continue;
      ++meet;
      const PosePair at = poses_at(pair.positions);
      EXPECT_LE(separation(a, at.a, b, at.b).lower, gap + 1e-9);
      EXPECT_LE(pair.end - pair.begin, 1e-6);
    }
  }
  EXPECT_GT(free, 100U);
  EXPECT_GT(meet, 10U);
  EXPECT_LE(open, 2U);
}

TEST(PathProof, HasWitnessesThatMeet) {
  const Arm arm;
  const std::vector<PathBody> bodies = bodies_of(arm);
  RandomPaths random;
  const JointPath path(arm.robot, random.rows(arm.robot, 30, true, false));
  const std::vector<BodyPair> pairs = pairs_on_path(arm.robot, bodies);
  const std::vector<PathProof> proofs = prove_paths(arm.robot, std::span(&path, 1), bodies, pairs);
  std::size_t meet = 0;
  for (const PathPairProof& pair : proofs.front().pairs) {
    if (pair.verdict != PathVerdict::Meets) continue;
    ++meet;
    const std::vector<Pose> poses = link_poses(arm.robot, pair.positions);
    const std::vector<FacePair> faces =
        intersecting_faces(bodies[pair.a].shape->parts[0], {}, bodies[pair.b].shape->parts[0],
                           composed(inverse(poses[pair.a]), poses[pair.b]));
    EXPECT_NE(std::ranges::find(faces, pair.faces), faces.end());
  }
  EXPECT_GT(meet, 2U);
}

TEST(PathProof, IsTheSameWithAnyNumberOfThreads) {
  const Arm arm;
  const std::vector<PathBody> bodies = bodies_of(arm);
  const std::vector<BodyPair> pairs = pairs_on_path(arm.robot, bodies);
  RandomPaths random;
  const JointPath path(arm.robot, random.rows(arm.robot, 6, false, false));
  const auto prove = [&](unsigned threads) {
    return prove_paths(arm.robot, std::span(&path, 1), bodies, pairs, {.distances = true, .threads = threads}).front();
  };
  const PathProof one = prove(1), four = prove(4);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(one.pairs[i].verdict, four.pairs[i].verdict);
    EXPECT_EQ(one.pairs[i].begin, four.pairs[i].begin);
    EXPECT_EQ(one.pairs[i].end, four.pairs[i].end);
    EXPECT_EQ(one.pairs[i].cells, four.pairs[i].cells);
  }
  ASSERT_EQ(one.curve.size(), four.curve.size());
  for (std::size_t i = 0; i < one.curve.size(); ++i) EXPECT_EQ(one.curve[i].distance, four.curve[i].distance);
}

TEST(PathBodies, HaveClosedAndOpenParts) {
  Robot robot =
      robot_of(3, {joint(JointType::Revolute, 0, 1, {}, kAlongX), joint(JointType::Revolute, 1, 2, {}, kAlongX)});
  robot.links[0].collision = {{BoxForm{{1, 1, 1}}}, {SphereForm{1}}};
  robot.links[1].collision = {{OtherForm{"plane"}}};
  const WorldMesh sheet{"sheet", meshes::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})};
  const PathBodies made = path_bodies(robot, Geometry::Collision, std::span(&sheet, 1));
  ASSERT_EQ(made.bodies.size(), 4U);
  EXPECT_EQ(made.bodies[0].shape->parts.size(), 1U);
  EXPECT_TRUE(made.bodies[0].shape->parts[0].is_solid());
  EXPECT_FALSE(made.bodies[3].shape->parts[0].is_solid());
  EXPECT_EQ(made.notes,
            (std::vector<std::string>{"links without collision geometry, so that their visual geometry counts: link2",
                                      "link1: its geometry of type plane is not read",
                                      "sheet: not closed: only its faces count, not what lies inside"}));
  EXPECT_EQ(pairs_on_path(robot, made.bodies), (std::vector<BodyPair>{{0, 2}, {0, 3}, {1, 3}, {2, 3}}));
  const std::pair<std::string, std::string> names{"sheet", "link1"};
  const LinkPair links{0, 2};
  EXPECT_EQ(pairs_on_path(robot, made.bodies, std::span(&links, 1), std::span(&names, 1)),
            (std::vector<BodyPair>{{0, 3}, {2, 3}}));
  const std::pair<std::string, std::string> wrong{"table", "link1"};
  EXPECT_EQ(refusal_of([&] { pairs_on_path(robot, made.bodies, {}, std::span(&wrong, 1)); }, Defect::InvalidOption),
            "no link with geometry and no mesh of the world is called 'table'; there are link0, link1, link2, sheet");
  const WorldMesh twin{"link2", sheet.mesh};
  EXPECT_TRUE(
      has(refusal_of([&] { path_bodies(robot, Geometry::Collision, std::span(&twin, 1)); }, Defect::InvalidOption),
          "two bodies are called 'link2'"));
}

/// Two spheres of radius 1, or one and a box, that come up to `apart`.
TEST(PathBodies, MeetWhereCurvedShapesDo) {
  Robot robot = robot_of(2, {joint(JointType::Prismatic, 0, 1, {3, 0, 0}, kAlongX)});
  robot.links[1].visual = {{SphereForm{1}}};
  for (const bool is_box : {false, true}) {
    if (!is_box) robot.links[0].visual = {{SphereForm{1}}};
    if (is_box) robot.links[0].visual = {{BoxForm{{2, 2, 2}}}};
    const PathBodies made = path_bodies(robot, Geometry::Visual);
    const std::vector<BodyPair> pairs{{0, 1}};
    for (const auto& [apart, verdict] : {std::pair(0.01, PathVerdict::Free), std::pair(1e-5, PathVerdict::Open),
                                         std::pair(-0.01, PathVerdict::Meets)}) {
      const JointPath path(robot, {.joints = {"joint0"}, .positions = {{0}, {-1 + apart}}});
      const PathPairProof found = prove_paths(robot, std::span(&path, 1), made.bodies, pairs)[0].pairs[0];
      EXPECT_EQ(found.verdict, verdict) << apart << found.why;
      if (verdict == PathVerdict::Open) {
        EXPECT_EQ(found.why, "one touches the mesh around a curved shape");
      }
      if (verdict == PathVerdict::Meets) {
        EXPECT_LE(3 + found.positions[0], 2);
      }
      EXPECT_GT(found.begin, 0.98);
      EXPECT_LT(found.cells, 1000U);
      robot.joints[0].lower = -1 + apart, robot.joints[0].upper = 1;
      const std::vector<std::optional<ProofBody>> links{made.bodies[0].shape, made.bodies[1].shape};
      const PairProof pair = prove_pairs(robot, links, pairs)[0];
      EXPECT_EQ(name_of(pair.verdict), verdict == PathVerdict::Free ? "never" : name_of(verdict)) << apart << pair.why;
      if (!pair.positions.empty()) {
        EXPECT_LE(3 + pair.positions[0], 2);
      }
    }
  }
}

TEST(PathBodies, AreComparedAcrossSeveralJointsThatMove) {
  Robot robot =
      robot_of(4, {joint(JointType::Prismatic, 0, 1, {}, kAlongX), joint(JointType::Prismatic, 1, 2, {}, kAlongZ),
                   joint(JointType::Revolute, 2, 3, {}, kAlongZ)});
  robot.links[1].visual.clear();
  const auto pairs = [&] { return pairs_on_path(robot, path_bodies(robot, Geometry::Visual).bodies); };
  EXPECT_EQ(pairs(), (std::vector<BodyPair>{{0, 1}, {0, 2}})) << "link2 moves in two ways against link0";
  robot.joints[0].type = JointType::Fixed;
  EXPECT_EQ(pairs(), (std::vector<BodyPair>{{0, 2}}));
}

TEST(PathBodies, AreNotFreeWithCornersThatAreNotFinite) {
  Robot robot =
      robot_of(3, {joint(JointType::Revolute, 0, 1, {}, kAlongX), joint(JointType::Revolute, 1, 2, {}, kAlongX)});
  const TemporaryFolder folder;
  write_bytes(folder / "nan.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\n");
  write_bytes(folder / "empty.obj", "v 0 0 0\n");
  robot.links[0].visual = {{MeshFile{"nan.obj", folder / "nan.obj"}}};
  robot.links[1].visual = {{MeshFile{"empty.obj", folder / "empty.obj"}}};
  const PathBodies made = path_bodies(robot, Geometry::Visual);
  ASSERT_EQ(made.bodies.size(), 3U);
  EXPECT_EQ(made.bodies[0].unread, "a mesh of it has corners that are not finite");
  EXPECT_EQ(made.bodies[1].unread, "a mesh of it has no triangles");
  WorldMesh world{"world", meshes::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})};
  world.mesh.positions[VertexId{1}].x = std::nan("");
  EXPECT_TRUE(
      has(refusal_of([&] { path_bodies(robot, Geometry::Visual, std::span(&world, 1)); }, Defect::NonFiniteCoordinate),
          "world: corners of triangles are not finite"));
}

std::string refusal(const Robot& robot, const std::string& text) {
  return refusal_of([&] { JointPath(robot, read_path_rows(text, "p")); });
}

TEST(PathFile, ReadsCsv) {
  const PathRows rows =
      read_path_rows("\xef\xbb\xbftime; a ;b;a.velocity;b.velocity\r\n\n0;1;2;3;4\r\n1.5;+5;-6e0;7;8\n", "p");
  EXPECT_EQ(rows.joints, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(rows.times, (std::vector<double>{0, 1.5}));
  EXPECT_EQ(rows.positions, (std::vector<std::vector<double>>{{1, 2}, {5, -6}}));
  EXPECT_EQ(rows.velocities, (std::vector<std::vector<double>>{{3, 4}, {7, 8}}));
  EXPECT_EQ(rows.numbers, (std::vector<std::size_t>{3, 4}));
  EXPECT_TRUE(rows.accelerations.empty());
  EXPECT_EQ(read_path_rows("a\n1", "p").positions, (std::vector<std::vector<double>>{{1}}));
  EXPECT_EQ(read_path_rows("a.velocity,\"a\"\n1,2", "p").positions, (std::vector<std::vector<double>>{{2}}));
}

TEST(PathFile, ReadsJson) {
  for (const char* const text :
       {R"({"joint_names": ["a"], "points": [{"positions": [1], "velocities": [2], "time_from_start": 1},
            {"positions": [3], "velocities": [], "time_from_start": {"sec": 2, "nanosec": 500000000}}]})",
        R"({"joint_trajectory": {"joint_names": ["a"], "points": [{"positions": [1], "velocities": [2],
            "time_from_start": {"secs": 1, "nsecs": 0}}, {"positions": [3], "time_from_start": 2.5}]}})",
        R"( {"joints": ["a"], "times": [1, 2.5], "positions": [[1], [3]], "velocities": [[2], []]})"}) {
    const PathRows rows = read_path_rows(text, "p");
    EXPECT_EQ(rows.joints, std::vector<std::string>{"a"});
    EXPECT_EQ(rows.times, (std::vector<double>{1, 2.5}));
    EXPECT_EQ(rows.positions, (std::vector<std::vector<double>>{{1}, {3}}));
    EXPECT_EQ(rows.velocities, (std::vector<std::vector<double>>{{2}, {}}));
  }
}

TEST(PathFile, RefusesWhatIsNoPathInOneLine) {
  const Robot robot =
      robot_of(4, {joint(JointType::Revolute, 0, 1, {}, kAlongX), joint(JointType::Prismatic, 1, 2, {}, kAlongX),
                   joint(JointType::Fixed, 2, 3, {}, kAlongX)});
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "p: expected a line with the names of joints, and rows of positions"},
      {"joint0\n", "p: there are no rows of positions"},
      {"time\n1\n", "p: expected a line with the names of joints, and rows of positions"},
      {"1,2\n3,4\n", "p: line 1: the number '1' where the name of a joint is expected"},
      {"joint0,jiont1\n1,2", "p: the robot has no joint 'jiont1'; it has joint0, joint1"},
      {"joint0,joint0\n1,2", "p: joint 'joint0' occurs twice"},
      {"joint2\n1", "p: joint 'joint2' is neither one that turns nor one that slides"},
      {"joint0,joint1\n1,2\n1\n", "p: line 3: 1 columns, expected 2 as in the line of names"},
      {"joint0\nnan\n", "p: line 2: 'nan' is no finite number"},
      {"joint0\n1e999\n", "p: line 2: '1e999' is no finite number"},
      {"joint0\n1e308\n", "p: line 2: positions of joint 'joint0': 1e+308 is no number from -1e6 to 1e6"},
      {"joint0\n\n1 2\n", "p: line 3: '1 2' is no finite number"},
      {"joint0,joint0.velocity,joint1\n1,2,3", "p: line 1: 0 columns 'joint1.velocity', expected one"},
      {"joint0,joint0.velocity\n1,1e6\n1,1e6\n", ""},
      {"time,joint0,joint0.velocity\n0,1,1e6\n10,1,1e6\n",
       "p: line 2: with its velocity, joint 'joint0' goes beyond 1e6 on the way to the next"},
      {"joint0,joint0.acceleration\n1,2\n", "p: line 2: there are accelerations, but no velocities"},
      {"time,joint0\n1,1\n1,2\n", "p: line 3: time 1 does not come after 1"},
      {"time,time,joint0\n1,1,1\n", "p: line 1: two columns 'time'"},
      {"{", "p: no JSON: "},
      {"[1]", "p: expected an object"},
      {"{}", "p: there is no \"joints\""},
      {R"({"joints": 3})", "p: joints: expected a list"},
      {R"({"joints": [3]})", "p: joints: expected names of joints"},
      {R"({"joints": [], "positions": []})", "p: there are no joints"},
      {R"({"joints": ["joint0"], "positions": []})", "p: there are no rows of positions"},
      {R"({"joints": ["joint0"], "positions": [[1], [1, 2]]})", "p: row 1: positions: 2 for 1 joint"},
      {R"({"joints": ["joint0"], "positions": [["x"]]})", "p: positions[0]: expected a finite number"},
      {R"({"joints": ["joint0"], "positions": [[1]], "times": [1, 2]})",
       "p: row 1: times are not of as many rows as positions"},
      {R"({"joints": ["joint0"], "positions": [[1]], "velocities": [[1], [2]]})",
       "p: row 1: velocities are not of as many rows as positions"},
      {"\xef\xbb\xbf{", "p: no JSON: "},
      {R"({"joint_trajectory": {"joint_names": ["joint0"], "points": [{"positions": [1]}]},
           "multi_dof_joint_trajectory": {"points": []}})",
       ""},
      {R"({"joint_trajectory": {"joint_names": ["joint0"], "points": [{"positions": [1]}]},
           "multi_dof_joint_trajectory": {"joint_names": ["base"], "points": [{"transforms": []}]}})",
       "p: multi_dof_joint_trajectory: planar and floating joints stay at rest here, and it moves them"},
      {"{\"trajectory\": {\"joints\": " + std::string(300'000, '[') + std::string(300'000, ']') + "}}",
       "p: joints: expected names of joints"},
      {R"({"joint_names": ["joint0"], "points": [{}]})", "p: point 0: there are no \"positions\""},
      {R"({"joint_names": ["joint0"], "points": [3]})", "p: point 0: there are no \"positions\""},
      {R"({"joint_names": ["joint0"], "points": [{"positions": [1]}, {"positions": [1], "time_from_start": 1}]})",
       "p: point 1: time_from_start is not in all points"},
      {R"({"joint_names": ["joint0"], "points": [{"positions": [1], "time_from_start": 1}, {"positions": [1]}]})",
       "p: time_from_start is not in all points"},
      {R"({"joint_names": ["joint0"], "points": [{"positions": [1], "time_from_start": {}}]})",
       "p: point 0: time_from_start: expected a number, or {\"sec\": ..., \"nanosec\": ...}"},
  };
  for (const auto& [text, message] : cases) {
    const std::string found = refusal(robot, text);
    EXPECT_TRUE(message.empty() ? found.empty() : found.starts_with(message)) << text << "\n" << found;
    EXPECT_EQ(found.find('\n'), found.npos) << text;
  }
}

TEST(PathFile, ReadsOrRefusesAnyMutant) {
  const Robot robot = robot_of(2, {joint(JointType::Revolute, 0, 1, {}, kAlongX)});
  std::mt19937 random(test_seed());
  const std::vector<std::string> texts{
      "time,joint0,joint0.velocity\n0,1,2\n1,2,3\n",
      R"({"joint_names": ["joint0"], "points": [{"positions": [1], "velocities": [2], "time_from_start": {"sec": 1}}]})"};
  std::size_t taken = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string text = texts[static_cast<std::size_t>(round) % 2];
    for (int change = 0; change < 2; ++change)
      text[random() % text.size()] = "\0{}[]\",:\n0123456789eE+-.xjN\xff"[random() % 30];
    try {
      JointPath(robot, read_path_rows(text, "p"));
      ++taken;
    } catch (const InputError&) {
    }
  }
  EXPECT_GT(taken, 40U);
  EXPECT_LT(taken, 3000U);
}

// Between seconds since 1970, doubles are 2.4e-7 apart.
TEST(JointPath, ReachesWhatRoundedTimesEnclose) {
  const Robot robot = robot_of(2, {joint(JointType::Prismatic, 0, 1, {}, kAlongX)});
  const JointPath path(robot, {.joints = {"joint0"}, .times = {1700000000.1, 1700000000.4}, .positions = {{0}, {-1}}});
  for (double begin = 0.125; begin < 0.9; begin += 0.0625) {
    const double end = begin + 0x1p-10;
    const JointReach reach = path.reach(0, begin, end);
    for (const double place : {begin, end}) {
      const double position = -(path.time_at(place) - 1700000000.1) / (1700000000.4 - 1700000000.1);
      EXPECT_LE(std::abs(position - reach.middle), reach.half) << place;
    }
  }
}

TEST(PathProof, TakesPositionsUpToTheLargest) {
  const Robot robot = robot_of(
      3, {joint(JointType::Prismatic, 0, 1, {}, kAlongX), joint(JointType::Prismatic, 1, 2, {1, 0, 0}, kAlongX)});
  const std::vector<BodyPair> pairs{{0, 2}};
  const JointPath path(robot, {.joints = {"joint1"}, .positions = {{5}, {1e6}}});
  const PathBodies made = path_bodies(robot, Geometry::Visual);
  EXPECT_EQ(prove_paths(robot, std::span(&path, 1), made.bodies, pairs)[0].pairs[0].why, "");
}

TEST(PathProof, TellsWhyAnEarlierContactIsUndecided) {
  const Robot robot = robot_of(2, {joint(JointType::Prismatic, 0, 1, {3, 0, 0}, kAlongX)});
  const JointPath path(robot, {.joints = {"joint0"}, .positions = {{0}, {-3}, {-1.9}, {0}}});
  const PathBodies made = path_bodies(robot, Geometry::Visual);
  const std::vector<BodyPair> pairs{{0, 1}};
  const auto found = [&](std::size_t cells) {
    return prove_paths(robot, std::span(&path, 1), made.bodies, pairs, {.cells = cells})[0].pairs[0];
  };
  EXPECT_EQ(found(3).verdict, PathVerdict::Meets);
  EXPECT_EQ(found(3).why, kCellsUsedUp);
  EXPECT_EQ(found(1000).verdict, PathVerdict::Meets);
  EXPECT_EQ(found(1000).why, "");
}

TEST(PathFile, ReadsQuotedNamesAndComments) {
  const PathRows rows = read_path_rows("# of a planner\n\"j,0\",time\n1,0\n\"2\",1\n", "a.csv");
  EXPECT_EQ(rows.joints, std::vector<std::string>{"j,0"});
  EXPECT_EQ(rows.positions, (std::vector<std::vector<double>>{{1}, {2}}));
  EXPECT_EQ(read_path_rows("\"a,b\";c\n1;2\n", "a.csv").joints, (std::vector<std::string>{"a,b", "c"}));
}

TEST(JointPath, TellsTheFirstPositionBeyondLimits) {
  const Robot robot = robot_of(3, {limited(joint(JointType::Revolute, 0, 1, {}, kAlongX), -1, 1),
                                   joint(JointType::Continuous, 1, 2, {}, kAlongX)});
  const JointPath inside(robot, {.joints = {"joint1", "joint0"}, .positions = {{50, 1}, {-50, -1}}});
  EXPECT_FALSE(first_beyond_limits(robot, inside));
  const JointPath outside(robot, {.joints = {"joint1", "joint0"}, .positions = {{50, 1}, {-50, -1.25}, {0, 2}}});
  const auto beyond = first_beyond_limits(robot, outside);
  ASSERT_TRUE(beyond);
  EXPECT_EQ(beyond->place, 1);
  EXPECT_EQ(beyond->joint, 0U);
  EXPECT_EQ(beyond->position, -1.25);
}

TEST(JointPath, TellsPositionsBeyondLimitsOfJointsThatFollow) {
  const Robot robot =
      robot_of(3, {limited(joint(JointType::Prismatic, 0, 1, {}, kAlongX), -1, 1),
                   mimicking(limited(joint(JointType::Prismatic, 1, 2, {}, kAlongX), -5, 0.5), 0, 10, 0)});
  const auto beyond = [&](std::vector<std::string> joints, std::vector<std::vector<double>> positions) {
    return first_beyond_limits(robot, JointPath(robot, {.joints = joints, .positions = positions}));
  };
  EXPECT_FALSE(beyond({"joint0"}, {{-0.5}, {0.05}}));
  EXPECT_FALSE(beyond({"joint0", "joint1"}, {{0.9, 0}, {-0.9, 0.5}})) << "it does not follow";
  const auto found = beyond({"joint0"}, {{0}, {0.9}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->place, 1);
  EXPECT_EQ(found->joint, 1U);
  EXPECT_EQ(found->position, 9);
}

TEST(JointPath, TellsPositionsBeyondLimitsBetweenRows) {
  const Robot robot = robot_of(2, {limited(joint(JointType::Revolute, 0, 1, {}, kAlongX), -1, 1)});
  const auto beyond = [&](std::vector<std::vector<double>> velocities) {
    const JointPath path(robot, {.joints = {"joint0"}, .positions = {{0}, {0.5}, {0.5}}, .velocities = velocities});
    return first_beyond_limits(robot, path);
  };
  EXPECT_FALSE(beyond({{0}, {2}, {-2}})) << "0.5 + 2 t - 2 t^2 touches 1";
  const auto found = beyond({{0}, {2.001}, {-2.001}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->row(), 1U);
  EXPECT_FALSE(found->is_in_row());
  EXPECT_GT(found->position, 1);
  EXPECT_LT(found->position, 1.001);
}

// Beside a limit of 1 rounding hides 1.1e-13. A search that halves whatever it cannot decide has parts without number
// where the curve is outside by about that.
TEST(JointPath, DecidesAboutCurvesThatAreOutsideOfLimitsByRoundingAlone) {
  const Robot robot = robot_of(2, {limited(joint(JointType::Revolute, 0, 1, {}, kAlongX), -1, 1)});
  for (double bump = 0x1p-50; bump < 1e-10; bump *= 1.25) {  // halfway between the rows
    const JointPath path(robot,
                         {.joints = {"joint0"}, .positions = {{1}, {1}}, .velocities = {{4 * bump}, {-4 * bump}}});
    const bool is_beyond = first_beyond_limits(robot, path).has_value();
    EXPECT_FALSE(is_beyond && bump < 1e-13) << bump;
    EXPECT_TRUE(is_beyond || bump < 3e-13) << bump;
  }
}

// u + (u - 1/2)^3 is S-shaped about 1/2: off the line over a piece of the length s by up to s^3 / (12 sqrt(3)). Behind
// so many rows places are 2^-35 apart, and a piece of that many of them has no place at a third of it.
TEST(JointPath, StraysNoFartherThanItSaysBehindManyRows) {
  constexpr std::size_t kRows = 1 << 17;
  constexpr double kApart = 0x1p-35, kLength = 13331732 * kApart, kBegin = kRows + 0.5 - kLength / 2;
  const Robot robot = robot_of(2, {joint(JointType::Continuous, 0, 1, {}, kAlongX)});
  PathRows rows{.joints = {"joint0"}};
  rows.positions.assign(kRows + 2, {-0.125}), rows.velocities.assign(kRows + 2, {});
  rows.positions.back() = {1.125}, rows.velocities[kRows] = rows.velocities[kRows + 1] = {1.75};
  const double most = std::pow(kLength, 3) / (12 * std::numbers::sqrt3);
  const double stray = JointPath(robot, rows).stray(0, kBegin, kBegin + kLength);
  EXPECT_GE(stray, most);
  EXPECT_LE(stray, 4 * most);
}

}  // namespace
}  // namespace prohull::robot::of_path_proof
