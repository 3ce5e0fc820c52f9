#include "robot/files/robot_file.h"

#include <array>
#include <chrono>
#include <iterator>

#include "io/file.h"
#include "robot/files/xacro.h"
#include "robot/robot_testing.h"

namespace prohull::robot {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kUrdf = "<robot name='r'><link name='a'/></robot>";
constexpr std::string_view kXacro =
    "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'><xacro:arg name='x' default='1'/></robot>";

class ReadRobot : public testing::Test {
 protected:
  fs::path file(const char* name, std::string_view bytes) const {
    write_file(folder_ / name, bytes);
    return folder_ / name;
  }
  void expect_refused(const fs::path& path, Defect defect, std::string_view message) const {
    const std::string refusal = refusal_of([&] { read_robot(path); }, defect);
    EXPECT_TRUE(has(refusal, message)) << refusal;
    EXPECT_TRUE(refusal.starts_with(path.string())) << refusal;
  }
  /// A program xacro that is found before all others.
  std::string path_with_xacro(const std::string& script) const {
    const fs::path program = file("bin/xacro", "#!/bin/sh\n" + script + "\n");
    fs::permissions(program, fs::perms::owner_all);
    return program.parent_path().string() + ":/usr/bin:/bin";
  }

  TemporaryFolder folder_;
};

TEST_F(ReadRobot, GoesByTheContent) {
  const fs::path path = file("arm.txt", kUrdf);
  const RobotFile robot = read_robot(path);
  EXPECT_EQ(robot.format, RobotFormat::Urdf);
  EXPECT_EQ(robot.path, path);
  EXPECT_EQ(robot.text, kUrdf);
  EXPECT_EQ(read_robot(file("bom.urdf", "\xef\xbb\xbf" + std::string(kUrdf))).robot.links.size(), 1U);
  EXPECT_EQ(joined(robot_format_names()), "urdf, sdf, mjcf");
}

TEST_F(ReadRobot, RefusesWhatIsNoRobot) {
  expect_refused(folder_ / "none.urdf", Defect::CannotRead, "cannot read: there is no such file");
  expect_refused(folder_.path(), Defect::CannotRead, "this is a folder");
  expect_refused(file("empty.urdf", ""), Defect::Malformed, "the file is empty");
  expect_refused(file("blank.urdf", " \n\t\r\n"), Defect::Malformed, "the file is empty");
  expect_refused(file("part.stl", std::string(84, '\0')), Defect::UnknownFormat, "prohull build");
  expect_refused(file("part.obj", "v 0 0 0\n"), Defect::UnknownFormat, "URDF, SDF and MJCF are XML");
  expect_refused(file("part.dae", "<COLLADA/>"), Defect::UnknownFormat, "its root is <COLLADA>");
  expect_refused(file("nul.urdf", std::string("<robot name='r'>\0</robot>", 25)), Defect::Malformed, "line 1");
  expect_refused(file("utf16.urdf", std::string("\xff\xfe<\0r\0", 6)), Defect::Malformed, "UTF-16");
  expect_refused(file("bomb.urdf", "<!DOCTYPE r [<!ENTITY a 'aaaa'>]><robot name='&a;'/>"), Defect::Malformed,
                 "entity");
  expect_refused(file("cut.urdf", kUrdf.substr(0, 30)), Defect::Malformed, "no XML");
  expect_refused("/dev/zero", Defect::UnknownFormat, "URDF, SDF and MJCF are XML");
}

TEST_F(ReadRobot, RefusesFilesThatAreTooLarge) {
  const fs::path path = file("large.urdf", kUrdf);
  fs::resize_file(path, std::uintmax_t{3} << 30);  // takes no space on the disk
  expect_refused(path, Defect::Malformed, "more than 512 MiB");
}

TEST_F(ReadRobot, SaysWhatToDoWithUsd) {
  for (const auto& [name, bytes] : std::array<std::pair<const char*, std::string_view>, 4>{
           {{"a.urdf", "#usda 1.0"}, {"b", "PXR-USDC"}, {"c.zip", "PK\x03\x04"}, {"d.USDA", "<robot/>"}}})
    expect_refused(file(name, bytes), Defect::UnknownFormat, "export the robot as URDF or MJCF");
}

TEST_F(ReadRobot, RunsXacro) {
  const fs::path path = file("arm.urdf.xacro", kXacro);
  write_file(folder_ / "a.stl");
  const Variable program("PATH", path_with_xacro("grep -q x \"$1\" && test $# = 1 && echo \"<robot name='x'><link "
                                                 "name='$(basename $1)'><visual><geometry><mesh filename='a.stl'/>"
                                                 "</geometry></visual></link></robot>\"; cat; echo warning >&2"));
  const RobotFile robot = read_robot(path);
  EXPECT_EQ(robot.robot.name, "x");
  EXPECT_EQ(robot.robot.links[0].name, "arm.urdf.xacro");
  EXPECT_EQ(robot.robot.links[0].visual[0].mesh()->path, folder_ / "a.stl");
  EXPECT_EQ(robot.path, path);
  EXPECT_TRUE(robot.text.starts_with("<robot name='x'>"));
  EXPECT_EQ(read_robot(file("attribute.urdf", "<robot name='${x}'><link name='a'/></robot>")).robot.name, "x");
}

TEST_F(ReadRobot, APackageIsNoXacro) {
  expect_refused(file("package.xml", "<package><export><gazebo_ros path='${prefix}/..'/></export></package>"),
                 Defect::UnknownFormat, "no robot: its root is <package>");
}

TEST_F(ReadRobot, PassesOnWhatXacroSays) {
  const fs::path path = file("arm.xacro", kXacro);
  const Variable program("PATH", path_with_xacro("echo 'Undefined substitution argument ur_type' >&2; exit 2"));
  expect_refused(path, Defect::Malformed, "xacro says: Undefined substitution argument ur_type");
  path_with_xacro("echo '<robot>'");
  expect_refused(path, Defect::Malformed, "expanded by xacro: line 2: no XML");
  path_with_xacro("exit 0");
  expect_refused(path, Defect::Malformed, "expanded by xacro: the file is empty");
}

TEST_F(ReadRobot, StopsXacroThatRunsTooLongOrWritesTooMuch) {
  const fs::path path = file("arm.xacro", kXacro);
  const Variable program("PATH", path_with_xacro("exec sleep 30"));
  const auto refusal = [&] { return refusal_of([&] { expanded_by_xacro(path, std::chrono::seconds(0)); }); };
  EXPECT_TRUE(has(refusal(), "stopped after 0 s")) << refusal();
  path_with_xacro("exec cat /dev/zero");
  expect_refused(path, Defect::Malformed, "too large for a robot");
  path_with_xacro("kill -TERM $$");
  EXPECT_THROW(read_robot(path), Cancelled);
  path_with_xacro("kill -SEGV $$");
  expect_refused(path, Defect::Malformed, "xacro failed");
}

TEST_F(ReadRobot, SaysHowToInstallXacro) {
  const fs::path path = file("arm.xacro", kXacro);
  const Variable program("PATH", folder_.path().string());
  expect_refused(path, Defect::UnknownFormat, "pip install xacro");
  const std::string refusal = refusal_of([&] { read_robot(std::string(kXacro), path); }, Defect::UnknownFormat);
  EXPECT_TRUE(has(refusal, "> robot.urdf")) << refusal;
  EXPECT_EQ(read_robot(file("plain.xacro", kUrdf)).robot.name, "r");  // without macros it needs no xacro
}

// Robots that exist

struct Known {
  std::string path;
  std::size_t links, joints, meshes, missing, mimics;
};
void PrintTo(const Known& known, std::ostream* stream) { *stream << known.path; }

const std::string kShared = PROHULL_SHARED_ROBOTS, kBench = PROHULL_BENCH_ROBOTS;

class KnownRobot : public testing::TestWithParam<Known> {
 protected:
  static RobotFile read() { return read_robot(fs::path(GetParam().path), {{kShared}}); }
};

INSTANTIATE_TEST_SUITE_P(
    Robots, KnownRobot,
    testing::Values(Known{kBench + "/ur5e.urdf", 12, 11, 14, 0, 0}, Known{kBench + "/fr3v2.urdf", 14, 13, 20, 3, 1},
                    Known{kBench + "/xarm_gripper.urdf", 8, 7, 14, 0, 5},
                    Known{kShared + "/motoman/motoman_mh5_support/urdf/mh5.urdf", 7, 6, 14, 0, 0},
                    Known{kShared + "/motoman/motoman_sia20d_support/urdf/sia20d.urdf", 10, 9, 16, 0, 0}),
    [](const auto& information) { return fs::path(information.param.path).stem().string(); });

TEST_P(KnownRobot, IsRead) {
  if (!fs::exists(GetParam().path)) GTEST_SKIP() << GetParam().path << " was not read: it is not here";
  const Robot robot = read().robot;
  std::size_t meshes = 0, missing = 0, mimics = 0;
  std::string why_not;
  for (const Link& link : robot.links)
    for (const Geometry which : {Geometry::Visual, Geometry::Collision})
      for (const Shape& shape : shapes(link, which)) {
        meshes += shape.mesh() ? 1 : 0;
        if (!shape.mesh() || shape.mesh()->why_not.empty()) continue;
        ++missing, why_not += shape.mesh()->why_not + "\n";
      }
  for (const Joint& joint : robot.joints) mimics += joint.mimic ? 1 : 0;
  EXPECT_EQ(robot.links.size(), GetParam().links);
  EXPECT_EQ(robot.joints.size(), GetParam().joints);
  EXPECT_EQ(meshes, GetParam().meshes);
  EXPECT_EQ(mimics, GetParam().mimics);
  if (!fs::exists(kShared)) GTEST_SKIP() << "the meshes were not looked for: there is no " << kShared;
  EXPECT_EQ(missing, GetParam().missing) << why_not;
}

TEST_P(KnownRobot, IsWrittenAsUrdfdomReadsIt) {
  if (!fs::exists(GetParam().path)) GTEST_SKIP() << GetParam().path << " was not written: it is not here";
  const RobotFile file = read();
  EXPECT_EQ(with_collisions(file, {}, fs::path(GetParam().path).parent_path()), read_file(GetParam().path));
  std::vector<NewCollision> collisions;
  for (std::size_t link = 0; link < file.robot.links.size(); ++link)
    if (!file.robot.links[link].visual.empty())
      collisions.push_back({.link = link, .hulls = {"meshes/" + std::to_string(link) + ".stl"}, .same_origin_as = 0});
  const TemporaryFolder folder;
  write_file(folder / "robot.urdf", with_collisions(file, collisions, folder.path()));
  const Robot again = read_robot(folder / "robot.urdf").robot;
  for (const NewCollision& collision : collisions) {
    const std::vector<Shape>& shapes = again.links[collision.link].collision;
    ASSERT_EQ(shapes.size(), 1U);
    EXPECT_EQ(shapes[0].mesh()->uri, collision.hulls[0]);
    EXPECT_EQ(shapes[0].origin, file.robot.links[collision.link].visual[0].origin);
  }
  const std::string program = PROHULL_CHECK_URDF;
  if (program.empty()) GTEST_SKIP() << "check_urdf (liburdfdom-tools) was not found: it did not read the result";
  const std::string log = (folder / "log").string();
  EXPECT_EQ(std::system((program + " " + (folder / "robot.urdf").string() + " > " + log + " 2>&1").c_str()), 0)
      << read_file(log);
}

}  // namespace
}  // namespace prohull::robot
