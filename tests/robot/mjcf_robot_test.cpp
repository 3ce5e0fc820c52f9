#include "robot/files/mjcf_robot.h"

#include <gtest/gtest.h>

#include "meshes.h"
#include "prohull/mesh_io.h"
#include "prohull/sample.h"
#include "robot/files/inertial.h"
#include "robot/motion/kinematics.h"
#include "robot/motion/mujoco_files.h"
#include "robot_testing.h"

namespace prohull::robot::of_mjcf_robot {
namespace {

RobotFile urdf_of(const std::string& inside) {
  return read_robot("<robot name=\"r\">" + inside + "</robot>", "r.urdf");
}

MjcfRobot mjcf_of_urdf(const std::string& inside) {
  const RobotFile file = urdf_of(inside);
  return mjcf_of(file, file.robot, {}, [](const MeshFile& mesh) { return mesh.uri; });
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& more = "") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent + "\"/><child link=\"" + child +
         "\"/>" + more + "</joint>";
}

bool says(const MjcfRobot& made, const std::string& text) { return made.text.find(text) != std::string::npos; }

TEST(MjcfRobot, MovesAsItsUrdf) {
  const std::string inside =
      "<link name=\"a\"><visual><geometry><box size=\"1 2 3\"/></geometry></visual></link><link name=\"&lt;b&gt;\"/>"
      "<link name=\"c\"><collision><geometry><sphere radius=\"2\"/></geometry></collision></link><link name=\"d\"/>" +
      joint("j", "revolute", "a", "&lt;b&gt;",
            "<origin xyz=\"1 2 3\" rpy=\"1 2 3\"/><axis xyz=\"0 1 1\"/><limit lower=\"-1\" upper=\"2\"/>") +
      joint(
          "&quot;k&quot;", "prismatic", "&lt;b&gt;", "c",
          "<origin rpy=\"0 1 0\"/><limit lower=\"0\" upper=\"3\"/><mimic joint=\"j\" multiplier=\"2\" offset=\"1\"/>") +
      joint("l", "fixed", "c", "d", "<origin xyz=\"0 0 1\"/>");
  const Robot urdf = urdf_of(inside).robot, mjcf = read_robot(mjcf_of_urdf(inside).text, "r.xml").robot;
  ASSERT_EQ(mjcf.links.size(), urdf.links.size());
  const std::vector<double> positions{0.7, 0, 0};
  const std::vector<Pose> before = link_poses(urdf, positions), after = link_poses(mjcf, positions);
  for (std::size_t i = 0; i < urdf.links.size(); ++i) {
    EXPECT_EQ(mjcf.links[i].name, urdf.links[i].name);
    EXPECT_NEAR(norm(after[i].translation - before[i].translation), 0, 1e-12);
    for (std::size_t row = 0; row < 3; ++row)
      EXPECT_NEAR(norm(after[i].rotation[row] - before[i].rotation[row]), 0, 1e-12);
  }
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_EQ(mjcf.joints[j].lower, urdf.joints[j].lower);
    EXPECT_EQ(mjcf.joints[j].upper, urdf.joints[j].upper);
  }
  EXPECT_EQ(mjcf.links[0].visual.size(), 1U);
  EXPECT_EQ(std::get<SphereForm>(mjcf.links[2].collision.at(0).form).radius, 2);
}

TEST(MjcfRobot, NamesWhatItLeavesOut) {
  const RobotFile file = urdf_of(
      "<gazebo/><link name=\"a\"><visual><geometry><mesh filename=\"none.stl\"/></geometry></visual></link>"
      "<link name=\"b\"/>" +
      joint("j", "revolute", "a", "b", "<safety_controller/><limit lower=\"0\" upper=\"1\" effort=\"5\"/>"));
  const MjcfRobot made = mjcf_of(file, file.robot, {}, [](const MeshFile& mesh) -> std::string {
    throw InputError(Defect::CannotRead, mesh.uri);
  });
  EXPECT_EQ(made.text.find("<geom class"), std::string::npos);
  EXPECT_EQ(made.notes, (std::vector<std::string>{
                            "not in it: <gazebo>, <safety_controller>, effort limits",
                            "meshes that cannot be read, or are flat or tiny, are left out of: a",
                            "links that move and have neither mass nor collision geometry weigh 1 g, as MuJoCo refuses "
                            "none: b"}));
}

TEST(MjcfRobot, FindsColoursOfOtherLinks) {
  const std::string box = "<geometry><box size=\"1 1 1\"/></geometry>";
  const MjcfRobot made = mjcf_of_urdf(
      "<link name=\"a\"><visual>" + box + "<material name=\"m\"/></visual></link><link name=\"b\"><visual>" + box +
      "<material name=\"m\"><color rgba=\"0 0.5 1 1\"/></material></visual></link>" + joint("j", "fixed", "a", "b"));
  const std::string color = "rgba=\"0 0.5 1 1\"";
  EXPECT_TRUE(says(made, color));
  EXPECT_NE(made.text.find(color), made.text.rfind(color)) << "both have it";
  EXPECT_NE(refusal_of([&] { mjcf_of_urdf("<link name=\"a\"/><material name=\"m\"><color rgba=\"1\"/></material>"); }),
            "");
}

TEST(MjcfRobot, OnlyARootIsTheWorld) {
  const std::string ball = "<collision><geometry><sphere radius=\"1\"/></geometry></collision>";
  const MjcfRobot root =
      mjcf_of_urdf("<link name=\"world\">" + ball + "</link><link name=\"a\"/>" + joint("j", "floating", "world", "a"));
  EXPECT_FALSE(says(root, "<body name=\"world"));
  EXPECT_TRUE(says(root, "    <geom class=\"collision\"")) << "in <worldbody>";
  EXPECT_TRUE(says(root, "<freejoint name=\"j\"/>"));
  const MjcfRobot other =
      mjcf_of_urdf("<link name=\"world\"/><link name=\"a\"/>" + joint("j", "floating", "a", "world"));
  EXPECT_TRUE(says(other, "<body name=\"world_link\""));
  EXPECT_EQ(other.notes.at(0), "the link world is the body world_link: MuJoCo has a world of its own");
  EXPECT_TRUE(says(other, "<joint name=\"j\" type=\"ball\"")) << "MuJoCo nests no free joints";
}

TEST(MjcfRobot, NamesOfItsOwnAreOfNothingElse) {
  const MjcfRobot made =
      mjcf_of_urdf("<link name=\"a\"/><link name=\"world\"/><link name=\"world_link\"/>" +
                   joint("j", "planar", "a", "world") + joint("j_TX", "fixed", "world", "world_link"));
  EXPECT_TRUE(says(made, "<body name=\"world_link\"") && says(made, "<body name=\"world_link_\""));
  EXPECT_EQ(made.notes.at(0), "the link world is the body world_link_: MuJoCo has a world of its own");
  EXPECT_TRUE(says(made, "<joint name=\"j_TX_\"") && says(made, "<joint name=\"j_TY\""));
}

TEST(MjcfRobot, RefusesLongChainsAndOtherFormats) {
  const auto chain = [](int links) {
    std::string text = "<link name=\"0\"/>";
    for (int i = 1; i < links; ++i)
      text += fmt::format("<link name=\"{}\"/>", i) + joint(fmt::format("j{}", i), i == 1 ? "continuous" : "fixed",
                                                            fmt::format("{}", i - 1), fmt::format("{}", i));
    return text;
  };
  EXPECT_EQ(refusal_of([&] { mjcf_of_urdf(chain(96)); }), "");
  for (const int links : {97, 200, 100'000})
    EXPECT_NE(refusal_of([&] { mjcf_of_urdf(chain(links)); }, Defect::InvalidOption), "") << links;
  const RobotFile sdf = read_robot("<sdf version=\"1.6\"><model name=\"m\"><link name=\"a\"/></model></sdf>", "m.sdf");
  EXPECT_NE(refusal_of([&] { mjcf_of(sdf, sdf.robot, {}, {}); }, Defect::InvalidOption), "");
}

InertiaTensor diagonal(double x, double y, double z) { return {Vec3{x, 0, 0}, Vec3{0, y, 0}, Vec3{0, 0, z}}; }

TEST(MjcfRobot, KeepsTensorsThatABodyCanHave) {
  const InertiaTensor ellipsoid{Vec3{2, 0.1, 0}, Vec3{0.1, 3, 0.2}, Vec3{0, 0.2, 4}};
  EXPECT_EQ(mujoco_tensor(ellipsoid, true), ellipsoid);
  EXPECT_NEAR(mujoco_tensor(diagonal(1, 2, 3), true).value()[2].z, 3, 1e-8) << "a plate";
  EXPECT_GT(mujoco_tensor(diagonal(0, 1, 1), true).value()[0].x, 0) << "a rod";
  for (const InertiaTensor& bad : {diagonal(1, 2, 4), diagonal(-1, 2, 2), diagonal(0, 0, 0),
                                   InertiaTensor{Vec3{1, 2, 0}, Vec3{2, 1, 0}, Vec3{0, 0, 1}}})
    EXPECT_FALSE(mujoco_tensor(bad, true));
  EXPECT_TRUE(mujoco_tensor({}, false));
  EXPECT_EQ(mean_tensor({.mass = 1, .tensor = diagonal(1, 2, 6)}), diagonal(3, 3, 3));
  EXPECT_TRUE(mujoco_tensor(mean_tensor({.mass = 1e-13}), true));
}

TEST(MujocoFiles, HoldTheMeshesAsMujocoReadsThem) {
  const TemporaryFolder folder;
  TriangleMesh fine = make_sample("bracket", 300);
  write_mesh(folder / "fine.stl", fine);
  write_mesh(folder / "flat.stl", meshes::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}));
  const auto visual = [](const std::string& mesh) {
    return "<visual><geometry><mesh filename=\"" + mesh + "/></geometry></visual>";
  };
  write_bytes(folder / "r.xml", "<robot name=\"r\"><link name=\"a\">" + visual("fine.stl\"") + visual("fine.stl\"") +
                                    visual("fine.stl\" scale=\"0.1 0.1 -0.1\"") + visual("flat.stl\"") +
                                    "</link></robot>");
  const RobotFile file = read_robot(folder / "r.xml");
  RobotFiles written;
  written.robots.emplace_back("r.xml", file.robot);
  const MujocoFiles made = mujoco_files(file, written, {});
  EXPECT_EQ(made.notes.size(), 1U);
  std::vector<std::string> names;
  for (const OutputFile& output : made.files) {
    std::filesystem::create_directories((folder.path() / output.path).parent_path());
    output.write(folder.path() / output.path);
    names.push_back(output.path.generic_string());
  }
  EXPECT_EQ(names, (std::vector<std::string>{"r.mjcf", "meshes/visual/fine.stl", "meshes/visual/fine_2.obj"}));
  const Robot again = read_robot(folder / "r.mjcf").robot;
  ASSERT_EQ(again.links[0].visual.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_TRUE(has_triangles_of(mesh_triangles(*again.links[0].visual[i].mesh()),
                                 mesh_triangles(*file.robot.links[0].visual[i].mesh())));
}

}  // namespace
}  // namespace prohull::robot::of_mjcf_robot
