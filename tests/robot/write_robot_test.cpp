#include "robot/hulls/write_robot.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "io/file.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/sample.h"
#include "robot/files/sphere_file.h"
#include "robot_folder.h"

namespace prohull::robot {
namespace {

void write_all(const std::vector<OutputFile>& files, const std::filesystem::path& folder) {
  for (const OutputFile& file : files) {
    std::filesystem::create_directories((folder / file.path).parent_path());
    file.write(folder / file.path);
  }
}

class WriteRobotTest : public testing::Test {
 protected:
  WriteRobotTest() {
    folder_.add("torus.ply", make_sample("torus", 600));
    std::ofstream(folder_.path() / "arm.urdf") << kArm;
    file_ = read_robot(folder_.path() / "arm.urdf");
    options_.budget.faces = {200, 60};
    hulls_ = link_hulls(file_.robot, options_);
    how_.faces = options_.budget.faces;
  }

  static constexpr const char* kArm =
      "<?xml version=\"1.0\"?>\n"
      "<robot name=\"arm\">\n"
      "  <!-- kept as it is -->\n"
      "  <link name=\"a/b\">\n"
      "    <visual>\n"
      "      <origin xyz=\"0 0 1\"/>\n"
      "      <geometry><mesh filename=\"torus.ply\" scale=\"2 2 2\"/></geometry>\n"
      "    </visual>\n"
      "    <collision>\n"
      "      <geometry><box size=\"1 1 1\"/></geometry>\n"
      "    </collision>\n"
      "  </link>\n"
      "  <link name=\"A_B\"/>\n"
      "  <joint name=\"j\" type=\"fixed\"><parent link=\"a/b\"/><child link=\"A_B\"/></joint>\n"
      "</robot>\n";

  RobotFolder folder_;
  RobotFile file_;
  LinkHullOptions options_;
  std::vector<LinkHulls> hulls_;
  WriteOptions how_;
};

TEST_F(WriteRobotTest, WritesARobotForEachNumberOfFaces) {
  const std::filesystem::path out = folder_.path() / "out";
  write_all(output_files(file_, hulls_, out, how_).files, out);
  for (const auto& [name, mesh, faces] : {std::tuple{"arm.urdf", "meshes/collision/a_b.stl", 200U},
                                          std::tuple{"arm_60.urdf", "meshes/collision_60/a_b.stl", 60U}}) {
    const RobotFile again = read_robot(out / name);
    ASSERT_EQ(again.robot.links[0].collision.size(), 1U);
    const Shape& shape = again.robot.links[0].collision[0];
    ASSERT_TRUE(shape.mesh());
    EXPECT_EQ(shape.mesh()->uri, mesh);
    EXPECT_EQ(shape.mesh()->scale, (Vec3{1, 1, 1}));  // which the hull has already
    EXPECT_EQ(shape.origin, again.robot.links[0].visual[0].origin);
    EXPECT_FALSE(again.robot.links[0].visual[0].mesh()->path.empty()) << "the visual mesh is beside the old file";
    const TriangleMesh hull = read_mesh(shape.mesh()->path);
    EXPECT_LE(hull.face_count(), faces);
    EXPECT_TRUE(verify_cover(mesh_triangles(*again.robot.links[0].visual[0].mesh()), hull).encloses);
    EXPECT_NE(read_file(out / name).find("<!-- kept as it is -->"), std::string::npos);
  }
  EXPECT_EQ(read_file(folder_.path() / "arm.urdf"), kArm);
}

TEST_F(WriteRobotTest, WritesAPackageThatIsFound) {
  const std::filesystem::path out = folder_.path() / "arm_safe";
  how_.package = "arm_safe";
  write_all(output_files(file_, hulls_, out, how_).files, out);
  EXPECT_NE(read_file(out / "package.xml").find("<name>arm_safe</name>"), std::string::npos);
  const RobotFile again = read_robot(out / "arm.urdf");
  EXPECT_EQ(again.robot.links[0].collision[0].mesh()->uri, "package://arm_safe/meshes/collision/a_b.stl");
  EXPECT_FALSE(again.robot.links[0].collision[0].mesh()->path.empty());
  for (const char* bad : {"Arm", "9arm", "arm safe", "../arm", "arm/x"}) {
    how_.package = bad;
    EXPECT_THROW(output_files(file_, hulls_, out, how_), InputError) << bad;
  }
}

TEST_F(WriteRobotTest, KeepsLongNamesShortAndDistinct) {
  const std::string name(300, 'x');
  const std::string visual = "<visual><geometry><mesh filename=\"torus.ply\"/></geometry></visual></link>";
  std::ofstream(folder_.path() / "long.urdf")
      << "<robot name=\"long\"><link name=\"" << name << "1\">" << visual << "<link name=\"" << name << "2\">" << visual
      << "<joint name=\"j\" type=\"fixed\"><parent link=\"" << name << "1\"/><child link=\"" << name
      << "2\"/></joint></robot>";
  const RobotFile robot = read_robot(folder_.path() / "long.urdf");
  const std::filesystem::path out = folder_.path() / "out", meshes = out / "meshes" / "collision";
  std::vector<LinkHulls> hulls{hulls_[0], hulls_[0]};
  hulls[1].link = 1;
  write_all(output_files(robot, hulls, out, how_).files, out);
  EXPECT_TRUE(exists(meshes / (std::string(100, 'x') + ".stl")));
  EXPECT_TRUE(exists(meshes / (std::string(100, 'x') + "_2.stl")));
}

TEST_F(WriteRobotTest, WritesAFileForEachConvexPiece) {
  how_.faces = {500}, how_.format = "obj";
  hulls_[0].collision = Collision::Convex;
  hulls_[0].hulls = {{.pieces = {make_sample("sphere", 80), make_sample("box", 12)}, .verdict = {.certified = true}}};
  const std::filesystem::path out = folder_.path() / "out";
  write_all(output_files(file_, hulls_, out, how_).files, out);
  const RobotFile again = read_robot(out / "arm.urdf");
  ASSERT_EQ(again.robot.links[0].collision.size(), 2U);
  for (const std::size_t i : {0U, 1U}) {
    const Shape& shape = again.robot.links[0].collision[i];
    EXPECT_EQ(shape.mesh()->uri, i == 0 ? "meshes/collision/a_b_01.obj" : "meshes/collision/a_b_02.obj");
    EXPECT_EQ(shape.origin, again.robot.links[0].visual[0].origin);
    EXPECT_EQ(read_mesh(shape.mesh()->path).face_count(), hulls_[0].hulls[0].pieces[i].face_count());
  }
}

TEST_F(WriteRobotTest, KeepsTheNamesOfPiecesDistinctFromThoseOfLinks) {
  const std::string visual = "<visual><geometry><mesh filename=\"torus.ply\"/></geometry></visual></link>";
  std::ofstream(folder_.path() / "two.urdf")
      << "<robot name=\"two\"><link name=\"a\">" << visual << "<link name=\"a_01\">" << visual
      << "<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"a_01\"/></joint></robot>";
  std::vector<LinkHulls> hulls{hulls_[0], hulls_[0]};
  hulls[0].collision = Collision::Convex,
  hulls[0].hulls = {{.pieces = {make_sample("sphere", 80)}, .verdict = {.certified = true}}};
  hulls[1].link = 1;
  how_.faces = {500};
  std::set<std::filesystem::path> names;
  for (const OutputFile& file :
       output_files(read_robot(folder_.path() / "two.urdf"), hulls, folder_.path(), how_).files)
    EXPECT_TRUE(names.insert(file.path).second) << file.path;
  EXPECT_EQ(names.size(), 3U);
}

TEST_F(WriteRobotTest, WritesSpheresIntoTheRobotAndIntoAFileOfTheirOwn) {
  how_.faces = {500};
  hulls_[0].collision = Collision::Spheres, hulls_[0].frame = {};
  hulls_[0].hulls = {{.balls = {{{0.1, -0.2, 1e-7}, 0.125}, {{0, 0, 1}, 0.3}}, .verdict = {.certified = true}}};
  const std::filesystem::path out = folder_.path() / "out";
  const std::vector<OutputFile> files = output_files(file_, hulls_, out, how_).files;
  EXPECT_EQ(files.back().path, "arm_spheres.yaml");
  write_all(files, out);
  EXPECT_FALSE(std::filesystem::exists(out / "meshes"));
  const RobotFile again = read_robot(out / "arm.urdf");
  ASSERT_EQ(again.robot.links[0].collision.size(), 2U);
  for (const std::size_t i : {0U, 1U}) {
    const Ball& ball = hulls_[0].hulls[0].balls[i];
    EXPECT_EQ(std::get<SphereForm>(again.robot.links[0].collision[i].form).radius, ball.radius);
    EXPECT_EQ(again.robot.links[0].collision[i].origin, Pose{.translation = ball.center});
  }
  const auto listed = read_sphere_file(read_file(out / "arm_spheres.yaml"), "arm_spheres.yaml");
  ASSERT_EQ(listed.size(), 1U);
  EXPECT_EQ(listed[0].link, "a/b");
  EXPECT_EQ(listed[0].balls, hulls_[0].hulls[0].balls);
}

TEST_F(WriteRobotTest, WritesSpheresThatALinkHadBeforeToo) {
  std::ofstream(folder_.path() / "ball.urdf")
      << "<robot name=\"ball\"><link name=\"a\"><visual><origin xyz=\"1 2 3\" rpy=\"1 0 0\"/><geometry><sphere "
         "radius=\"0.5\"/></geometry></visual></link></robot>";
  const RobotFile ball = read_robot(folder_.path() / "ball.urdf");
  const std::vector<LinkHulls> hulls = link_hulls(ball.robot, {.budget = {.collision = Collision::Spheres}});
  EXPECT_EQ(hulls[0].status, LinkStatus::Primitives);
  how_.faces = {500};
  const std::filesystem::path out = folder_.path() / "out";
  write_all(output_files(ball, hulls, out, how_).files, out);
  const auto listed = read_sphere_file(read_file(out / "ball_spheres.yaml"), "ball_spheres.yaml");
  ASSERT_EQ(listed.size(), 1U);
  EXPECT_EQ(listed[0].balls, (std::vector<Ball>{{{1, 2, 3}, 0.5}}));
}

TEST_F(WriteRobotTest, WritesNoRobotThatDoesNotSayWhatWasCertified) {
  file_.robot.links[0].visual[0].origin.translation.z = 2;  // the text says 1
  EXPECT_THROW(output_files(file_, hulls_, folder_.path() / "out", how_), InputError);
}

TEST_F(WriteRobotTest, KeepsTheCollisionElementsOfALinkWithoutACertificate) {
  for (LinkHull& hull : hulls_[0].hulls) hull.verdict.certified = false;
  const std::filesystem::path out = folder_.path() / "out";
  write_all(output_files(file_, hulls_, out, how_).files, out);
  const RobotFile again = read_robot(out / "arm.urdf");
  EXPECT_FALSE(again.robot.links[0].collision[0].mesh());
  EXPECT_FALSE(std::filesystem::exists(out / "meshes"));
}

}  // namespace
}  // namespace prohull::robot
