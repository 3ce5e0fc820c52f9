#include "robot/motion/pair_proof.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "meshes.h"
#include "prohull/convex_hull.h"
#include "prohull/error.h"
#include "random.h"
#include "robot/files/robot_file.h"
#include "robot/hulls/link_hulls.h"
#include "robot/motion/bodies.h"
#include "robot/motion/joint_chain.h"
#include "robot/motion/kinematics.h"
#include "robot/motion/motion.h"
#include "robot/motion/sampling.h"
#include "robot_of_joints.h"
#include "robot_testing.h"
#include "sample_arm.h"

namespace prohull::robot::of_pair_proof {
namespace {

constexpr double kEver = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;
constexpr Vec3 kAlongX{1, 0, 0}, kAlongY{0, 1, 0}, kAlongZ{0, 0, 1};

PairProof proof_of(const Robot& robot, const std::vector<TriangleMesh>& links, std::size_t a, std::size_t b,
                   std::size_t cells = 10'000) {
  const LinkPair pair{a, b};
  return prove_pairs(robot, links, std::span(&pair, 1), {.cells = cells}).front();
}

bool meet_at(const Robot& robot, const std::vector<TriangleMesh>& links, const PairProof& pair,
             const std::vector<double>& positions) {
  const std::vector<Pose> poses = link_poses(robot, positions);
  return collide(CollisionIndex(links[pair.a]), poses[pair.a], CollisionIndex(links[pair.b]), poses[pair.b]);
}

void expect_witness(const Robot& robot, const std::vector<TriangleMesh>& links, const PairProof& proof) {
  ASSERT_EQ(proof.positions.size(), robot.joints.size());
  EXPECT_TRUE(meet_at(robot, links, proof, proof.positions));
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (robot.joints[j].mimic || robot.joints[j].type == JointType::Continuous) continue;
    EXPECT_GE(proof.positions[j], robot.joints[j].lower) << j;
    EXPECT_LE(proof.positions[j], robot.joints[j].upper) << j;
  }
}

/// A lever of length 2.2 that turns about z, 2 away from a wall at x = 0. Its corner touches the wall at `touch()`.
struct Hinge {
  Robot robot = robot_of(2, {joint(JointType::Revolute, 0, 1, {2, 0, 0}, kAlongZ)});
  std::vector<TriangleMesh> links{meshes::box({-2, -5, -1}, {0, 5, 1}), meshes::box({0, -0.1, -1}, {2.2, 0.1, 1})};

  static double touch() {
    const double length = std::hypot(2.2, 0.1);
    return kPi - std::acos(2 / length) - std::atan2(0.1, 2.2);
  }
};

TEST(PairProof, DecidesAHingeOnEitherSideOfItsTouch) {
  Hinge hinge;
  for (const double sign : {1., -1.}) {
    double &lower = hinge.robot.joints[0].lower, &upper = hinge.robot.joints[0].upper;
    lower = -1, upper = 1;
    (sign > 0 ? upper : lower) = sign * (Hinge::touch() - 1e-6);
    const PairProof never = proof_of(hinge.robot, hinge.links, 0, 1);
    EXPECT_EQ(never.verdict, PairVerdict::Never) << never.why;
    EXPECT_EQ(never.proven_free, 1);
    EXPECT_TRUE(never.positions.empty());
    (sign > 0 ? upper : lower) = sign * (Hinge::touch() + 1e-3);
    const PairProof meets = proof_of(hinge.robot, hinge.links, 0, 1);
    EXPECT_EQ(meets.verdict, PairVerdict::Meets) << meets.why;
    expect_witness(hinge.robot, hinge.links, meets);
  }
}

TEST(PairProof, FindsWhereLinksMeetBesideAWallThatIsClose) {
  Robot robot =
      robot_of(3, {joint(JointType::Prismatic, 0, 1, {}, kAlongX), joint(JointType::Prismatic, 1, 2, {}, kAlongZ)});
  robot.joints[0].lower = -10, robot.joints[0].upper = 10;
  robot.joints[1].lower = 0, robot.joints[1].upper = 10;
  TriangleMesh wall_and_ceiling = meshes::box({-12, 0.51, -1}, {-6, 1, 12});
  append(wall_and_ceiling, meshes::box({5, -1, 9.2}, {12, 1, 10}));
  const std::vector<TriangleMesh> links{wall_and_ceiling, {}, meshes::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5})};
  const PairProof meets = proof_of(robot, links, 0, 2, 1000);
  EXPECT_EQ(meets.verdict, PairVerdict::Meets) << meets.why;
  expect_witness(robot, links, meets);
  EXPECT_LE(meets.cells, 1000u);
  robot.joints[1].upper = 8.5;
  const PairProof never = proof_of(robot, links, 0, 2, 1000);
  EXPECT_EQ(never.verdict, PairVerdict::Never) << "the ceiling is out of reach";
  EXPECT_LT(never.cells, 100u) << "no motion goes towards the wall, of which it is 0.01 away";
}

TEST(PairProof, DecidesASlideOnEitherSideOfItsTouch) {
  const std::vector<TriangleMesh> links{meshes::box({0, 0, 0}, {1, 1, 1}), meshes::box({0, 0, 0}, {1, 1, 1})};
  for (const double travel : {0.999999, 1.0001}) {
    const Robot robot = robot_of(2, {limited(joint(JointType::Prismatic, 0, 1, {2, 0, 0}, -kAlongX), -0.5, travel)});
    const PairProof proof = proof_of(robot, links, 0, 1);
    EXPECT_EQ(proof.verdict, travel < 1 ? PairVerdict::Never : PairVerdict::Meets);
    if (travel > 1) expect_witness(robot, links, proof);
  }
}

/// Two jaws on slides; the second follows the first, -2 times as far.
TEST(PairProof, ScalesWhatMimics) {
  const std::vector<TriangleMesh> links{meshes::box({0, 5, 0}, {1, 6, 1}), meshes::box({0, 0, 0}, {1, 1, 1}),
                                        meshes::box({0, 0, 0}, {1, 1, 1})};
  for (const double travel : {0.999999, 1.0001}) {
    const Robot robot = robot_of(3, {limited(joint(JointType::Prismatic, 0, 1, {0, 0, 0}, kAlongX), -0.5, travel),
                                     mimicking(joint(JointType::Prismatic, 0, 2, {4.5, 0, 0}, kAlongX), 0, -2, -0.5)});
    const PairProof proof = proof_of(robot, links, 1, 2);
    EXPECT_EQ(proof.verdict, travel < 1 ? PairVerdict::Never : PairVerdict::Meets);
    EXPECT_LE(proof.cells, 200U) << "one freedom, not two";
    if (travel > 1) expect_witness(robot, links, proof);
  }
}

TEST(PairProof, IsAboutPositionsAtWhichWhatFollowsIsWithinItsLimits) {
  const std::vector<TriangleMesh> links{meshes::box({0, 0, 0}, {1, 1, 1}), meshes::box({0, 0, 0}, {1, 1, 1}), {}};
  for (const double limit : {0.999999, 1.0001}) {
    for (const double multiplier : {10., -10.}) {
      const Joint follower = mimicking(limited(joint(JointType::Prismatic, 0, 2, {}, kAlongX),
                                               multiplier < 0 ? -10 * limit : -3, multiplier < 0 ? 3 : 10 * limit),
                                       0, multiplier, 0);
      const Robot robot =
          robot_of(3, {limited(joint(JointType::Prismatic, 0, 1, {2, 0, 0}, -kAlongX), -1, 9), follower});
      const PairProof proof = proof_of(robot, links, 0, 1);
      EXPECT_EQ(proof.verdict, limit < 1 ? PairVerdict::Never : PairVerdict::Meets) << proof.why;
      if (limit < 1) continue;
      expect_witness(robot, links, proof);
      EXPECT_LE(std::abs(proof.positions[1]), 10 * limit);
    }
  }
}

TEST(PairProof, IsOpenWhereNoPositionIsWithinAllLimits) {
  const std::vector<TriangleMesh> links{meshes::box({0, 0, 0}, {1, 1, 1}), meshes::box({0, 0, 0}, {1, 1, 1}), {}};
  const Robot robot = robot_of(3, {limited(joint(JointType::Prismatic, 0, 1, {2, 0, 0}, -kAlongX), -1, 1),
                                   mimicking(limited(joint(JointType::Prismatic, 0, 2, {}, kAlongX), 3, 4), 0, 2, 0)});
  const PairProof proof = proof_of(robot, links, 0, 1);
  EXPECT_EQ(proof.verdict, PairVerdict::Open);
  EXPECT_EQ(proof.why,
            "there is no position of joint 'joint0' at which the joints that follow it are within their limits");
}

TEST(PairProof, TakesOneTurnOfJointsThatTurnFurther) {
  Hinge hinge;
  for (const JointType type : {JointType::Continuous, JointType::Revolute}) {
    hinge.robot.joints[0].type = type;
    for (const auto& [lower, upper] : std::vector<std::pair<double, double>>{
             {-kEver, kEver}, {-2 * kPi, 2 * kPi}, {-kEver, 100}, {50, kEver}, {-1e300, 1e300}}) {
      hinge.robot.joints[0] = limited(hinge.robot.joints[0], lower, upper);
      hinge.robot.joints[0].origin.translation.x = 2;
      const PairProof meets = proof_of(hinge.robot, hinge.links, 0, 1);
      ASSERT_EQ(meets.verdict, PairVerdict::Meets) << lower << " to " << upper << meets.why;
      expect_witness(hinge.robot, hinge.links, meets);
      hinge.robot.joints[0].origin.translation.x = 2.203;
      const PairProof never = proof_of(hinge.robot, hinge.links, 0, 1);
      EXPECT_EQ(never.verdict, PairVerdict::Never) << lower << " to " << upper << never.why;
    }
  }
}

TEST(PairProof, SaysAlwaysWhereNothingMoves) {
  const Robot robot = robot_of(3, {joint(JointType::Fixed, 0, 1, {0.5, 0, 0}, kAlongX),
                                   limited(joint(JointType::Revolute, 1, 2, {5, 0, 0}, kAlongX), 0.5, 0.5)});
  const std::vector<TriangleMesh> links(3, meshes::box({0, 0, 0}, {1, 1, 1}));
  const PairProof fixed = proof_of(robot, links, 0, 1);
  EXPECT_EQ(fixed.verdict, PairVerdict::Always);
  EXPECT_TRUE(meet_at(robot, links, fixed, fixed.positions));
  EXPECT_EQ(proof_of(robot, links, 0, 2).verdict, PairVerdict::Never);
}

std::string why_open(const Robot& robot, std::size_t a = 0, std::size_t b = 1) {
  const std::vector<TriangleMesh> links(robot.links.size(), meshes::box({0, 0, 0}, {1, 1, 1}));
  const PairProof proof = proof_of(robot, links, a, b);
  EXPECT_EQ(proof.verdict, PairVerdict::Open);
  EXPECT_EQ(proof.proven_free, 0);
  return proof.why;
}

TEST(PairProof, LeavesPairsOpenWhosePositionsAreNotBounded) {
  for (const JointType type : {JointType::Planar, JointType::Floating, JointType::Ball})
    EXPECT_EQ(why_open(robot_of(2, {joint(type, 0, 1, {3, 0, 0}, kAlongX)})),
              "joint 'joint0' is neither one that turns nor one that slides");
  const Joint slide = joint(JointType::Prismatic, 0, 1, {3, 0, 0}, kAlongX);
  for (const auto& [lower, upper] :
       std::vector<std::pair<double, double>>{{-kEver, kEver}, {0, kEver}, {-1e308, 1e308}, {0, 1001}})
    EXPECT_EQ(why_open(robot_of(2, {limited(slide, lower, upper)})), "joint 'joint0' has no limits");
  EXPECT_EQ(why_open(robot_of(2, {})), "no joints connect them");
  const Joint wheel = joint(JointType::Continuous, 0, 1, {3, 0, 0}, kAlongX);
  EXPECT_EQ(
      why_open(robot_of(3, {wheel, mimicking(joint(JointType::Revolute, 0, 2, {6, 0, 0}, kAlongX), 0, 0.5, 0)}), 1, 2),
      "joint 'joint0' has no limits");
  for (const double multiplier : {1e7, -1e308})
    EXPECT_EQ(why_open(robot_of(3, {limited(slide, 0, 1),
                                    mimicking(joint(JointType::Revolute, 0, 2, {6, 0, 0}, kAlongX), 0, multiplier, 0)}),
                       1, 2),
              "joint 'joint1' goes beyond 1e6");
  EXPECT_EQ(why_open(robot_of(3, {mimicking(slide, 1, 1, 0), mimicking(slide, 0, 1, 0)})),
            "joint 'joint1' follows one whose positions are not known");
}

TEST(PairProof, RefusesLimitsThatAreOutOfOrder) {
  const std::vector<TriangleMesh> links(2, meshes::box({0, 0, 0}, {1, 1, 1}));
  for (const auto& [lower, upper] :
       std::vector<std::pair<double, double>>{{1, 0}, {std::nan(""), 1}, {0, std::nan("")}, {kEver, -kEver}}) {
    const Robot robot = robot_of(2, {limited(joint(JointType::Revolute, 0, 1, {3, 0, 0}, kAlongX), lower, upper)});
    EXPECT_EQ(refusal_of([&] { proof_of(robot, links, 0, 1); }, Defect::InvalidOption),
              "joint 'joint0' has a lower limit above its upper one, or one that is no number");
  }
}

TEST(PairProof, StopsAfterItsCells) {
  Hinge hinge;
  hinge.robot.joints[0] = limited(hinge.robot.joints[0], -Hinge::touch() + 1e-9, Hinge::touch() - 1e-9);
  for (const std::size_t cells : {std::size_t{1}, std::size_t{2}, std::size_t{30}}) {
    const PairProof proof = proof_of(hinge.robot, hinge.links, 0, 1, cells);
    EXPECT_EQ(proof.verdict, PairVerdict::Open);
    EXPECT_EQ(proof.why, "the number of cells is used up");
    EXPECT_LE(proof.cells, cells);
    EXPECT_LT(proof.proven_free, 1);
    EXPECT_GT(proof.proven_free, cells == 30 ? 0.4 : -1);
  }
}

TEST(PairProof, StaysOpenWhereOnlyRoundingCouldTell) {
  const std::vector<TriangleMesh> links(2, meshes::box({0, 0, 0}, {1, 1, 1}));
  const Robot robot = robot_of(2, {limited(joint(JointType::Prismatic, 0, 1, {1 + 1e-15, 0, 0}, kAlongX), 0, 1)});
  const PairProof proof = proof_of(robot, links, 0, 1);
  EXPECT_EQ(proof.verdict, PairVerdict::Open);
  EXPECT_EQ(proof.why, "rounding hides whether they touch");
}

TEST(PairProof, IsCancelled) {
  Hinge hinge;
  const LinkPair pair{0, 1};
  EXPECT_THROW(prove_pairs(hinge.robot, hinge.links, std::span(&pair, 1),
                           {.progress = [](std::string_view, double) { return false; }}),
               Cancelled);
}

class Random {
 public:
  double within(double lower, double upper) { return std::uniform_real_distribution(lower, upper)(random_); }
  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  Vec3 vector(double size) { return {within(-size, size), within(-size, size), within(-size, size)}; }
  Pose pose() { return pose_of_rpy(vector(kPi), vector(0.6)); }

  /// A tree of links with all kinds of joints that have bounds; two of them in a row, some that mimic.
  Robot robot(std::size_t links) {
    std::vector<Joint> joints;
    for (std::size_t child = 1; child < links; ++child) {
      static constexpr JointType kTypes[] = {JointType::Revolute, JointType::Revolute, JointType::Continuous,
                                             JointType::Prismatic, JointType::Fixed};
      const std::size_t parent = below(child), row = below(4) == 0 ? 2 : 1;
      for (std::size_t i = 0; i < row; ++i) {
        Joint made = joint(kTypes[below(5)], parent, child, {}, {});
        const Vec3 axis = vector(1);
        if (i == 0) made.origin = pose();
        made.anchor = vector(0.3), made.axis = axis / norm(axis);
        const double start = within(-2, 2);
        made = limited(made, start, start + within(0, made.type == JointType::Prismatic ? 1 : 4));
        if (!joints.empty() && below(4) == 0) made.mimic = Mimic{below(joints.size()), within(-2, 2), within(-1, 1)};
        joints.push_back(made);
      }
    }
    for (Joint& made : joints)  // what is followed has to have bounds
      if (made.mimic && (joints[made.mimic->joint].type == JointType::Fixed ||
                         joints[made.mimic->joint].type == JointType::Continuous))
        made.mimic.reset();
    for (Joint& made : joints)  // and nothing may cut them to none
      if (made.mimic) made.lower = -kEver, made.upper = kEver;
    return robot_of(links, std::move(joints));
  }

  TriangleMesh rod() {
    const Vec3 half{within(0.02, 0.1), within(0.02, 0.1), within(0.1, 0.4)};
    return placed(pose_of_rpy(vector(kPi), vector(0.2)), meshes::box(-half, half));
  }

 private:
  std::mt19937 random_{test_seed()};
};

std::vector<Vec3> corners_of(const TriangleMesh& mesh) { return {mesh.positions.begin(), mesh.positions.end()}; }

/// The bound is about all pairs of points, so it is tried with those that move most: the corners.
TEST(JointChain, BoundsWhatMotionChangesOfDistances) {
  Random random;
  double closest = 0;
  for (int round = 0; round < 200; ++round) {
    const Robot robot = random.robot(5);
    const std::size_t a = random.below(4), b = a + 1 + random.below(4 - a);
    const std::vector<Vec3> of_a = corners_of(random.rod()), of_b = corners_of(random.rod());
    const JointChain chain(robot, a, b, of_a, of_b);
    ASSERT_EQ(chain.obstacle(), "");
    std::vector<JointRange> box;
    const double share = round % 2 == 0 ? 0.05 : 0.6;
    for (const JointRange& range : chain.ranges()) {
      const double lower = random.within(range.lower, range.upper);
      box.push_back({lower, lower + share * (range.upper - lower)});
    }
    const JointChain::Motion motion = chain.motion(box);
    for (int sample = 0; sample < 200; ++sample) {
      std::vector<double> positions(robot.joints.size());
      for (std::size_t f = 0; f < box.size(); ++f)
        positions[chain.freedoms()[f]] = sample % 2 == 0   ? random.within(box[f].lower, box[f].upper)
                                         : random.below(2) ? box[f].lower
                                                           : box[f].upper;
      const std::vector<Pose> poses = link_poses(robot, positions);
      const Pose pose = composed(inverse(poses[a]), poses[b]);
      for (const Vec3& p : of_a)
        for (const Vec3& q : of_b) {
          const double change = std::abs(norm(placed(pose, q) - p) - norm(placed(motion.pose, q) - p));
          ASSERT_LE(change, motion.change) << "round " << round;
          if (motion.change > 1e-6) closest = std::max(closest, change / motion.change);
        }
    }
  }
  EXPECT_GT(closest, 0.9) << "the bound is far from what happens";
}

/// What may come near in a motion is near somewhere, or the bound is worth little; what may not, is nowhere.
TEST(StayApart, HoldsAtAllPositions) {
  Random random;
  int free = 0, near = 0, by_change = 0;
  for (int round = 0; round < 2000; ++round) {
    const Robot robot = random.robot(4);
    const std::size_t a = random.below(3), b = a + 1 + random.below(3 - a);
    const ProofBody of_a(random.rod()), of_b(random.rod());
    const JointChain chain(robot, a, b, of_a.corners, of_b.corners);
    std::vector<JointRange> box;
    for (const JointRange& range : chain.ranges()) {
      const double lower = random.within(range.lower, range.upper);
      box.push_back({lower, lower + 0.2 * (range.upper - lower)});
    }
    const JointChain::Motion motion = chain.motion(box);
    const double gap = round % 2 == 0 ? 0 : 0.05;
    std::optional<NearParts> found;
    std::size_t leaf_pairs = 0;
    const bool is_free = stay_apart(of_a, of_b, motion, gap, found, leaf_pairs);
    by_change += closest_parts(of_a, of_b, motion.pose).separation.lower > motion.change + gap;
    free += is_free, near += !is_free;
    for (int sample = 0; is_free && sample < 50; ++sample) {
      std::vector<double> positions(robot.joints.size());
      for (std::size_t f = 0; f < box.size(); ++f)
        positions[chain.freedoms()[f]] = sample % 2 == 0   ? random.within(box[f].lower, box[f].upper)
                                         : random.below(2) ? box[f].lower
                                                           : box[f].upper;
      follow(robot, positions);
      const std::vector<Pose> poses = link_poses(robot, positions);
      const Pose pose = composed(inverse(poses[a]), poses[b]);
      ASSERT_GT(closest_parts(of_a, of_b, pose).separation.upper, gap) << "round " << round;
    }
  }
  EXPECT_GT(near, 100);
  EXPECT_GT(free, by_change + 20) << "it tells no more than the largest change does";
}

// The first axis goes through the point of b, the second one through that of a: neither moves the distance alone.
TEST(JointChain, BoundsWhatTwoJointsDoTogether) {
  const Robot robot = robot_of(3, {limited(joint(JointType::Revolute, 0, 1, {1, 0, 0}, kAlongZ), -1, 1),
                                   limited(joint(JointType::Revolute, 1, 2, {-1, 0, 0}, kAlongZ), -1, 1)});
  const JointChain chain(robot, 0, 2, {{0, 0, 0}}, {{1, 0, 0}});
  const JointChain::Motion motion = chain.motion(chain.ranges());
  double largest = 0;
  for (const double first : {-1., 1.})
    for (const double second : {-1., 1.})
      largest = std::max(largest, std::abs(norm(placed(link_poses(robot, std::vector{first, second})[2], {1, 0, 0})) -
                                           norm(placed(motion.pose, {1, 0, 0}))));
  EXPECT_GT(largest, 0.5);
  EXPECT_GE(motion.change, largest);
  EXPECT_LE(motion.change, 1 + 1e-9) << "one joint by its arm of one link, the other by one that is 0";
}

/// Random positions, and from some of them a climb towards contact, contradict no proof.
void expect_no_contradiction(const Robot& robot, const std::vector<TriangleMesh>& links, const PairProof& proof,
                             std::size_t poses, std::size_t climbs, Random& random) {
  const CollisionIndex a(links[proof.a]), b(links[proof.b]);
  const JointChain chain(robot, proof.a, proof.b, corners_of(links[proof.a]), corners_of(links[proof.b]));
  const auto distance = [&](const std::vector<double>& positions) {
    const std::vector<Pose> at = link_poses(robot, positions);
    return separation(a, at[proof.a], b, at[proof.b]).upper;
  };
  for (std::size_t k = 0; k < poses; ++k) {
    std::vector<double> best = random_positions(robot, test_seed(), k);
    double least = distance(best);
    for (double step = 0.3; k < climbs && step > 1e-4; step *= 0.8)
      for (std::size_t f = 0; f < chain.freedoms().size(); ++f) {
        const JointRange& range = chain.ranges()[f];
        std::vector<double> next = best;
        double& position = next[chain.freedoms()[f]];
        position = std::clamp(position + random.within(-step, step), range.lower, range.upper);
        follow(robot, next);
        if (const double there = distance(next); there < least) least = there, best = next;
      }
    ASSERT_GT(least, 0) << "pair " << proof.a << ", " << proof.b << ", pose " << k;
  }
}

TEST(PairProof, IsContradictedByNoPose) {
  Random random;
  std::size_t nevers = 0, witnesses = 0, open = 0;
  for (int round = 0; round < 30; ++round) {
    const Robot robot = random.robot(4);
    std::vector<TriangleMesh> links;
    std::vector<LinkPair> pairs;
    for (std::size_t b = 0; b < 4; ++b) {
      links.push_back(random.rod());
      for (std::size_t a = 0; a < b; ++a) pairs.emplace_back(a, b);
    }
    for (const PairProof& proof : prove_pairs(robot, links, pairs, {.cells = 2000})) {
      nevers += proof.verdict == PairVerdict::Never, open += proof.verdict == PairVerdict::Open;
      if (proof.verdict == PairVerdict::Never) expect_no_contradiction(robot, links, proof, 100, 5, random);
      if (proof.positions.empty()) continue;
      ++witnesses;
      EXPECT_TRUE(meet_at(robot, links, proof, proof.positions));
    }
  }
  EXPECT_GT(nevers, 5U);
  EXPECT_GT(witnesses, 5U);
  EXPECT_LT(open, nevers + witnesses);
}

/// link1 and link4 come close in a corner of the ranges. A margin around one of them, and they meet there, but at no
/// random position.
TEST(PairProof, FindsWhatRandomPosesOfTheArmMiss) {
  Arm arm;
  EXPECT_EQ(proof_of(arm.robot, arm.links, 1, 4).verdict, PairVerdict::Never);
  arm.links[1] = padded_convex_hull(arm.links[1], 0.004);
  ASSERT_EQ(arm.robot.links[1].name, "link1");
  const PairProof proof = proof_of(arm.robot, arm.links, 1, 4);
  EXPECT_EQ(proof.verdict, PairVerdict::Meets) << proof.why << proof.proven_free;
  expect_witness(arm.robot, arm.links, proof);
  for (std::size_t k = 0; k < 2000; ++k)
    EXPECT_FALSE(meet_at(arm.robot, arm.links, proof, random_positions(arm.robot, 1, k)));
}

TEST(PairProof, DecidesTheArmAndIsTheSameWithAnyNumberOfThreads) {
  const Arm arm;
  Random random;
  std::vector<LinkPair> pairs;
  for (std::size_t a = 0; a < arm.links.size(); ++a)
    for (std::size_t b = a + 2; b < arm.links.size(); ++b) pairs.emplace_back(a, b);
  const std::vector<PairProof> one = prove_pairs(arm.robot, arm.links, pairs, {.cells = 5000, .threads = 1});
  const std::vector<PairProof> four = prove_pairs(arm.robot, arm.links, pairs, {.cells = 5000, .threads = 4});
  std::size_t nevers = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(one[i].verdict, four[i].verdict);
    EXPECT_EQ(one[i].cells, four[i].cells);
    EXPECT_EQ(one[i].proven_free, four[i].proven_free);
    EXPECT_EQ(one[i].positions, four[i].positions);
    EXPECT_EQ(one[i].faces, four[i].faces);
    if (one[i].verdict == PairVerdict::Never)
      ++nevers, expect_no_contradiction(arm.robot, arm.links, one[i], 200, 5, random);
    else if (!one[i].positions.empty())
      expect_witness(arm.robot, arm.links, one[i]);
  }
  EXPECT_GE(nevers, 8U);
}

/// The number of nodes of the tree that begins there, all freedoms of which are below `freedoms`.
std::size_t tree_size(const CellTree& tree, std::size_t freedoms, std::size_t begin = 0) {
  if (tree.at(begin) == kLeaf) return 1;
  EXPECT_LT(tree[begin], freedoms);
  const std::size_t first = tree_size(tree, freedoms, begin + 1);
  return 1 + first + tree_size(tree, freedoms, begin + 1 + first);
}

TEST(PairProof, KeepsTheTreeOfItsCellsIfAsked) {
  const Arm arm;
  const std::vector<LinkPair> pairs{{0, 2}, {0, 3}, {1, 3}, {1, 4}};
  const std::vector<PairProof> without = prove_pairs(arm.robot, arm.links, pairs);
  const std::vector<PairProof> with = prove_pairs(arm.robot, arm.links, pairs, {.keep_trees = true});
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(with[i].verdict, without[i].verdict);
    EXPECT_EQ(with[i].cells, without[i].cells);
    EXPECT_TRUE(without[i].tree.empty());
    EXPECT_EQ(with[i].tree.empty(), with[i].verdict != PairVerdict::Never);
    if (with[i].tree.empty()) continue;
    ++kept;
    EXPECT_EQ(with[i].tree.size(), with[i].cells);
    EXPECT_EQ(tree_size(with[i].tree, with[i].freedoms.size()), with[i].cells);
    EXPECT_EQ(with[i].ranges.size(), with[i].freedoms.size());
  }
  EXPECT_GT(kept, 0U);
}

// A tree is kept only if a checker, which rounds in another way, finds the same.
TEST(PairProof, KeepsNoTreeOfWhatIsProvenBarely) {
  const std::vector<TriangleMesh> links{meshes::box({0, 0, 0}, {1, 1, 1}), meshes::box({0, 0, 0}, {1, 1, 1})};
  for (const double distance : {1e-9, 1e-13}) {
    const Robot robot = robot_of(2, {joint(JointType::Fixed, 0, 1, {1 + distance, 0, 0}, kAlongX)});
    const LinkPair pair{0, 1};
    const PairProof proof = prove_pairs(robot, links, std::span(&pair, 1), {.keep_trees = true}).front();
    EXPECT_EQ(proof.tree.empty(), distance < 1e-12) << name_of(proof.verdict);
  }
}

// What is proven takes the place of what was sampled.
TEST(AddProofs, SetsKindsAndRowsOfTheSrdf) {
  Hinge hinge;
  Robot& robot = hinge.robot;
  robot = robot_of(3, {limited(joint(JointType::Revolute, 0, 1, {2, 0, 0}, kAlongZ), 0, 1e-3),
                       limited(joint(JointType::Revolute, 1, 2, {}, kAlongZ), 0, Hinge::touch() + 0.01)});
  const std::vector<TriangleMesh> hulls{hinge.links[0], meshes::box({0, -0.1, -1}, {1, 0.1, 1}), hinge.links[1]};
  const Bodies bodies{.visual = hulls, .hull = hulls, .convex = hulls};
  for (const bool is_short : {false, true}) {
    MotionResult motion = check_motion(robot, bodies, {.configurations = 3});
    if (is_short) robot.joints[1].upper = 1;
    add_proofs(robot, bodies, {}, motion);
    ASSERT_EQ(motion.pairs.size(), 3U);
    EXPECT_FALSE(motion.pairs[0].proof) << "adjacent";
    const MotionPair& pair = motion.pairs[1];
    ASSERT_TRUE(pair.proof);
    EXPECT_EQ(pair.kind, is_short ? PairKind::ProvenNever : PairKind::Sometimes);
    EXPECT_EQ(pair.visual_meets_at_witness, !is_short);
    EXPECT_EQ(verdicts_of(motion).never, is_short ? 1U : 0U);
    EXPECT_EQ(verdicts_of(motion).meets, is_short ? 0U : 1U);
    const std::string row =
        R"(<disable_collisions link1="link0" link2="link2" reason="Never"/>  <!-- proven: their hulls meet nowhere)";
    EXPECT_EQ(srdf_of(robot, motion).find(row) != std::string::npos, is_short);
  }
}

// Cylinders of radius 1 beside each other, around which meshes meet where they do not.
TEST(AddProofs, TakesPrimitivesThatAreKeptAsTheyAre) {
  const RobotFile file = read_robot(R"(<robot name="r"><link name="base"/>
    <link name="a"><visual><geometry><cylinder radius="1" length="1"/></geometry></visual></link><link name="m"/>
    <link name="b"><visual><geometry><cylinder radius="1" length="1"/></geometry></visual></link>
    <joint name="f" type="fixed"><parent link="base"/><child link="a"/></joint>
    <joint name="t" type="revolute"><axis xyz="0 0 1"/><parent link="base"/><child link="m"/>
      <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
    <joint name="p" type="fixed"><origin xyz="2.0005 0 0"/><parent link="m"/><child link="b"/></joint></robot>)",
                                    "r.urdf");
  const std::vector<LinkHulls> hulls = link_hulls(file.robot, {});
  const Bodies bodies = bodies_of(file.robot, hulls, Geometry::Visual);
  MotionResult motion = check_motion(file.robot, bodies, {.configurations = 3});
  add_proofs(file.robot, bodies, {}, motion);
  ASSERT_EQ(motion.pairs.size(), 1U);
  EXPECT_EQ(name_of(motion.pairs[0].proof->verdict), "open") << motion.pairs[0].proof->why;
  EXPECT_FALSE(motion.pairs[0].visual_meets_at_witness);
}

}  // namespace
}  // namespace prohull::robot::of_pair_proof
