#include "robot/files/piece_files.h"

#include <iterator>
#include <numbers>

#include "io/file.h"
#include "random.h"
#include "robot/files/robot_file.h"
#include "robot/transform.h"
#include "robot_testing.h"

namespace prohull::robot::of_piece_files {
namespace {

constexpr double kPi = std::numbers::pi;
const std::string kHostile = "a<b>&\"'c ü";

std::vector<Shape> collision_of(const std::string& text, const std::string& file) {
  return read_robot(text, file).robot.links.at(0).collision;
}
std::vector<Shape> in_urdf(const NamedPiece& piece) { return collision_of(urdf_of("p", {&piece, 1}), "p.urdf"); }
std::vector<Shape> in_mjcf(const NamedPiece& piece) { return collision_of(mjcf_of("p", {&piece, 1}), "p.xml"); }

OrientedBox turned_box(const Vec3& rpy) {
  const Pose pose = pose_of_rpy(rpy);
  OrientedBox box{{0.1, -20, 1.0 / 3}, {}, {0.1, 1.0 / 7, 2e-7}};
  for (int i = 0; i < 3; ++i)
    box.axes[static_cast<std::size_t>(i)] = {pose.rotation[0][i], pose.rotation[1][i], pose.rotation[2][i]};
  return box;
}

void expect_box(const Shape& shape, const OrientedBox& box) {
  EXPECT_EQ(std::get<BoxForm>(shape.form).size, 2.0 * box.half_sizes);
  EXPECT_EQ(shape.origin.translation, box.center);
  for (std::size_t row = 0; row < 3; ++row)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(shape.origin.rotation[row][axis], box.axes[static_cast<std::size_t>(axis)][static_cast<int>(row)],
                  1e-14);
}

TEST(PieceNames, SortInTheirOrder) {
  EXPECT_EQ(piece_names("a", 2), (std::vector<std::string>{"a_01", "a_02"}));
  EXPECT_EQ(piece_names("a", 100).front(), "a_001");
  EXPECT_EQ(piece_names("a", 100).back(), "a_100");
  EXPECT_TRUE(piece_names("a", 0).empty());
}

TEST(PieceFiles, KeepBoxesWhicheverWayTheyAreTurned) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  std::vector<Vec3> turns{{}, {0.3, kPi / 2, 1}, {2, -kPi / 2, 0}, {kPi, 0, 0}, {0, 0, kPi}, {1, kPi / 2 - 1e-9, 2}};
  while (turns.size() < 50) turns.push_back({angle(random), angle(random), angle(random)});
  for (const Vec3& turn : turns) {
    const OrientedBox box = turned_box(turn);
    for (const auto& shapes : {in_urdf({box, ""}), in_mjcf({box, ""})}) {
      ASSERT_EQ(shapes.size(), 1U);
      expect_box(shapes[0], box);
    }
  }
}

TEST(PieceFiles, KeepBallsAsTheyAre) {
  const Ball ball{{0.1, 1e-20, -1.0 / 3}, 2.0 / 3};
  for (const auto& shapes : {in_urdf({ball, ""}), in_mjcf({ball, ""})}) {
    ASSERT_EQ(shapes.size(), 1U);
    EXPECT_EQ(std::get<SphereForm>(shapes[0].form).radius, ball.radius);
    EXPECT_EQ(shapes[0].origin.translation, ball.center);
  }
}

void expect_along(const Shape& shape, double length, const Capsule& capsule) {
  const double least = norm(capsule.a - placed(shape.origin, {0, 0, -length / 2}));
  const double other = norm(capsule.a - placed(shape.origin, {0, 0, length / 2}));  // either end may be the first
  EXPECT_NEAR(std::min(least, other), 0, 1e-13);
  EXPECT_NEAR(length, norm(capsule.b - capsule.a), 1e-13);
}

TEST(PieceFiles, WriteACapsuleAsThreeShapesInUrdfAndAsOneInMjcf) {
  for (const Vec3& b : {Vec3{1, 2, 3}, Vec3{0, 0, 5}, Vec3{0, 0, -5}, Vec3{-3, 0, 0.5}, Vec3{0, -1e-4, 0.5}}) {
    const Capsule capsule{{0, 0, 0.5}, b, 0.25};
    const auto urdf = in_urdf({capsule, ""}), mjcf = in_mjcf({capsule, ""});
    ASSERT_EQ(urdf.size(), 3U);
    expect_along(urdf[0], std::get<CylinderForm>(urdf[0].form).length, capsule);
    EXPECT_EQ(urdf[1].origin.translation, capsule.a);
    EXPECT_EQ(urdf[2].origin.translation, capsule.b);
    EXPECT_EQ(std::get<SphereForm>(urdf[2].form).radius, capsule.radius);
    ASSERT_EQ(mjcf.size(), 1U);
    expect_along(mjcf[0], std::get<CapsuleForm>(mjcf[0].form).length, capsule);
    EXPECT_EQ(std::get<CapsuleForm>(mjcf[0].form).radius, capsule.radius);
  }
}

// There the middle of its axis is no double.
TEST(PieceFiles, WriteACapsuleFarFromTheOriginInACylinderThatHoldsIt) {
  const double at = 1e5, ulp = std::nextafter(at, 2 * at) - at;
  const Capsule capsule{{at, 0, 0}, {at + ulp, 0, 3 * ulp}, ulp};
  const Shape shape = in_urdf({capsule, ""})[0];
  const auto& cylinder = std::get<CylinderForm>(shape.form);
  const double off = norm(capsule.a - shape.origin.translation + (capsule.b - shape.origin.translation)) / 2;
  ASSERT_GT(off, 0);
  EXPECT_GE(cylinder.radius, capsule.radius + off);
  EXPECT_GE(cylinder.length, norm(capsule.b - capsule.a) + 2 * off);
}

TEST(PieceFiles, WriteACapsuleWithoutLengthAsABall) {
  const Capsule capsule{{1, 2, 3}, {1, 2, 3 + 1e-15}, 0.25};
  for (const auto& shapes : {in_urdf({capsule, ""}), in_mjcf({capsule, ""})}) {
    ASSERT_EQ(shapes.size(), 1U);
    EXPECT_GE(std::get<SphereForm>(shapes[0].form).radius, capsule.radius);
  }
}

TEST(PieceFiles, NameMeshFilesAndPiecesWhateverTheirLetters) {
  const std::vector<NamedPiece> pieces{{{}, kHostile + "_01.stl"}, {{}, kHostile + "_02.stl"}};
  for (const auto& [text, file] :
       {std::pair{urdf_of(kHostile, pieces), "p.urdf"}, {mjcf_of(kHostile, pieces), "p.xml"}}) {
    const Robot robot = read_robot(text, file).robot;
    EXPECT_EQ(robot.links.at(0).name, kHostile);
    ASSERT_EQ(robot.links[0].collision.size(), 2U);
    EXPECT_EQ(robot.links[0].collision[1].mesh()->uri, kHostile + "_02.stl");
    EXPECT_EQ(robot.links[0].collision[1].name, kHostile + "_02");
    EXPECT_EQ(robot.links[0].collision[1].origin, Pose{});
  }
}

TEST(PieceFiles, RefuseNamesThatXmlCannotHold) {
  for (const std::string& name :
       {std::string("a\nb"), std::string("a\x01"), std::string("\xff"), std::string(1, '\0')}) {
    for (const auto& of : {urdf_of, mjcf_of}) {
      EXPECT_TRUE(has(refusal_of([&] { of(name, {}); }, Defect::InvalidOption), "control characters"));
      const NamedPiece piece{{}, name + ".stl"};
      EXPECT_TRUE(has(refusal_of([&] { of("p", {&piece, 1}); }, Defect::InvalidOption), "control characters"));
    }
  }
}

TEST(PieceFiles, RefuseMeshesThatMujocoDoesNotRead) {
  const NamedPiece ply{{}, "a.ply"}, package{{}, "package://a/b.stl"}, upper{{}, "A.STL"};
  EXPECT_TRUE(has(refusal_of([&] { mjcf_of("p", {&ply, 1}); }, Defect::InvalidOption), "as STL or OBJ"));
  EXPECT_TRUE(has(refusal_of([&] { mjcf_of("p", {&package, 1}); }, Defect::InvalidOption), "no URIs"));
  EXPECT_EQ(in_mjcf(upper).size(), 1U);
  EXPECT_EQ(in_urdf(package)[0].mesh()->uri, "package://a/b.stl");
}

TEST(PieceFiles, AreReadByUrdfdom) {
  const std::string program = PROHULL_CHECK_URDF;
  if (program.empty()) GTEST_SKIP() << "check_urdf (liburdfdom-tools) was not found: it did not read the result";
  const std::vector<NamedPiece> pieces{{turned_box({1, 2, 3}), ""},
                                       {Capsule{{0, 0, 0}, {1, 1e-9, 1}, 0.5}, ""},
                                       {Ball{{1e-7, 1, 1}, 0.5}, ""},
                                       {{}, kHostile + ".stl"}};
  const TemporaryFolder folder;
  write_file(folder / "pieces.urdf", urdf_of(kHostile, pieces));
  const std::string log = (folder / "log").string();
  EXPECT_EQ(std::system((program + " " + (folder / "pieces.urdf").string() + " > " + log + " 2>&1").c_str()), 0)
      << read_file(log);
}

}  // namespace
}  // namespace prohull::robot::of_piece_files
