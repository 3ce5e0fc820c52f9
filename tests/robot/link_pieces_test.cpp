#include "robot/files/link_pieces.h"

#include <fmt/format.h>

#include <algorithm>

#include "random.h"
#include "robot_testing.h"

namespace prohull::robot {
namespace {

/// A robot of one link with this collision element.
RobotFile robot_with(const std::string& origin, const std::string& geometry) {
  return read_robot(fmt::format("<robot name=\"r\"><link name=\"a\"><collision>{}<geometry>{}</geometry></collision>"
                                "</link></robot>",
                                origin, geometry),
                    "r.urdf");
}
LinkPieces pieces_of(const std::string& origin, const std::string& geometry) {
  const RobotFile file = robot_with(origin, geometry);
  return link_pieces(file, file.robot.links[0]);
}
std::string refusal(const std::string& origin, const std::string& geometry) {
  return refusal_of([&] { pieces_of(origin, geometry); }, Defect::InvalidOption);
}

TEST(LinkPieces, KeepSpheresAsTheyAre) {
  const LinkPieces pieces = pieces_of("<origin xyz=\"0.1 0.2 0.3\" rpy=\"1 2 3\"/>", "<sphere radius=\"0.7\"/>");
  EXPECT_EQ(pieces.balls, (std::vector<Ball>{{{0.1, 0.2, 0.3}, 0.7}}));
  EXPECT_TRUE(pieces.meshes.empty());
  EXPECT_TRUE(pieces.notes.empty());
}

TEST(LinkPieces, KeepTheCornersOfBoxesThatHaveExactOnes) {
  const LinkPieces pieces = pieces_of("<origin xyz=\"1 0 -2\"/>", "<box size=\"1 2 3\"/>");
  ASSERT_EQ(pieces.meshes.size(), 1U);
  const Box box = bounding_box(pieces.meshes[0]);
  EXPECT_EQ(box.min, (Vec3{0.5, -1, -3.5}));
  EXPECT_EQ(box.max, (Vec3{1.5, 1, -0.5}));
  EXPECT_TRUE(pieces.notes.empty());
}

TEST(LinkPieces, AreWithinBoxesThatAreTurned) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> number(-3, 3);
  for (int i = 0; i < 30; ++i) {
    const Vec3 rpy{number(random), number(random), number(random)}, t{number(random), number(random), number(random)};
    const LinkPieces pieces =
        pieces_of(fmt::format("<origin xyz=\"{} {} {}\" rpy=\"{} {} {}\"/>", t.x, t.y, t.z, rpy.x, rpy.y, rpy.z),
                  "<box size=\"0.3 1 5\"/>");
    ASSERT_EQ(pieces.meshes.size(), 1U);
    EXPECT_EQ(pieces.meshes[0].vertex_count(), 8U);
    ASSERT_EQ(pieces.notes.size(), 1U);
    const double told = std::stod(pieces.notes[0].substr(pieces.notes[0].rfind(' ')));
    EXPECT_GE(told, 0x1p-44 * (norm({0.3, 1, 5}) + norm(t))) << "at most that";
    const Pose back = inverse(pose_of_rpy(rpy, t));
    for (const Vec3& p : pieces.meshes[0].positions) {
      const Vec3 q = placed(back, p);
      EXPECT_LT(std::abs(q.x), 0.15);
      EXPECT_LT(std::abs(q.y), 0.5);
      EXPECT_LT(std::abs(q.z), 2.5);
      EXPECT_NEAR(std::abs(q.z), 2.5, 1e-11);
    }
  }
}

TEST(LinkPieces, RefuseWhatIsNotDecidedExactly) {
  EXPECT_EQ(refusal("", "<cylinder radius=\"1\" length=\"1\"/>").find("r.urdf: line 1: cylinders and capsules"), 0U);
  EXPECT_NE(refusal("", "<capsule radius=\"1\" length=\"1\"/>"), "");
  EXPECT_NE(refusal("", "<cone radius=\"1\" length=\"1\"/>").find("a cone is not read"), std::string::npos);
  EXPECT_NE(refusal("<origin xyz=\"1e20 0 0\"/>", "<box size=\"1 1 1\"/>").find("thinner"), std::string::npos);
}

TEST(LinkPieces, TakeMeshesWhoseCoordinatesAreNotRounded) {
  const TemporaryFolder folder;
  write_file(folder.path() / "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const std::string mesh = fmt::format("<mesh filename=\"{}\"/>", (folder.path() / "m.obj").string());
  EXPECT_EQ(pieces_of("", mesh).meshes.at(0).face_count(), 4U);
  EXPECT_EQ(bounding_box(pieces_of("<origin xyz=\"-4 0 0\"/>", mesh).meshes.at(0)).min, (Vec3{-4, 0, 0}));
  EXPECT_NE(refusal("<origin xyz=\"0 0 0.3\"/>", mesh).find("rounds its coordinates"), std::string::npos);
  EXPECT_NE(refusal("<origin rpy=\"0 0 1\"/>", mesh).find("rounds its coordinates"), std::string::npos);
}

}  // namespace
}  // namespace prohull::robot
