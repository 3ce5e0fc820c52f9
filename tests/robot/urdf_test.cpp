#include "robot/files/urdf.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <random>

#include "effort.h"
#include "robot/robot_testing.h"

namespace prohull::robot::of_urdf {
namespace {

namespace fs = std::filesystem;

RobotFile read(const std::string& text) { return read_robot(text, fs::path("arm.urdf")); }
RobotFile robot_of(const std::string& inside) { return read("<robot name='r'>\n" + inside + "\n</robot>"); }

void expect_refused(const std::string& inside, std::string_view message) {
  const std::string refusal = refusal_of([&] { robot_of(inside); });
  EXPECT_TRUE(has(refusal, message)) << inside << "\n" << refusal;
  EXPECT_TRUE(refusal.starts_with("arm.urdf: line ")) << refusal;
}

std::string link(const std::string& name) { return "<link name='" + name + "'/>"; }
std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& more = "", const std::string& type = "fixed") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child + "'/>" +
         more + "</joint>";
}
std::string geometry(const std::string& form) {
  return "<link name='a'><visual><geometry>" + form + "</geometry></visual></link>";
}
template <class F>
F form_of(const std::string& form) {
  return std::get<F>(robot_of(geometry(form)).robot.links[0].visual[0].form);
}

TEST(ReadUrdf, ReadsLinks) {
  const RobotFile file = read(R"(<robot name="r">
  <link name="a">
    <visual name="shell"><origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/>
      <geometry><mesh filename="a.stl" scale="0.001 0.001 -0.001"/></geometry></visual>
    <visual><geometry><box size="1 2 3"/></geometry></visual>
    <inertial/>
    <collision><geometry><sphere radius="2"/></geometry></collision>
    <collision><geometry><cylinder radius="1" length="3"/></geometry></collision>
  </link>
</robot>)");
  ASSERT_EQ(file.robot.links.size(), 1U);
  const Link& link = file.robot.links[0];
  EXPECT_EQ(file.robot.name, "r");
  EXPECT_EQ(file.format, RobotFormat::Urdf);
  EXPECT_EQ(link.name, "a");
  EXPECT_EQ(link.line, 2U);
  ASSERT_EQ(link.visual.size(), 2U);
  ASSERT_EQ(link.collision.size(), 2U);
  EXPECT_EQ(link.visual[0].name, "shell");
  EXPECT_EQ(link.visual[0].line, 3U);
  EXPECT_EQ(link.visual[0].origin.translation, (Vec3{1, 2, 3}));
  EXPECT_EQ(link.visual[0].origin.rotation[1].x, 1);
  EXPECT_EQ(link.visual[0].mesh()->uri, "a.stl");
  EXPECT_EQ(link.visual[0].mesh()->scale, (Vec3{0.001, 0.001, -0.001}));
  EXPECT_EQ(std::get<BoxForm>(link.visual[1].form).size, (Vec3{1, 2, 3}));
  EXPECT_EQ(link.visual[1].origin, Pose{});
  EXPECT_EQ(std::get<SphereForm>(link.collision[0].form).radius, 2);
  EXPECT_EQ(std::get<CylinderForm>(link.collision[1].form).length, 3);
}

TEST(ReadUrdf, ReadsFormsThatNotEveryToolKnows) {
  EXPECT_EQ(form_of<CapsuleForm>("<capsule radius='1' length='4'/>").length, 4);
  EXPECT_EQ(form_of<OtherForm>("<drake:ellipsoid a='1'/>").what, "drake:ellipsoid");
  EXPECT_EQ(robot_of(geometry("<drake:ellipsoid a='1'/>")).notes,
            std::vector<std::string>{"line 2: the drake:ellipsoid of link 'a' is not read"});
  EXPECT_EQ(form_of<MeshFile>("<mesh filename='a' scale='2'/>").scale, (Vec3{2, 2, 2}));
  const Pose pose = robot_of(
                        "<link name='a'><visual><origin quat_xyzw='0 0 2e-200 2e-200'/><geometry><box size='1 1 1'/>"
                        "</geometry></visual></link>")
                        .robot.links[0]
                        .visual[0]
                        .origin;
  EXPECT_NEAR(pose.rotation[1].x, 1, 1e-15);
}

// Robots that simulators show have them.
TEST(ReadUrdf, NotesShapesOfNoSize) {
  for (const char* form : {"<box size='1 1 0'/>", "<sphere radius='-1'/>", "<sphere radius='0'/>",
                           "<cylinder radius='1' length='0'/>", "<capsule radius='0' length='1'/>"}) {
    const RobotFile file = robot_of(geometry(form));
    EXPECT_TRUE(std::holds_alternative<OtherForm>(file.robot.links[0].visual[0].form)) << form;
    ASSERT_EQ(file.notes.size(), 1U) << form;
    EXPECT_TRUE(has(file.notes[0], "of size 0 or less of link 'a' is not read")) << file.notes[0];
  }
}

TEST(ReadUrdf, NotesJointsThatFollowUnknownOnes) {
  const RobotFile file = robot_of(link("a") + link("b") + joint("j", "a", "b", "<mimic joint='x'/>"));
  EXPECT_FALSE(file.robot.joints[0].mimic);
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_TRUE(has(file.notes[0], "<mimic> names a joint that does not exist: 'x'")) << file.notes[0];
}

TEST(ReadUrdf, RefusesShapesThatAreNone) {
  expect_refused("<link name='a'><visual/></link>", "line 2: <visual> has no <geometry>");
  expect_refused(geometry(""), "<geometry> is empty");
  expect_refused(geometry("<mesh/>"), "<mesh> has no filename");
  expect_refused(geometry("<mesh filename=''/>"), "empty filename");
  expect_refused(geometry("<mesh filename='a' scale='1 0 1'/>"), "flattens");
  expect_refused(geometry("<mesh filename='a' scale='1 1'/>"), "three numbers");
  expect_refused(geometry("<box/>"), "<box> has no size");
  expect_refused(geometry("<box size='1 1'/>"), "three numbers");
  expect_refused(geometry("<sphere radius='nan'/>"), "'nan' where a number was expected");
  expect_refused(geometry("<sphere radius='1e101'/>"), "<sphere> has the number 1e+101, which is beyond 1e+100");
  expect_refused(geometry("<sphere radius='1e999'/>"), "'1e999' where a number");
  expect_refused(geometry("<cylinder radius='1'/>"), "<cylinder> has no length");
  expect_refused(
      "<link name='a'><visual><origin quat_xyzw='0 0 0 0'/><geometry><box size='1 1 1'/></geometry>"
      "</visual></link>",
      "not all 0");
  expect_refused(
      "<link name='a'><collision><origin xyz='1 2 inf'/><geometry><box size='1 1 1'/></geometry>"
      "</collision></link>",
      "'inf'");
}

TEST(ReadUrdf, ReadsJoints) {
  const Robot robot =
      robot_of(link("a") + link("b") + link("c") + link("d") + link("e") +
               joint("ab", "a", "b", "<axis xyz='0 3e-200 4e-200'/><limit lower='-1' upper='2'/>", "revolute") +
               joint("bc", "b", "c", "<limit effort='1' velocity='1'/>", "prismatic") +
               joint("ad", "a", "d", "<axis xyz='0 0 0'/><origin xyz='1 0 0'/>") +
               joint("ae", "a", "e", "<mimic joint='ab' multiplier='-2' offset='0.5'/><limit/>", "continuous"))
          .robot;
  ASSERT_EQ(robot.joints.size(), 4U);
  EXPECT_EQ(robot.joints[0].type, JointType::Revolute);
  EXPECT_NEAR(robot.joints[0].axis.y, 0.6, 1e-15);
  EXPECT_NEAR(robot.joints[0].axis.z, 0.8, 1e-15);
  EXPECT_EQ(robot.joints[0].lower, -1);
  EXPECT_EQ(robot.joints[0].upper, 2);
  EXPECT_EQ(robot.joints[1].axis, (Vec3{1, 0, 0}));
  EXPECT_EQ(robot.joints[1].lower, 0);
  EXPECT_EQ(robot.joints[1].upper, 0);
  EXPECT_EQ(robot.joints[2].origin.translation, (Vec3{1, 0, 0}));
  EXPECT_TRUE(std::isinf(robot.joints[3].lower) && std::isinf(robot.joints[3].upper));
  EXPECT_EQ(robot.joints[3].mimic->joint, 0U);
  EXPECT_EQ(robot.joints[3].mimic->multiplier, -2);
  EXPECT_EQ(robot.joints[3].mimic->offset, 0.5);
}

TEST(ReadUrdf, PutsParentsFirstAndKeepsTheOrderOtherwise) {
  const Robot robot = robot_of(joint("cd", "c", "d", "<mimic joint='ab'/>") + joint("bc", "b", "c") +
                               joint("ae", "a", "e") + joint("ab", "a", "b", "<mimic joint='ae' multiplier='3'/>") +
                               link("d") + link("c") + link("b") + link("e") + link("a"))
                          .robot;
  std::string order;
  for (const Joint& each : robot.joints) order += each.name + " ";
  EXPECT_EQ(order, "ae ab bc cd ");
  EXPECT_EQ(robot.joints[3].mimic->joint, 1U);
  EXPECT_EQ(robot.joints[1].mimic->joint, 0U);
  EXPECT_EQ(robot.links[robot.joints[3].child].name, "d");
  EXPECT_EQ(robot.links[0].name, "d");
}

TEST(ReadUrdf, IgnoresWhatIsNotDirectlyInTheRobot) {
  const Robot robot = robot_of(link("a") + "<transmission name='t'><joint name='x'/></transmission>" +
                               "<gazebo reference='a'><link name='y'/><joint name='j'/></gazebo>" +
                               "<material name='m'/><!-- <link name='z'/> -->")
                          .robot;
  EXPECT_EQ(robot.links.size(), 1U);
  EXPECT_TRUE(robot.joints.empty());
}

TEST(ReadUrdf, TakesNoAttributesFromADtd) {
  const std::string refusal = refusal_of([] {
    read(
        "<!DOCTYPE robot [<!ATTLIST mesh filename CDATA 'x'>]><robot name='r'><link name='a'><visual><geometry><mesh/>"
        "</geometry></visual></link></robot>");
  });
  EXPECT_TRUE(has(refusal, "<mesh> has no filename")) << refusal;
}

TEST(ReadUrdf, ExchangesLimitsAndSaysSo) {
  const RobotFile file =
      robot_of(link("a") + link("b") + joint("j", "a", "b", "<limit lower='2' upper='1'/>", "revolute"));
  EXPECT_EQ(file.robot.joints[0].lower, 1);
  EXPECT_EQ(file.robot.joints[0].upper, 2);
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_TRUE(has(file.notes[0], "'j'"));
}

TEST(ReadUrdf, TellsOfJointsThatTheirLimitHoldsStill) {
  std::string robot = link("a");
  for (const std::string name : {"b", "c", "d", "e", "f", "g", "h"})
    robot += link(name) + joint("to_" + name, "a", name, "<limit effort='1'/>", "revolute");
  EXPECT_EQ(robot_of(robot).notes,
            (std::vector<std::string>{"7 joints whose <limit> has neither lower nor upper, which URDF reads as 0 to 0: "
                                      "they stay there: to_b, to_c, to_d, to_e, to_f, and 2 more"}));
  EXPECT_TRUE(robot_of(link("a") + link("b") + joint("j", "a", "b", "<limit upper='1'/>", "revolute")).notes.empty());
}

TEST(ReadUrdf, TakesHugeLimitsForNone) {
  const Joint read =
      robot_of(link("a") + link("b") + joint("j", "a", "b", "<limit lower='-1.79769e+308' upper='1e16'/>", "revolute"))
          .robot.joints[0];
  EXPECT_EQ(read.lower, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(read.upper, 1e16);
}

TEST(ReadUrdf, RefusesNames) {
  expect_refused("", "no links");
  expect_refused("<link/>", "<link> has no name");
  expect_refused("<link name=''/>", "empty name");
  expect_refused(link("a") + "\n" + link("a"), "line 3: there are two links called 'a'; the other one is in line 2");
  expect_refused(link("a") + link("b") + link("c") + joint("j", "a", "b") + joint("j", "a", "c"), "two joints");
  expect_refused(link("a") + joint("j", "a", "x"), "<child> names a link that does not exist: 'x'");
  expect_refused(link("a") + joint("j", "x", "a"), "<parent> names a link that does not exist: 'x'");
  expect_refused(link("a") + "<joint name='j' type='fixed'><child link='a'/></joint>", "'j' has no <parent>");
  expect_refused(link("a") + "<joint name='j' type='fixed'><parent/><child link='a'/></joint>", "has no link");
  expect_refused(link("a") + link("b") + joint("j", "a", "b", "<mimic/>"), "<mimic> has no joint");
}

TEST(ReadUrdf, RefusesJoints) {
  const std::string links = link("a") + link("b");
  expect_refused(links + joint("j", "a", "b", "", "screw"), "type 'screw', which is not known");
  expect_refused(links + "<joint name='j'/>", "<joint> has no type");
  expect_refused(links + joint("j", "a", "b", "", "revolute"), "joint 'j' has no <limit>");
  expect_refused(links + joint("j", "a", "b", "<limit lower='x'/>", "prismatic"), "'x' where a number");
  expect_refused(links + joint("j", "a", "b", "<axis xyz='0 0 0'/>", "continuous"), "no direction");
  expect_refused(links + joint("j", "a", "b", "<axis xyz='1 nan 0'/>", "continuous"), "'nan'");
  expect_refused(links + joint("j", "a", "b", "<mimic joint='j'/>"), "mimics itself");
}

TEST(ReadUrdf, RefusesWhatIsNoTree) {
  const std::string links = link("a") + link("b") + link("c");
  expect_refused(links + joint("j", "a", "b"), "two roots: no joint leads to link 'c', nor to link 'a'");
  expect_refused(links + joint("j", "a", "a"), "'j' is part of a loop");
  expect_refused(links + joint("j", "b", "c") + "\n" + joint("k", "c", "b"), "is part of a loop");
  expect_refused(links + joint("j", "a", "b") + joint("k", "b", "c") + joint("l", "c", "a"), "part of a loop");
  expect_refused(links + joint("j", "a", "c") + "\n" + joint("k", "b", "c"),
                 "line 3: link 'c' is the child of two joints, 'j' and 'k'");
  expect_refused(links + joint("j", "a", "b", "<mimic joint='k'/>") + joint("k", "b", "c", "<mimic joint='j'/>"),
                 "mimics itself");
}

std::string numbered(std::string name, int number) { return name.append(std::to_string(number)); }

TEST(ReadUrdf, ReadsLongChainsWithoutRecursion) {
  const int count = effort(100'000, 10'000);
  std::string text = link("l0");
  for (int i = count; i > 0; --i) {  // children before parents
    std::string mimic = "<mimic joint='";
    mimic.append(numbered("j", i - 1)).append("'/>");
    text +=
        link(numbered("l", i)) + joint(numbered("j", i), numbered("l", i - 1), numbered("l", i), i > 1 ? mimic : "");
  }
  const Robot robot = robot_of(text).robot;
  EXPECT_EQ(robot.joints.size(), std::size_t(count));
  EXPECT_EQ(robot.joints.front().name, "j1");
  EXPECT_EQ(robot.joints.back().mimic->joint, std::size_t(count) - 2);
  const std::string refusal = refusal_of([&] { robot_of(text + joint("last", numbered("l", count), "l0")); });
  EXPECT_TRUE(has(refusal, "part of a loop")) << refusal;
}

TEST(ReadUrdf, ReadsManyLinks) {
  const int count = effort(100'000, 20'000);
  std::string text = link("l0");
  for (int i = 1; i < count; ++i) {
    text.append("<link name='").append(numbered("l", i));
    text.append("'><visual><geometry><mesh filename='package://p/").append(std::to_string(i));
    text.append(".stl'/></geometry></visual></link>\n") +=
        joint(numbered("j", i), numbered("l", i / 2), numbered("l", i));
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(robot_of(text).robot.joints.size(), std::size_t(count) - 1);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

// Writing

const std::string kArm = R"(<?xml version='1.0' encoding="UTF-8"?>
<?xml-model href="x"?>
<!-- an <arm> & more -->
<robot   name = 'r'  xmlns:x="http://x">
	<link name='a' >
    <inertial><mass value="1"/></inertial>
    <visual name="shell">
      <origin rpy='0 0 1'   xyz="1 2 3" /> <!-- kept -->
      <geometry><mesh filename="a.stl" scale="1 1 1"/></geometry>
    </visual>
    <visual>
      <origin xyz="4 5 6"/>
      <geometry>
        <box size="1 1 1"/><!-- a box -->
      </geometry>
    </visual>

    <collision name="c">
      <!-- a comment -->
      <geometry>
        <!-- <mesh filename="old.stl"/> -->
        <mesh filename='coarse.stl'
              scale="1 1 1"></mesh>
      </geometry>
      <x:vendor y="1>2"/>
    </collision>

    <collision>
      <geometry><sphere radius="1"/></geometry>
    </collision>

    <x:other><![CDATA[ <link name="none"> ]]></x:other>
  </link>
  <link name="b"><visual><geometry><sphere radius="1"/></geometry></visual></link>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
</robot>
<!-- the end -->
)";

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string with_crlf(const std::string& text) {
  std::string result;
  for (const char c : text) (result += c == '\n' ? "\r" : "") += c;
  return result;
}

std::string written(const std::string& text, const NewCollision& collision) {
  return with_collisions(read(text), {&collision, 1}, fs::current_path());
}

const std::string kNewCollision = R"(    <collision name="c">
      <!-- a comment -->
      <origin rpy='0 0 1'   xyz="1 2 3" />
      <geometry>
        <!-- <mesh filename="old.stl"/> -->
        <mesh filename="hull&amp;a.stl"/>
      </geometry>
      <x:vendor y="1>2"/>
    </collision>
)";

std::string old_collisions() {
  const std::size_t begin = kArm.find("    <collision name"), end = kArm.find("\n    <x:other>");
  return kArm.substr(begin, end - begin);
}

TEST(WriteUrdf, ChangesTheFirstCollisionAndRemovesOthers) {
  EXPECT_EQ(written(kArm, {0, Geometry::Visual, {"hull&a.stl"}, 0, {}, {}}),
            replaced(kArm, old_collisions(), kNewCollision));
}

TEST(WriteUrdf, KeepsLineEndsAndTheByteOrderMark) {
  const std::string crlf = "\xef\xbb\xbf" + with_crlf(kArm);
  EXPECT_EQ(written(crlf, {0, Geometry::Visual, {"hull&a.stl"}, 0, {}, {}}),
            replaced(crlf, with_crlf(old_collisions()), with_crlf(kNewCollision)));
}

TEST(WriteUrdf, ChangesNothingWithoutCollisions) {
  EXPECT_EQ(with_collisions(read(kArm), {}, fs::current_path()), kArm);
}

TEST(WriteUrdf, AddsKeptShapesWithTheirBytes) {
  const std::string box = R"(    <collision>
      <origin xyz="4 5 6"/>
      <geometry>
        <box size="1 1 1"/><!-- a box -->
      </geometry>
    </collision>
)";
  EXPECT_EQ(written(kArm, {0, Geometry::Visual, {"hull&a.stl"}, 0, {}, {1}}),
            replaced(kArm, old_collisions(), kNewCollision + box));
}

TEST(WriteUrdf, RemovesTheOriginWhereTheFrameIsThatOfTheLink) {
  const std::string before =
      "<robot name='r'>\n <link name='a'>\n  <collision>\n   <origin xyz='1 0 0'/>\n"
      "   <geometry><box size='1 1 1'/></geometry>\n  </collision>\n </link>\n</robot>\n";
  EXPECT_EQ(written(before, {0, Geometry::Collision, {"h.stl"}, std::nullopt, {}, {}}),
            replaced(replaced(before, "   <origin xyz='1 0 0'/>\n", ""), "<box size='1 1 1'/>",
                     "<mesh filename=\"h.stl\"/>"));
}

TEST(WriteUrdf, LeavesNoSecondOriginOrGeometry) {
  const std::string before =
      "<robot name='r'>\n <link name='a'>\n  <collision>\n   <origin xyz='0 0 0'/><origin xyz='1 0 0'/>\n"
      "   <geometry><box size='1 1 1'/></geometry>\n   <geometry><box size='2 2 2'/></geometry>\n"
      "   <origin xyz='2 0 0'/>\n  </collision>\n </link>\n</robot>\n";
  for (const std::optional<std::size_t> origin : {std::optional<std::size_t>(), std::optional<std::size_t>(0)}) {
    const std::string after = written(before, {0, Geometry::Collision, {"h.stl"}, origin, {}, {}});
    EXPECT_EQ(after.find("<origin xyz='0 0 0'/>") != after.npos, origin.has_value()) << after;
    for (const char* gone : {"<origin xyz='1 0 0'/>", "<origin xyz='2 0 0'/>", "<box"})
      EXPECT_EQ(after.find(gone), after.npos) << after;
  }
}

TEST(WriteUrdf, AddsCollisionsAfterTheLastVisual) {
  const std::string before =
      "<robot name='r'>\r\n\t<link name='a'>\r\n\t\t<visual>\r\n\t\t\t<origin xyz='1 0 0'/>\r\n"
      "\t\t\t<geometry><mesh filename='a'/></geometry>\r\n\t\t</visual>\r\n\t</link>\r\n</robot>";
  EXPECT_EQ(written(before, {0, Geometry::Visual, {"h.stl"}, 0, {}, {}}),
            replaced(before, "</visual>\r\n",
                     "</visual>\r\n\t\t<collision>\r\n\t\t\t<origin xyz='1 0 0'/>\r\n\t\t\t<geometry><mesh "
                     "filename=\"h.stl\"/></geometry>\r\n\t\t</collision>\r\n"));
}

TEST(WriteUrdf, WritesIntoOneLine) {
  const std::string visual = "<visual><origin xyz='1 0 0'/><geometry><box size='1 1 1'/></geometry></visual>";
  const std::string old = "<collision><geometry><box size='1 1 1'/></geometry></collision>";
  const auto robot = [](const std::string& inside) {
    return "<robot name='r'><link name='a'>" + inside + "</link></robot>";
  };
  const std::string hull =
      "<collision><origin xyz='1 0 0'/><geometry><mesh filename=\"h.stl\"/></geometry></collision>";
  const std::string box = "<collision><origin xyz='1 0 0'/><geometry><box size='1 1 1'/></geometry></collision>";
  const NewCollision both{0, Geometry::Visual, {"h.stl"}, 0, {}, {0}};
  EXPECT_EQ(written(robot(visual), both), robot(visual + hull + box));
  EXPECT_EQ(written(robot(visual + old + old + old), both), robot(visual + hull + box));
  EXPECT_EQ(written(robot(visual + old), {0, Geometry::Visual, {}, std::nullopt, {}, {0}}), robot(visual + box));
  EXPECT_EQ(written(robot(visual + old + old), {0, Geometry::Visual, {}, std::nullopt, {}, {}}), robot(visual));
}

TEST(WriteUrdf, WritesOneLineBelowAnother) {
  const std::string visual = " <visual><geometry><box size='1 1 1'/></geometry></visual>\n";
  const std::string before = "<robot name='r'><link name='a'>\n" + visual + "</link></robot>";
  EXPECT_EQ(
      written(before, {0, Geometry::Visual, {"h.stl"}, std::nullopt, {}, {}}),
      replaced(before, visual, visual + " <collision><geometry><mesh filename=\"h.stl\"/></geometry></collision>\n"));
}

TEST(WriteUrdf, LeavesKeptCollisionsWhereTheyAre) {
  const std::string mesh = "  <collision name='m'>\n   <geometry><mesh filename='a'/></geometry>\n  </collision>\n";
  const std::string box = "  <collision name='b'><!-- kept --><geometry><box size='1 1 1'/></geometry></collision>\n";
  const auto robot = [](const std::string& inside) {
    return "<robot name='r'>\n <link name='a'>\n" + inside + " </link>\n</robot>\n";
  };
  EXPECT_EQ(written(robot(box + mesh + mesh), {0, Geometry::Collision, {"h.stl"}, 1, {}, {0}}),
            robot(box + replaced(mesh, "<mesh filename='a'/>", "<mesh filename=\"h.stl\"/>")));
  EXPECT_EQ(written(robot(box), {0, Geometry::Collision, {}, std::nullopt, {}, {0}}), robot(box));
}

TEST(WriteUrdf, RelatesOtherMeshesToTheNewFolder) {
  const TemporaryFolder folder;
  for (const char* name : {"arm/a b.stl", "arm/b.stl", "arm/c.stl"}) write_file(folder / name);
  const std::string text =
      "<robot name='r'><link name='a'><visual><geometry><mesh scale='1 1 1'\n filename = 'a b.stl' />"
      "</geometry></visual><visual><geometry><mesh filename=\"package://arm/b.stl\"/></geometry>"
      "</visual><collision><geometry><mesh filename='b.stl'/></geometry></collision></link>"
      "<link name='b'><collision><geometry><mesh filename='none.stl'/></geometry></collision>"
      "<collision><geometry><mesh filename='c.stl'/></geometry></collision></link>"
      "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint></robot>";
  const RobotFile file = read_robot(text, folder / "arm/arm.urdf");
  const NewCollision collision{0, Geometry::Visual, {"meshes/a.stl"}, 0, {}, {0}};
  std::string expected = replaced(text, "'a b.stl'", "'../arm/a b.stl'");
  expected = replaced(expected, "<mesh filename='b.stl'/></geometry></collision>",
                      "<mesh filename=\"meshes/a.stl\"/></geometry></collision><collision><geometry><mesh scale='1 1 "
                      "1'\n filename = '../arm/a b.stl' /></geometry></collision>");
  expected = replaced(expected, "'c.stl'", "'../arm/c.stl'");
  EXPECT_EQ(with_collisions(file, {&collision, 1}, folder / "out"), expected);
  EXPECT_EQ(with_collisions(file, {}, folder / "arm"), text);
}

TEST(WriteUrdf, RelatesTexturesToTheNewFolder) {
  const TemporaryFolder folder;
  for (const char* name : {"arm/tex/a.png", "arm/tex/b.png", "arm/c.png", "arm/a.stl"}) write_file(folder / name);
  const std::string text =
      "<robot name='r'><material name='m'><texture filename='tex/a.png'/></material>"
      "<material name='n'><texture filename='package://arm/c.png'/></material>"
      "<material name='o'><texture filename='none.png'/><color rgba='0 0 0 1'/></material><material name='p'><texture/>"
      "</material><link name='a'><visual><geometry><mesh filename='a.stl'/></geometry><material name='q'>"
      "<texture filename=\"tex/b.png\"/></material></visual><collision><geometry><mesh filename='a.stl'/></geometry>"
      "</collision></link></robot>";
  const RobotFile file = read_robot(text, folder / "arm/arm.urdf");
  const NewCollision collision{0, Geometry::Visual, {"hull.stl"}, std::nullopt, {}, {}};
  std::string expected = replaced(text, "'tex/a.png'", "'../arm/tex/a.png'");
  expected = replaced(expected, "\"tex/b.png\"", "\"../arm/tex/b.png\"");
  expected = replaced(expected, "<collision><geometry><mesh filename='a.stl'/>",
                      "<collision><geometry><mesh filename=\"hull.stl\"/>");
  expected = replaced(expected, "'a.stl'", "'../arm/a.stl'");
  EXPECT_EQ(with_collisions(file, {&collision, 1}, folder / "out"), expected);
  EXPECT_EQ(with_collisions(file, {}, folder / "arm"), text);
}

TEST(WriteUrdf, RefusesLettersThatTheEncodingDoesNotHave) {
  const auto written_as = [](const std::string& encoding, const std::string& hull) {
    const std::string text = "<?xml version='1.0'" + encoding +
                             "?><robot name='m\xfc'><link name='a'><visual><geometry>"
                             "<box size='1 1 1'/></geometry></visual></link></robot>";
    const bool is_latin = has(encoding, "8859");
    const RobotFile file = read(is_latin ? text : replaced(text, "\xfc", "\xc3\xbc"));
    const NewCollision collision{0, Geometry::Visual, {hull}, std::nullopt, {}, {}};
    return with_collisions(file, {&collision, 1}, "");
  };
  const std::string latin = " encoding='ISO-8859-1'", hull = "h\xc3\xbcll.stl";
  EXPECT_EQ(refusal_of([&] { written_as(latin, hull); }),
            "arm.urdf: its text is ISO-8859-1, and what is written has letters beyond ASCII; save it as UTF-8");
  EXPECT_TRUE(has(written_as(latin, "hull.stl"), "name='m\xfc'"));
  for (const char* encoding : {"", " encoding='utf-8'", " encoding='UTF-8'"})
    EXPECT_TRUE(has(written_as(encoding, hull), hull)) << encoding;
}

/// What writing keeps: everything but collision elements and the bytes' positions.
std::string summary(const Robot& robot) {
  std::string text = robot.name;
  for (const Link& link : robot.links)
    text += "|" + link.name + std::to_string(link.visual.size()) + (link.visual.empty() ? "" : link.visual[0].name);
  for (const Joint& joint : robot.joints) text += "|" + joint.name + std::to_string(joint.parent);
  return text;
}

TEST(WriteUrdf, HoldsForDamagedFiles) {
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  int read_count = 0;
  for (int round = 0; round < rounds(20'000); ++round) {
    std::string text = round % 2 ? kArm : with_crlf(kArm);
    for (int damage = 0; damage <= round % 3; ++damage) {
      const std::size_t at = random() % text.size(), size = std::min<std::size_t>(random() % 40, text.size() - at);
      if (random() % 2)
        text.insert(random() % text.size(), text.substr(at, size));
      else
        text.erase(at, random() % 4);
    }
    RobotFile file;
    try {
      file = read(text);
    } catch (const InputError&) {
      continue;
    }
    ++read_count;
    std::vector<NewCollision> collisions;
    for (std::size_t link = 0; link < file.robot.links.size(); ++link)
      if (const std::size_t count = file.robot.links[link].visual.size(); count > 0)
        collisions.push_back({link,
                              Geometry::Visual,
                              {"h_01.stl", "h_02.stl"},
                              random() % count,
                              {{{0.1, -2e-7, 3}, 0.25}},
                              {random() % count}});
    const Robot again = read(with_collisions(file, collisions, fs::current_path())).robot;
    ASSERT_EQ(summary(again), summary(file.robot)) << text;
    for (const NewCollision& each : collisions) {
      const Link &now = again.links[each.link], &before = file.robot.links[each.link];
      ASSERT_EQ(now.collision.size(), 4U) << text;
      for (const std::size_t i : {0U, 1U}) {
        ASSERT_EQ(now.collision[i].mesh()->uri, each.hulls[i]) << text;
        ASSERT_EQ(now.collision[i].origin, before.visual[*each.same_origin_as].origin) << text;
      }
      ASSERT_EQ(std::get<SphereForm>(now.collision[2].form).radius, 0.25) << text;
      ASSERT_EQ(now.collision[2].origin, (Pose{.translation = {0.1, -2e-7, 3}})) << text;
      ASSERT_EQ(now.collision[3].form.index(), before.visual[each.kept[0]].form.index()) << text;
      ASSERT_EQ(now.collision[3].origin, before.visual[each.kept[0]].origin) << text;
    }
  }
  EXPECT_GT(read_count, rounds(20'000) / 100);
}

}  // namespace
}  // namespace prohull::robot::of_urdf
