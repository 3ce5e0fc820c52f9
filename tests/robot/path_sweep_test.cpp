#include "robot/motion/path_sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "geometry/predicates.h"
#include "input_error.h"
#include "meshes.h"
#include "prohull/detail/query_io.h"
#include "prohull/error.h"
#include "random.h"
#include "robot/motion/kinematics.h"
#include "robot/transform.h"
#include "robot_of_joints.h"

namespace prohull::robot {
namespace {

bool is_in_one(const Vec3& p, const std::vector<TriangleMesh>& pieces) {
  return std::ranges::any_of(pieces, [&](const TriangleMesh& piece) {
    return std::ranges::all_of(piece.triangles, [&](const auto& t) {
      return side(piece.positions[t[0]], piece.positions[t[1]], piece.positions[t[2]], p) != Side::Outside;
    });
  });
}

/// Of the corners of the boxes at `count` places, which no piece holds.
std::size_t outside(const std::vector<LinkSweep>& sweeps, const Robot& robot, const JointPath& path, int count) {
  std::size_t outside = 0;
  for (int i = 0; i <= count; ++i) {
    const std::vector<Pose> poses = link_poses(moved_by(robot, path), path.positions_at(path.length() * i / count));
    for (std::size_t link = 0; link < sweeps.size(); ++link)
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{(corner & 1) - 0.5, (corner >> 1 & 1) - 0.5, (corner >> 2) - 0.5};
        outside += !is_in_one(placed(poses[link], p), sweeps[link].sweep.pieces);
      }
  }
  return outside;
}

TEST(PathSweep, EnclosesAllLinksOfRandomRobots) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&] { return Vec3{number(random), number(random), number(random)}; };
  const auto unit = [&] {
    const Vec3 v = vector();
    return v / norm(v);
  };
  for (int round = 0; round < 6; ++round) {
    const Robot robot = robot_of(
        5, {joint(JointType::Revolute, 0, 1, 2 * vector(), unit()), joint(JointType::Prismatic, 1, 2, vector(), unit()),
            joint(JointType::Continuous, 2, 3, 2 * vector(), unit()),
            mimicking(joint(JointType::Revolute, 3, 4, vector(), unit()), 0, -1.5, 0.2)});
    PathRows rows{.joints = {"joint0", "joint1", "joint2"}};
    for (int row = 0; row < 4; ++row) {
      rows.positions.push_back({number(random), number(random), number(random)});
      if (round % 2 == 1) rows.velocities.push_back({number(random), number(random), number(random)});
      if (round % 3 == 2 && round % 2 == 1)
        rows.accelerations.push_back({number(random), number(random), number(random)});
    }
    const JointPath path(robot, rows);
    const std::vector<std::size_t> links{0, 1, 2, 3, 4};
    const std::vector<LinkSweep> made = sweep_links(robot, path, links, Geometry::Collision,
                                                    {.max_distance = 0.1, .float32_coordinates = round % 2 == 0});
    ASSERT_EQ(made.size(), 5U);
    EXPECT_EQ(made[0].sweep.pieces.size(), 1U) << "what does not move";
    EXPECT_EQ(outside(made, robot, path, 300), 0U) << round;
    for (const LinkSweep& link : made) EXPECT_LT(link.sweep.verdict.distance().upper, 0.4);
  }
}

TEST(PathSweep, IsAboutAsLargeAsWhatIsPassed) {
  const Robot robot = robot_of(2, {joint(JointType::Revolute, 0, 1, {}, {0, 0, 1})});
  const JointPath path(robot, {.joints = {"joint0"}, .positions = {{0}, {std::numbers::pi}}});
  const std::size_t link = 1;
  const Sweep made = sweep_links(robot, path, {{link}}, Geometry::Visual)[0].sweep;
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> coordinate(-0.8, 0.8);
  int enclosed = 0, passed = 0;
  for (int i = 0; i < 20'000; ++i) {  // the cube passes a disk
    const Vec3 p{coordinate(random), coordinate(random), 0.1};
    enclosed += is_in_one(p, made.pieces), passed += norm(Vec3{p.x, p.y, 0}) <= std::sqrt(0.5);
  }
  EXPECT_LT(enclosed, 1.05 * passed);
  EXPECT_GE(enclosed, passed);
}

// Positions between rows that hardly move take one piece for all of them.
TEST(PathSweep, TakesNoMorePiecesForMoreRows) {
  const Robot robot = robot_of(2, {joint(JointType::Revolute, 0, 1, {}, {0, 0, 1})});
  const std::size_t link = 1;
  const auto pieces = [&](int rows) {
    PathRows path{.joints = {"joint0"}};
    for (int row = 0; row <= rows; ++row) path.positions.push_back({1.0 * row / rows});
    return sweep_links(robot, JointPath(robot, path), {{link}}, Geometry::Visual)[0].sweep.pieces.size();
  };
  EXPECT_EQ(pieces(1), pieces(4096));
}

Robot robot_of_meshes(const std::string& file) {
  Robot robot = robot_of(2, {joint(JointType::Revolute, 0, 1, {}, {0, 0, 1})});
  robot.links[1].visual.push_back({MeshFile{.uri = file, .path = file}});
  return robot;
}

TEST(PathSweep, RefusesMeshesThatItCannotEnclose) {
  const std::string none = testing::TempDir() + "none.obj", nan = testing::TempDir() + "nan.obj";
  std::ofstream(none) << "";
  std::ofstream(nan) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\n";
  const std::size_t link = 1;
  for (const std::string& file : {none, nan}) {
    const Robot robot = robot_of_meshes(file);
    const JointPath path(robot, {.joints = {"joint0"}, .positions = {{0}, {1}}});
    EXPECT_THROW(sweep_links(robot, path, {{link}}, Geometry::Visual), InputError) << file;
  }
}

TEST(PathSweep, RefusesWhatTakesTooMuch) {
  const Robot robot = robot_of(2, {joint(JointType::Revolute, 0, 1, {}, {0, 0, 1})});
  const std::size_t link = 1;
  const JointPath path(robot, {.joints = {"joint0"}, .positions = {{0}, {1}}});
  EXPECT_THROW(sweep_links(robot, path, {{link}}, Geometry::Visual, {.max_distance = 1e-9}), InputError);
}

// The third joint moves link 3 together with the one before it, as joints of MJCF do, and the last one follows another.
Robot robot_of_all_joints(const std::function<double()>& number) {
  const auto vector = [&] { return Vec3{number(), number(), number()}; };
  const auto unit = [&] {
    const Vec3 v = vector();
    return v / norm(v);
  };
  Joint second = limited(joint(JointType::Revolute, 2, 3, {}, unit()), 0.2, 0.9);
  second.anchor = vector();
  return robot_of(6, {limited(joint(JointType::Revolute, 0, 1, 2 * vector(), unit()), -1, 0.5),
                      joint(JointType::Fixed, 1, 2, vector(), {1, 0, 0}),
                      limited(joint(JointType::Prismatic, 2, 3, vector(), unit()), 0.3, 1), second,
                      joint(JointType::Continuous, 3, 4, vector(), unit()),
                      mimicking(joint(JointType::Revolute, 0, 5, vector(), unit()), 0, -1.5, 0.2)});
}

TEST(WorkspaceSweep, EnclosesAllPositionsOfARandomRobot) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> unit(-1, 1);
  const Robot robot = robot_of_all_joints([&] { return unit(random); });
  const std::vector<std::size_t> links{0, 1, 2, 3, 4, 5};
  const std::vector<LinkSweep> made =
      sweep_workspace(robot, links, Geometry::Collision,
                      {.max_pieces = 4, .max_distance = 0.6, .float32_coordinates = unit(random) < 0});
  ASSERT_EQ(made.size(), 1U);
  EXPECT_EQ(made[0].link, "link0");
  EXPECT_TRUE(made[0].sweep.verdict.encloses_solid == Answer::Yes);
  EXPECT_LT(made[0].sweep.verdict.distance().upper, 5);
  for (int i = 0; i < 400; ++i) {
    std::vector<double> positions;
    for (const Joint& j : robot.joints) {
      const double share = 0.5 + std::round(unit(random) * 1.5) / 2;  // often the ends of the limits
      const bool is_limited = std::isfinite(j.lower) && std::isfinite(j.upper);
      positions.push_back(is_limited ? j.lower + std::clamp(share, 0.0, 1.0) * (j.upper - j.lower) : 4 * unit(random));
    }
    follow(robot, positions);
    const std::vector<Pose> poses = link_poses(robot, positions);
    for (std::size_t link = 0; link < poses.size(); ++link) {
      const Vec3 p{unit(random) / 2, unit(random) / 2, unit(random) < 0 ? -0.5 : 0.5};
      ASSERT_TRUE(is_in_one(placed(poses[link], p), made[0].sweep.pieces)) << "link " << link;
    }
  }
}

TEST(WorkspaceSweep, OfOneJointIsAboutAsLargeAsWhatIsPassed) {
  const Robot robot = robot_of(2, {limited(joint(JointType::Revolute, 0, 1, {0, 0, 2}, {0, 0, 1}), -9, 9)});
  const std::size_t link = 1;
  const Sweep made = sweep_workspace(robot, {{link}}, Geometry::Visual)[0].sweep;
  double highest = 0;
  for (const TriangleMesh& piece : made.pieces)
    for (const Vec3& p : piece.positions) highest = std::max(highest, norm(Vec3{p.x, p.y, 0}));
  EXPECT_NEAR(highest, std::sqrt(0.5), 0.05);
  EXPECT_LT(made.verdict.distance().upper, 0.05);
}

double top_of(const Sweep& sweep) {
  double top = -HUGE_VAL;
  for (const TriangleMesh& piece : sweep.pieces) top = std::max(top, bounding_box(piece).max.z);
  return top;
}

// A motor that lifts a nut by 1 cm per radian.
TEST(WorkspaceSweep, WhatFollowsGoesOnWhileItsLeaderTurnsMoreThanOnce) {
  const Joint nut = mimicking(limited(joint(JointType::Prismatic, 0, 2, {}, {0, 0, 1}), 0, 1), 0, 0.01, 0);
  for (const Joint& motor : {joint(JointType::Continuous, 0, 1, {}, {0, 0, 1}),
                             limited(joint(JointType::Revolute, 0, 1, {}, {0, 0, 1}), 0, 100)}) {
    const std::vector<std::size_t> links{1, 2};
    EXPECT_NEAR(top_of(sweep_workspace(robot_of(3, {motor, nut}), links, Geometry::Visual)[0].sweep), 1.5, 1e-6);
  }
}

TEST(WorkspaceSweep, TakesTreesOfAnyDepth) {
  constexpr std::size_t kDepth = 60'000;
  Robot robot;
  robot.links.resize(kDepth + 1);
  for (std::size_t j = 0; j < kDepth; ++j)
    robot.joints.push_back(joint(JointType::Fixed, j, j + 1, {0, 0, 1e-3}, {0, 0, 1}));
  robot.links.back().visual.push_back({BoxForm{{1, 1, 1}}});
  const std::size_t last = kDepth;
  EXPECT_NEAR(top_of(sweep_workspace(robot, {{last}}, Geometry::Visual)[0].sweep), 60.5, 1e-3);
}

TEST(WorkspaceSweep, RefusesJointsWithoutBounds) {
  const std::size_t link = 1;
  const auto refused = [&](const Joint& joint) {
    return std::string(error_of([&] { sweep_workspace(robot_of(2, {joint}), {{link}}, Geometry::Visual); }).what());
  };
  EXPECT_EQ(refused(joint(JointType::Prismatic, 0, 1, {}, {0, 0, 1})), "joint 'joint0' has no limits");
  EXPECT_EQ(refused(joint(JointType::Floating, 0, 1, {}, {0, 0, 1})), "joint 'joint0' neither turns nor slides");
  EXPECT_NE(refused(limited(joint(JointType::Prismatic, 0, 1, {}, {0, 0, 1}), 1, -1)), "");
  EXPECT_NE(refused(mimicking(joint(JointType::Prismatic, 0, 1, {}, {0, 0, 1}), 0, 1, 0)), "");
}

TEST(Poses, AreReadAsQuaternionsOrMatrices) {
  const auto poses_in = [](const char* text) { return read_poses(text, "p.csv", corrected); };
  const auto poses = poses_in("x,y,z,qw,qx,qy,qz\n1,2,3,1,0,0,0\n\n# half a turn\n1,2,3,0,0,0,2\n");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[1].rotation[0], (Vec3{-1, 0, 0}));
  EXPECT_EQ(poses_in("1 2 3 0 0 0 2\n"), std::vector{poses[1]});
  EXPECT_EQ(poses_in("0;-1;0;4;1;0;0;5;0;0;1;6\n")[0].translation, (Vec3{4, 5, 6}));
  EXPECT_EQ(poses_in("1,0,0,7, 0,1,0,8, 0,0,1,9, 0,0,0,1\n")[0].translation, (Vec3{7, 8, 9}));
  const Pose rough = poses_in("1,1e-7,0,0, -1e-7,1,0,0, 0,0,1,0\n")[0];
  EXPECT_NEAR(dot(rough.rotation[0], rough.rotation[0]), 1, 1e-15);  // of a matrix that is almost one, a rotation
  EXPECT_TRUE(poses_in("").empty() && poses_in("# none\n").empty());
  for (const char* text :
       {"1,2,3\n", "1,2,3,nan,0,0,0\n", "x\n1,2,3,0,0,0,0\n", "1,2,3,1,0,0,z\n", "2,0,0,0, 0,1,0,0, 0,0,1,0\n",
        "1,2,3,1,0,0,0x\n0,0,0,1,0,0,0\n", "x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,1\n"})
    EXPECT_THROW(poses_in(text), InputError) << text;
}

TEST(Poses, AreToldWhereTheirMatricesAreNoRotations) {
  Correction correction;
  const double c = std::cos(1), s = std::sin(1);
  correction({{Vec3{c, -s, 0}, {s, c, 0}, {0, 0, 1}}, {}});
  EXPECT_TRUE(correction.notes().empty());
  correction({{Vec3{1 + 4e-7, 0, 0}, {0, 1 + 4e-7, 0}, {0, 0, 1 + 4e-7}}, {}});
  ASSERT_EQ(correction.notes().size(), 1U);
  EXPECT_EQ(correction.notes()[0].find("1 matrix of the poses is no rotation, but nearly"), 0U);
  EXPECT_NE(correction.notes()[0].find("by up to 4.1e-07"), std::string::npos);
}

TEST(Poses, TurnByLessThanDoublesCanSquare) {
  const std::vector<Pose> poses = read_poses("0 0 0 1 0 0 0\n1 0 0 1 0 0 1e-150\n", "p.csv", corrected);
  EXPECT_EQ(sweep(meshes::box({0, 0, 0}, {1, 1, 1}), motions_between(poses)).pieces.size(), 1U);
}

TEST(Poses, AreEnclosedWithTheWaysBetweenThem) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Pose> poses{{}, pose_of_quaternion(0, 0, 0, 1), pose_of_quaternion(1e-9, 1, 1, 0, {1, 0, 0})};
  for (int i = 0; i < 5; ++i)
    poses.push_back(pose_of_quaternion(number(random), number(random), number(random), number(random),
                                       {number(random), number(random), number(random)}));
  const TriangleMesh box = meshes::box({0, 0, 0}, {1, 0.5, 0.25});
  const std::vector<RigidMotion> motions = motions_between(poses);
  const Sweep made = sweep(box, motions);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    EXPECT_LE(motions[i].angle, std::numbers::pi + 1e-9);
    for (int t = 0; t <= 50; ++t) {
      const Pose turn = rotation_about(motions[i].axis, motions[i].angle * t / 50);
      const Vec3 origin = poses[i].translation + motions[i].shift * (t / 50.0);
      for (const Vec3& p : box.positions) {
        const Vec3 at = placed(turn, placed({poses[i].rotation, {}}, p)) + origin;
        EXPECT_TRUE(is_in_one(at, made.pieces));
      }
    }
    for (const Vec3& p : box.positions) EXPECT_TRUE(is_in_one(placed(poses[i + 1], p), made.pieces));
  }
}

}  // namespace
}  // namespace prohull::robot
