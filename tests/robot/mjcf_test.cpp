#include "robot/files/mjcf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "prohull/error.h"
#include "robot/transform.h"
#include "robot_testing.h"

namespace prohull::robot::of_mjcf {
namespace {

constexpr double kPi = std::numbers::pi;

RobotFile read(const std::string& text, const std::filesystem::path& path = "arm.xml") {
  return read_mjcf(XmlDocument(text, path.string()), Packages(path, {}));
}

/// A document with sections before a body 'a' that has this content.
std::string with_body(const std::string& content, const std::string& sections = "") {
  return "<mujoco model='m'>\n" + sections + "<worldbody>\n<body name='a'>" + content +
         "</body>\n</worldbody>\n</mujoco>\n";
}

Shape shape_of(const std::string& geom, const std::string& sections = "") {
  return read(with_body(geom, sections)).robot.links.at(0).visual.at(0);
}

std::string message_of(const std::string& text) {
  return refusal_of([&] { read(text); });
}

std::string write(const std::string& text, const std::vector<NewCollision>& collisions,
                  const std::filesystem::path& path = "arm.xml", const std::filesystem::path& folder = ".") {
  const XmlDocument document(text, path.string());
  return mjcf_with_collisions(read_mjcf(document, Packages(path, {})), document, collisions, folder);
}

const std::string kHull = "meshes/500/a.stl";
const std::string kMesh = "<asset><mesh name='part' file='part.stl'/></asset>";

TEST(Mjcf, ReadsShapesFromHalfLengths) {
  EXPECT_EQ(std::get<BoxForm>(shape_of("<geom type='box' size='1 2 3'/>").form).size, (Vec3{2, 4, 6}));
  EXPECT_EQ(std::get<SphereForm>(shape_of("<geom size='2'/>").form).radius, 2);  // a geom is a sphere
  EXPECT_EQ(std::get<CylinderForm>(shape_of("<geom type='cylinder' size='1 2'/>").form).length, 4);
  EXPECT_EQ(std::get<CapsuleForm>(shape_of("<geom type='capsule' size='1 2 0'/>").form).length, 4);
  EXPECT_EQ(std::get<OtherForm>(shape_of("<geom type='ellipsoid' size='1 2 3'/>").form).what, "ellipsoid");
  EXPECT_EQ(read(with_body("\n<geom type='ellipsoid' size='1 2 3'/>")).notes.at(2),
            "line 4: the ellipsoid of body 'a' is not read");
  EXPECT_EQ(std::get<OtherForm>(shape_of("<geom type='box' mesh='part'/>", kMesh).form).what, "box fitted to a mesh");
}

TEST(Mjcf, SaysWhatMayMakeTheBodiesOfAModelWithout) {
  EXPECT_NE(message_of("<mujoco><worldbody>\n<replicate count='3'><body><geom size='1'/></body></replicate>"
                       "</worldbody></mujoco>")
                .find("the model has no <body>; line 2: <replicate> is not read, and neither is what it makes"),
            std::string::npos);
  const std::string bare = message_of("<mujoco><worldbody/></mujoco>");
  EXPECT_TRUE(bare.ends_with("the model has no <body>")) << bare;
}

TEST(Mjcf, ReadsFromto) {
  const Shape capsule = shape_of("<geom type='capsule' size='0.1' fromto='1 0 0  4 0 4'/>");
  EXPECT_EQ(std::get<CapsuleForm>(capsule.form).length, 5);
  expect_near(capsule.origin.translation, {2.5, 0, 2});
  expect_near(placed(capsule.origin, {0, 0, 2.5}), {1, 0, 0});  // MuJoCo's z axis points to the first end
  const Shape box = shape_of("<geom type='box' size='0.1' fromto='0 0 0  0 0 2'/>");
  EXPECT_EQ(std::get<BoxForm>(box.form).size, (Vec3{0.2, 0.2, 2}));
  expect_near(placed(box.origin, {1, 0, 0}), {1, 0, 1});  // half a turn about x
}

TEST(Mjcf, ReadsOrientationsInDegreesUnlessToldOtherwise) {
  const auto turned = [](const std::string& words, const std::string& compiler = "") {
    return placed(shape_of("<geom size='1' " + words + "/>", compiler).origin, {1, 2, 3});
  };
  const Vec3 quarter{-2, 1, 3};  // about z
  expect_near(turned("quat='1 0 0 1'"), quarter);
  expect_near(turned("axisangle='0 0 2 90'"), quarter);
  expect_near(turned("axisangle='0 0 2 1.5707963267948966'", "<compiler angle='radian'/>"), quarter);
  expect_near(turned("euler='0 0 90'"), quarter);
  expect_near(turned("xyaxes='0 2 0  -1 1 0'"), quarter);
  expect_near(turned("zaxis='0 0 3'"), {1, 2, 3});
  expect_near(turned("zaxis='1 0 0'"), {3, 2, -1});
  expect_near(turned("zaxis='0 0 -1'"), {1, -2, -3});
  // First about x, then about the new y: R = Rx Ry. In capitals the y axis stays: R = Ry Rx.
  expect_near(turned("euler='90 90 0'"), {3, 1, 2});
  expect_near(turned("euler='90 90 0'", "<compiler eulerseq='XYZ'/>"), {2, -3, -1});
}

TEST(Mjcf, ReadsMeshesByTheRulesOfTheCompiler) {
  const auto mesh = [](const std::string& sections) {
    return *shape_of("<geom type='mesh' mesh='part'/>", sections).mesh();
  };
  EXPECT_EQ(mesh("<asset><mesh file='sub/part.stl' scale='1 2 -3'/></asset>").scale, (Vec3{1, 2, -3}));
  EXPECT_EQ(mesh("<asset><mesh file='sub/part.stl'/></asset>").uri, "sub/part.stl");
  const auto why = [&](const std::string& compiler) {
    return mesh("<compiler " + compiler + "/><asset><mesh file='sub/part.stl'/></asset>").why_not;
  };
  EXPECT_NE(why("meshdir='m'").find("/m/sub/part.stl"), std::string::npos);
  EXPECT_NE(why("assetdir='n'").find("/n/sub/part.stl"), std::string::npos);
  EXPECT_NE(why("assetdir='n' meshdir='m'").find("/m/sub/part.stl"), std::string::npos);
  EXPECT_NE(why("meshdir='m' strippath='true'").find("/m/part.stl"), std::string::npos);
  EXPECT_NE(why("meshdir='/abs'").find(" /abs/sub/part.stl"), std::string::npos);
  EXPECT_EQ(std::get<OtherForm>(
                shape_of("<geom type='mesh' mesh='v'/>", "<asset><mesh name='v' vertex='0 0 0'/></asset>").form)
                .what,
            "mesh 'v', which has no file,");
}

TEST(Mjcf, WhatCollidesIsTheConvexHullOfAMesh) {
  const auto collision = [](const std::string& mesh, const std::string& sections = "") {
    return read(with_body("<geom type='mesh' mesh='m'/><geom type='mesh' mesh='m' contype='0' conaffinity='0'/>",
                          sections + "<asset><mesh name='m' file='m.obj' " + mesh + "/></asset>"));
  };
  const RobotFile file = collision("");
  EXPECT_TRUE(file.robot.fills_collision_meshes);
  EXPECT_TRUE(file.robot.links[0].collision[0].mesh()->is_filled);
  EXPECT_FALSE(file.robot.links[0].visual[0].mesh()->is_filled);
  EXPECT_EQ(file.notes.back(), "meshes that collide: 1; they count as their convex hulls, as in MuJoCo");
  EXPECT_TRUE(collision("maxhullvert='-1'").robot.links[0].collision[0].mesh());
  for (const RobotFile& cut :
       {collision("maxhullvert='8'"), collision("", "<default><mesh maxhullvert='8'/></default>")}) {
    EXPECT_EQ(cut.robot.links[0].collision[0].form, Form(OtherForm{"mesh whose convex hull maxhullvert cuts"}));
    EXPECT_EQ(cut.notes.back(), "line 3: the mesh whose convex hull maxhullvert cuts of body 'a' is not read");
  }
  const Link both =
      read(with_body("<geom type='mesh' mesh='m'/>", "<asset><mesh name='m' file='m.obj'/></asset>")).robot.links[0];
  EXPECT_TRUE(both.collision[0].mesh()->is_filled);
  EXPECT_FALSE(both.visual[0].mesh()->is_filled) << "what is seen is the mesh itself";
}

TEST(Mjcf, TellsHowFarFramesLead) {
  const auto way = [](const std::string& content) { return read(with_body(content)).robot.links[0].visual[0].way; };
  EXPECT_EQ(way("<geom size='1' pos='7 0 0'/>"), 0);
  EXPECT_EQ(way("<frame pos='1e9 0 0'><frame pos='-1e9 0 0'><geom size='1' pos='7 0 0'/></frame></frame>"), 2e9 + 7);
}

TEST(Mjcf, MovesMeshesToTheirReference) {
  // MuJoCo subtracts refpos, turns back by refquat, and scales.
  const Shape shape = shape_of("<geom type='mesh' mesh='part' pos='0 0 5'/>",
                               "<asset><mesh name='part' file='p.stl' refpos='1 0 0' refquat='1 0 0 1' scale='2 2 2'/>"
                               "</asset>");
  // The vertex (2, 1, 0): minus refpos (1, 1, 0), turned back by a quarter about z (1, -1, 0), scaled (2, -2, 0).
  expect_near(placed(shape.origin, Vec3{2, 1, 0} * 2), {2, -2, 5});
}

TEST(Mjcf, LooksUpDefaultClasses) {
  const std::string sections =
      "<default>\n<geom contype='0'/>\n<default class='visual'><geom conaffinity='0' type='box'/>"
      "<default class='small'><geom size='1 1 1'/></default></default>\n<geom rgba='1 1 1 1'/>"
      "<default class='big'><geom type='sphere' size='9'/></default></default>";
  const Robot robot = read("<mujoco>" + sections +
                           "<worldbody><body name='a' childclass='small'><geom/><geom class='big'/>"
                           "<body name='b'><geom/><frame childclass='big'><geom/></frame></body>"
                           "<body name='c' childclass='big'><geom/></body></body></worldbody></mujoco>")
                          .robot;
  ASSERT_EQ(robot.links.size(), 3U);
  ASSERT_EQ(robot.links[0].visual.size(), 1U);  // small: a box that is only seen
  EXPECT_EQ(std::get<BoxForm>(robot.links[0].visual[0].form).size, (Vec3{2, 2, 2}));
  ASSERT_EQ(robot.links[0].collision.size(), 1U);  // big: its conaffinity is 1
  EXPECT_EQ(std::get<SphereForm>(robot.links[0].collision[0].form).radius, 9);
  EXPECT_EQ(robot.links[1].visual.size(), 1U);  // a body inherits the childclass
  EXPECT_EQ(robot.links[1].collision.size(), 1U);
  EXPECT_EQ(robot.links[2].collision.size(), 1U);
}

TEST(Mjcf, GeomsOfABodyWithoutVisualOnesAreBoth) {
  const RobotFile file = read(with_body("<geom size='1'/><geom size='2'/><inertial pos='0 0 0' mass='1'/>"));
  EXPECT_EQ(file.robot.links[0].visual.size(), 2U);
  EXPECT_EQ(file.robot.links[0].collision.size(), 2U);
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_NE(file.notes[0].find("only geoms that collide: 1"), std::string::npos);
  const RobotFile pair =
      read(with_body("<geom size='1' contype='0' conaffinity='0'/>"
                     "<geom name='g' size='2' contype='0' conaffinity='0'/>",
                     "<contact><pair geom1='g' geom2='h'/></contact>"));
  EXPECT_EQ(pair.robot.links[0].visual.size(), 1U);
  EXPECT_EQ(pair.robot.links[0].collision.size(), 1U);  // a pair collides in any case
}

TEST(Mjcf, ReadsJoints) {
  const Robot robot = read(with_body("<freejoint/><body name='b' pos='1 2 3' euler='0 0 90'>"
                                     "<joint name='j' pos='0 1 0' axis='0 0 -2' range='-90 180'/>"
                                     "<joint name='k' type='slide' axis='1 0 0' range='-1 2' ref='0.5'/>"
                                     "<body name='c'><joint type='ball'/><body name='d'/></body></body>"
                                     "<body name='e'><joint name='l' range='1 2' limited='false'/></body>"))
                          .robot;
  ASSERT_EQ(robot.links.size(), 5U);  // the free joint leads to the world
  ASSERT_EQ(robot.joints.size(), 5U);
  const auto joint = [&](const std::string& name) {
    for (const Joint& it : robot.joints)
      if (it.name == name) return it;
    ADD_FAILURE() << name;
    return Joint{};
  };
  const Joint j = joint("j"), k = joint("k");
  EXPECT_EQ(j.type, JointType::Revolute);
  EXPECT_EQ(j.origin.translation, (Vec3{1, 2, 3}));
  expect_near(placed(j.origin, {1, 0, 0}), {1, 3, 3});
  EXPECT_EQ(j.anchor, (Vec3{0, 1, 0}));
  EXPECT_EQ(j.axis, (Vec3{0, 0, -1}));
  EXPECT_DOUBLE_EQ(j.lower, -kPi / 2);
  EXPECT_DOUBLE_EQ(j.upper, kPi);
  EXPECT_EQ(k.type, JointType::Prismatic);
  EXPECT_EQ(k.rest, 0.5);
  EXPECT_EQ(k.origin.translation, (Vec3{-0.5, 0, 0})) << "the body stands where the joint is at its ref";
  EXPECT_EQ(k.child, j.child);
  EXPECT_EQ(k.lower, -1);
  EXPECT_EQ(k.upper, 2);
  EXPECT_EQ(joint("d_weld").type, JointType::Fixed);
  EXPECT_EQ(joint("l").type, JointType::Continuous);
}

TEST(Mjcf, LimitsAreAutomaticOnlyWithAutolimits) {
  const auto type = [](const std::string& compiler) {
    return read(with_body("<body name='b'><joint range='-1 1'/></body>", compiler)).robot.joints[0].type;
  };
  EXPECT_EQ(type(""), JointType::Revolute);
  EXPECT_EQ(type("<compiler autolimits='false'/>"), JointType::Continuous);
  EXPECT_EQ(type("<default><joint limited='true'/></default><compiler autolimits='false'/>"), JointType::Revolute);
}

TEST(Mjcf, ReadsFrames) {
  const Robot robot = read(with_body("<frame pos='0 0 1' euler='0 0 90'><geom size='1' pos='1 0 0'/>"
                                     "<frame pos='2 0 0'><body name='b' pos='1 0 0'><frame euler='90 0 0'>"
                                     "<joint pos='0 1 0' axis='0 1 0'/></frame></body></frame></frame>"))
                          .robot;
  expect_near(robot.links[0].visual[0].origin.translation, {0, 1, 1});
  expect_near(robot.joints[0].origin.translation, {0, 3, 1});
  expect_near(robot.joints[0].anchor, {0, 0, 1});
  expect_near(robot.joints[0].axis, {0, 0, 1});
}

TEST(Mjcf, NotesWhatEqualityHoldsTogether) {
  const auto notes = [](const std::string& equality) {
    return read(
               "<mujoco><worldbody><body name='a'><geom size='1'/><inertial pos='0 0 0' mass='1'/><body "
               "name='b'><joint/>"
               "<geom size='1'/><inertial pos='0 0 0' mass='1'/></body></body></worldbody><equality>" +
               equality + "</equality></mujoco>")
        .notes;
  };
  const std::size_t before = notes("<weld body1='a' body2='b' active='false'/>").size();
  EXPECT_EQ(before, notes("").size());
  ASSERT_EQ(notes("<connect body1='a' body2='b' anchor='0 0 0'/>").size(), before + 1);
  EXPECT_TRUE(has(notes("<weld body1='a' body2='b'/>").at(1), "what <weld> of <equality> holds together is not read"));
}

TEST(Mjcf, JointsFollowOthersByEquality) {
  const RobotFile file = read(
      "<mujoco><worldbody><body name='a'><body name='b'><joint name='j'/></body><body name='c'><joint name='k'/></body>"
      "<body name='d'><joint name='l'/></body><body name='e'><joint name='m'/></body></body></worldbody>"
      "<equality><joint joint1='k' joint2='j' polycoef='0.5 -2'/><joint joint1='l' joint2='j' polycoef='0 0 1'/>"
      "<joint joint1='m' polycoef='0.25'/><joint joint1='j' joint2='k' active='false'/></equality></mujoco>");
  const std::vector<Joint>& joints = file.robot.joints;
  ASSERT_EQ(joints.size(), 4U);
  ASSERT_TRUE(joints[1].mimic);
  EXPECT_EQ(joints[1].mimic->joint, 0U);
  EXPECT_EQ(joints[1].mimic->multiplier, -2);
  EXPECT_EQ(joints[1].mimic->offset, 0.5);
  EXPECT_FALSE(joints[2].mimic);
  EXPECT_NE(file.notes.at(0).find("'l'"), std::string::npos);
  EXPECT_EQ(joints[3].lower, 0.25);
  EXPECT_EQ(joints[3].upper, 0.25);
}

TEST(Mjcf, EqualitiesAreActiveAsTheirDefaultsSay) {
  const auto follows = [](const std::string& equality) {
    return read(
               "<mujoco><default><joint active='true'/><equality active='false'/><default class='on'><equality "
               "active='true'/></default></default><worldbody><body name='a'><body name='b'><joint name='j'/></body>"
               "<body name='c'><joint name='k'/></body></body></worldbody><equality><joint joint1='k' joint2='j' " +
               equality + "/></equality></mujoco>")
        .robot.joints.at(1)
        .mimic.has_value();
  };
  EXPECT_FALSE(follows(""));
  EXPECT_TRUE(follows("active='true'"));
  EXPECT_TRUE(follows("class='on'"));
  EXPECT_FALSE(follows("class='on' active='false'"));
}

TEST(Mjcf, JointsThatFollowCountFromTheirRefs) {
  const RobotFile file = read(
      "<mujoco><compiler angle='radian'/><default><joint ref='0.5'/></default><worldbody><body name='a'><body name='b'>"
      "<joint name='j'/></body><body name='c'><joint name='k' ref='2'/></body><body name='d'><joint name='m'/></body>"
      "</body></worldbody><equality><joint joint1='k' joint2='j' polycoef='0.25 -2'/>"
      "<joint joint1='m' polycoef='0.25'/></equality></mujoco>");
  EXPECT_EQ(file.robot.joints.at(1).mimic.value().offset, 2 + 0.25 + 2 * 0.5);
  EXPECT_EQ(file.robot.joints.at(2).lower, 0.75);
}

TEST(Mjcf, BodiesOfOneWorldStandWhereTheyStand) {
  const RobotFile file = read(
      "<mujoco><worldbody><geom type='plane' size='1 1 1'/><body name='a'><freejoint/></body>"
      "<body pos='0 5 0'><composite/></body></worldbody></mujoco>");
  ASSERT_EQ(file.robot.links.size(), 3U);
  EXPECT_EQ(file.robot.links[1].name, "body_1");
  EXPECT_EQ(file.robot.links[2].name, "world");
  ASSERT_EQ(file.robot.joints.size(), 2U);
  EXPECT_EQ(file.robot.joints[0].type, JointType::Floating);
  EXPECT_EQ(file.robot.joints[1].type, JointType::Fixed);
  EXPECT_EQ(file.robot.joints[1].parent, 2U);
  EXPECT_EQ(file.robot.joints[1].origin, translation_by({0, 5, 0}));
  ASSERT_EQ(file.notes.size(), 2U);
  EXPECT_NE(file.notes[0].find("<composite>"), std::string::npos);
  EXPECT_NE(file.notes[1].find("geoms of the world are not read: 1"), std::string::npos);
}

TEST(Mjcf, BodiesOfMotionCaptureFloat) {
  const Robot robot = read(
                          "<mujoco><worldbody><body name='a'><geom size='1'/></body><body name='b' mocap='true' "
                          "pos='0 5 0'/><body name='c' mocap='false'/></worldbody></mujoco>")
                          .robot;
  ASSERT_EQ(robot.joints.size(), 3U);
  EXPECT_EQ(robot.joints[0].name, "b_mocap");
  EXPECT_EQ(robot.joints[0].type, JointType::Floating);
  EXPECT_EQ(robot.joints[0].origin, translation_by({0, 5, 0}));
  EXPECT_EQ(robot.joints[1].type, JointType::Fixed);
  EXPECT_EQ(robot.joints[2].type, JointType::Fixed);
}

TEST(Mjcf, AJointThatMovesTheOnlyTreeInTheWorldIsKept) {
  const Robot robot = read(with_body("<joint name='x' type='slide' range='-2 2'/><joint name='y'/>")).robot;
  ASSERT_EQ(robot.links.size(), 2U);
  EXPECT_EQ(robot.links[1].name, "world");
  ASSERT_EQ(robot.joints.size(), 2U);
  EXPECT_EQ(robot.joints[0].name, "x");
  EXPECT_EQ(robot.joints[0].parent, 1U);
  EXPECT_EQ(robot.joints[0].child, 0U);
  EXPECT_EQ(robot.joints[1].name, "y");
}

TEST(Mjcf, RefusesWithTheLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {with_body("<body name='a'/>"), "line 3: there is a second <body> called 'a'"},
      {with_body("<body name='world'/>"), "reserves"},
      {with_body("<geom type='box' size='1 0 1'/>"), "more than 0"},
      {with_body("<geom type='box' size='1 1'/>"), "2 numbers, expected 3"},
      {with_body("<geom type='box'/>"), "no size"},
      {with_body("<geom type='x' size='1'/>"), "unknown type 'x'"},
      {with_body("<geom class='x' size='1'/>"), "class 'x'"},
      {with_body("<geom type='mesh' mesh='x'/>"), "mesh 'x'"},
      {with_body("<geom type='mesh'/>"), "names no mesh"},
      {with_body("<geom size='1' pos='0 nan 0'/>"), "'nan'"},
      {with_body("<geom size='1' pos='0 1e50 0'/>"), "too large"},
      {with_body("<geom size='1' quat='0 0 0 0'/>"), "length 0"},
      {with_body("<geom size='1' xyaxes='1 0 0 2 0 0'/>"), "length 0"},
      {with_body("<geom type='capsule' size='1' fromto='1 1 1 1 1 1'/>"), "length 0"},
      {with_body("<geom size='1' axisangle='1 0 0 90'/>", "<default><geom euler='0 0 90'/></default>"),
       "has euler from its default class beside another orientation"},
      {with_body("<joint axis='0 0 0'/>"), "length 0"},
      {with_body("<joint limited='true'/>"), "is limited"},
      {with_body("<joint name='j'/><joint name='j'/>"), "second joint called 'j'"},
      {with_body("", "<asset><mesh file='a.stl'/><mesh name='a'/></asset>"), "second mesh called 'a'"},
      {with_body("", "<asset><mesh/></asset>"), "neither a name nor a file"},
      {with_body("<geom type='mesh' mesh='a'/>", "<asset><mesh file='a.stl' scale='1 0 1'/></asset>"), "scale of 0"},
      {with_body("", "<default><default class='c'/><default class='c'/></default>"), "second class 'c'"},
      {with_body("", "<compiler coordinate='global'/>"), "global"},
      {with_body("", "<compiler eulerseq='xy'/>"), "eulerseq"},
      {with_body("", "<compiler angle='grad'/>"), "degree or radian"},
      {with_body("", "<equality><joint joint1='x'/></equality>"), "joint 'x'"},
      {with_body("<body name='b'><joint name='j'/></body>", "<equality><joint joint1='j' joint2='j'/></equality>"),
       "follows itself"},
      {"<mujoco><worldbody/></mujoco>", "no <body>"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string message = message_of(text);
    EXPECT_TRUE(message.starts_with("arm.xml: line ")) << text << ": " << message;
    EXPECT_NE(message.find(expected), std::string::npos) << text << ": " << message;
  }
}

class MjcfIncludes : public testing::Test {
 protected:
  MjcfIncludes() {
    write_file(folder_ / "robot/arm.xml",
               "<mujoco>\n<include file='parts/assets.xml'/>\n<worldbody>\n"
               "<body name='a'><include file='parts/chain.xml'/></body><body name='z'/></worldbody></mujoco>");
    write_file(folder_ / "robot/parts/assets.xml",
               "<mujocoinclude>\n<compiler meshdir='parts'/><asset><mesh file='x.stl'/></asset></mujocoinclude>");
    write_file(folder_ / "robot/parts/x.stl");
    write_file(folder_ / "robot/parts/chain.xml",
               "<?xml version='1.0'?>\n<mujocoinclude>\n<geom type='mesh' mesh='x'/>\n"
               "<body name='b'>\n<include file='tip.xml'/></body></mujocoinclude>");
    write_file(folder_ / "robot/parts/tip.xml", "<mujoco><body name='c'>\n<geom size='1'/></body></mujoco>");
  }

  RobotFile read_arm(const FileOptions& options = {}) const { return read_robot(folder_ / "robot/arm.xml", options); }
  std::string refusal(const std::string& tip, Defect defect = Defect::Malformed) const {
    write_file(folder_ / "robot/parts/tip.xml", tip);
    return refusal_of([&] { read_arm({.package_paths = {}, .no_outside_files = true}); }, defect);
  }

  TemporaryFolder folder_;
};

TEST_F(MjcfIncludes, StandInThePlaceOfTheElement) {
  const RobotFile file = read_arm({.package_paths = {}, .no_outside_files = true});
  std::vector<std::string> names;
  for (const Link& link : file.robot.links) names.push_back(link.name);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "b", "c", "z", "world"}));
  EXPECT_EQ(file.robot.links[0].visual.at(0).mesh()->path, folder_ / "robot/parts/x.stl");
  EXPECT_EQ(file.robot.links[2].line, 1U) << "of its own file";
  EXPECT_EQ(file.robot.links[3].line, 4U);
  const std::string written = with_collisions(file, {{hull_of(kHull, 2)}}, folder_ / "robot");
  EXPECT_FALSE(has(written, "include")) << written;
  write_file(folder_ / "robot/written.xml", written);
  EXPECT_EQ(read_robot(folder_ / "robot/written.xml").robot.links.size(), 5U);
}

TEST_F(MjcfIncludes, AreRefusedWithTheirLines) {
  const std::string tip = (folder_ / "robot/parts/tip.xml").string();
  EXPECT_TRUE(has(refusal("<mujocoinclude>\n\n<body name='a'/></mujocoinclude>"),
                  tip + ": line 3: there is a second <body> called 'a'"));
  EXPECT_TRUE(has(refusal("<mujocoinclude>\n<include file='chain.xml'/></mujocoinclude>"),
                  tip + ": line 2: <include> names 'chain.xml' a second time"));
  EXPECT_TRUE(has(refusal("<mujocoinclude>\n<include file='none.xml'/></mujocoinclude>", Defect::CannotRead),
                  tip + ": line 2: <include> names 'none.xml'"));
  EXPECT_TRUE(has(refusal("<robot/>"), "chain.xml: line 5: <include> names 'tip.xml', whose root is <robot>"));
  EXPECT_TRUE(has(refusal("<mujocoinclude><body>"), tip + ": line 1: no XML"));
  EXPECT_TRUE(has(refusal("<?xml version='1.0' encoding='latin1'?><mujocoinclude>\xe9</mujocoinclude>"), "encoding"));
  write_file(folder_ / "robot/../outside.xml", "<mujocoinclude/>");
  EXPECT_TRUE(
      has(refusal("<mujoco><include file='../outside.xml'/></mujoco>", Defect::CannotRead), "--no-outside-files"));
}

TEST(Mjcf, ReadsManyBodiesQuickly) {
  std::string bodies;
  for (int i = 0; i < 20'000; ++i)
    bodies +=
        "<body name='b" + std::to_string(i) + "'><joint name='j" + std::to_string(i) + "'/><geom size='1'/></body>\n";
  EXPECT_EQ(read(with_body(bodies)).robot.joints.size(), 20'000U);
}

TEST(MjcfWithCollisions, TheHullTakesThePlaceOfTheFirstGeomThatCollides) {
  const std::string text =
      "<!-- head -->\r\n<mujoco model=\"m\">\r\n  <compiler meshdir=\"assets\"/>\r\n"
      "  <default><mesh scale=\"0.001 0.001 0.001\"/></default>\r\n"
      "  <asset>\r\n    <mesh name=\"part\" file=\"part.stl\"/>\r\n  </asset>\r\n"
      "  <worldbody>\r\n    <body name=\"a\">\r\n"
      "      <geom type=\"mesh\" mesh=\"part\" contype=\"0\" conaffinity=\"0\" pos=\"1 2 3\" euler=\"0 0 90\"/>\r\n"
      "      <geom name=\"c\" type=\"box\" size=\"1 1 1\" friction=\"0.5\" pos=\"9 9 9\"/>\r\n"
      "      <!-- kept -->\r\n"
      "      <geom name=\"d\" type=\"sphere\" size=\"1\"/>\r\n"
      "      <site unknown = 'x'/>\r\n"
      "    </body>\r\n  </worldbody>\r\n"
      "  <contact><pair geom1=\"d\" geom2=\"c\"/></contact>\r\n</mujoco>\r\n";
  const std::string expected =
      "<!-- head -->\r\n<mujoco model=\"m\">\r\n  <compiler/>\r\n"
      "  <default><mesh scale=\"0.001 0.001 0.001\"/></default>\r\n"
      "  <asset>\r\n    <mesh name=\"part\" file=\"assets/part.stl\"/>\r\n"
      "    <mesh name=\"a_hull\" file=\"meshes/500/a.stl\" scale=\"1 1 1\"/>\r\n  </asset>\r\n"
      "  <worldbody>\r\n    <body name=\"a\">\r\n"
      "      <geom type=\"mesh\" mesh=\"part\" contype=\"0\" conaffinity=\"0\" pos=\"1 2 3\" euler=\"0 0 90\"/>\r\n"
      "      <geom name=\"c\" friction=\"0.5\" type=\"mesh\" mesh=\"a_hull\" pos=\"1 2 3\" euler=\"0 0 90\"/>\r\n"
      "      <!-- kept -->\r\n"
      "      <site unknown = 'x'/>\r\n"
      "    </body>\r\n  </worldbody>\r\n"
      "  <contact><pair geom1=\"c\" geom2=\"c\"/></contact>\r\n</mujoco>\r\n";
  EXPECT_EQ(write(text, {hull_of(kHull, 0, 0)}), expected);
  EXPECT_EQ(write(text, {}), text);
}

TEST(MjcfWithCollisions, GeomsThatWereBothStayToBeSeen) {
  const std::string text = with_body(
      "\n  <geom name='g' type='mesh' mesh='part' pos='1 0 0' mass='2' friction='1'/>\n"
      "  <geom type='box' size='1 1 1' contype='3'  />\n  <inertial mass='1' pos='0 0 0'/>\n",
      kMesh);
  const std::string result = write(text, {hull_of(kHull, 0, 0, {1})});
  EXPECT_NE(result.find("  <geom type='mesh' mesh='part' pos='1 0 0' mass='2' friction='1' contype=\"0\" "
                        "conaffinity=\"0\"/>\n"
                        "  <geom name=\"g\" friction=\"1\" mass=\"0\" type=\"mesh\" mesh=\"a_hull\" pos=\"1 0 0\"/>\n"
                        "  <geom type='box' size='1 1 1' contype='3'  />\n"),
            std::string::npos)
      << result;
  const Link link = read(result).robot.links[0];
  ASSERT_EQ(link.visual.size(), 1U);
  ASSERT_EQ(link.collision.size(), 2U);
  EXPECT_EQ(link.collision[0].mesh()->uri, "meshes/500/a.stl");
  EXPECT_EQ(link.collision[0].origin, translation_by({1, 0, 0}));
}

TEST(MjcfWithCollisions, WhatNamesAGeomNamesItsHull) {
  // The second geom collides by its pair whatever its contype is: the pair has to name the hull.
  const std::string text =
      with_body("<geom type='mesh' mesh='part'/><geom name='g' type='mesh' mesh='part'/>",
                kMesh +
                    "<contact><pair geom1='g' geom2='floor'/></contact><sensor><framepos objtype='geom' objname='g'/>"
                    "</sensor><sensor><framepos objtype='body' objname='g'/></sensor>");
  const std::string result = write(text, {hull_of(kHull, 0, 0)});
  const Link link = read(result).robot.links[0];
  EXPECT_EQ(link.visual.size(), 2U);
  ASSERT_EQ(link.collision.size(), 1U) << result;
  EXPECT_EQ(link.collision[0].name, "a_hull");
  EXPECT_NE(result.find("<pair geom1='a_hull' geom2='floor'/>"), std::string::npos);
  EXPECT_NE(result.find("objtype='geom' objname='a_hull'"), std::string::npos);
  EXPECT_NE(result.find("objtype='body' objname='g'"), std::string::npos);
}

NewCollision two_pieces(std::size_t link, std::optional<std::size_t> same_origin_as = {}) {
  NewCollision collision = hull_of(kHull, link, same_origin_as);
  collision.hulls = {"meshes/a_01.stl", "meshes/a_02.stl"};
  return collision;
}

TEST(MjcfWithCollisions, TakesSeveralPieces) {
  const std::string visual = "<geom type='mesh' mesh='part' pos='1 2 3' contype='0' conaffinity='0'/>";
  for (const std::string& old : {std::string(), std::string("\n  <geom name='g' size='1' mass='3'/>"),
                                 std::string("\n  <geom size='1' mass='3'/>\n  <geom size='2'/>")})
    for (const std::optional<std::size_t> same : {std::optional<std::size_t>(), std::optional<std::size_t>(0)}) {
      const std::string result = write(with_body(visual + old, kMesh), {two_pieces(0, same)});
      const Link link = read(result).robot.links[0];
      EXPECT_EQ(link.visual.size(), 1U) << result;
      ASSERT_EQ(link.collision.size(), 2U) << result;
      EXPECT_NE(link.collision[0].mesh()->uri, link.collision[1].mesh()->uri);
      for (const Shape& shape : link.collision)
        EXPECT_EQ(shape.origin, same ? translation_by({1, 2, 3}) : Pose{}) << result;
      const std::size_t first = result.find("mass=\"1.5\"");  // half of what the old geom weighs
      EXPECT_EQ(result.find("mass=\"1.5\"", first + 1) == std::string::npos, old.empty()) << result;
    }
}

TEST(MjcfWithCollisions, TakesSpheres) {
  NewCollision collision = hull_of(kHull, 0);
  collision.hulls.clear();
  collision.balls = {{{0.1, -2e-7, 3}, 0.25}, {{}, 0.5}};
  // A class that sets poses must not move them.
  const std::string sections = kMesh + "<default><geom pos='3 3 3' quat='1 1 1 1'/></default>";
  const std::string result = write(with_body("<geom type='mesh' mesh='part' contype='0' conaffinity='0'/>"
                                             "<geom size='1'/>",
                                             sections),
                                   {collision});
  const Link link = read(result).robot.links[0];
  ASSERT_EQ(link.collision.size(), 2U) << result;
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_EQ(std::get<SphereForm>(link.collision[i].form).radius, collision.balls[i].radius);
    EXPECT_EQ(link.collision[i].origin, translation_by(collision.balls[i].center)) << result;
  }
}

TEST(MjcfWithCollisions, APairThatMayTouchIsOneForEachPiece) {
  const std::string text =
      with_body("<geom type='mesh' mesh='part' contype='0' conaffinity='0'/><geom name='g' type='mesh' mesh='part'/>",
                kMesh +
                    "<contact>\n  <pair name='p' geom1='g' geom2='floor' condim='1'/>\n</contact>"
                    "<sensor><framepos objtype='geom' objname='g'/></sensor>");
  const std::string result = write(text, {two_pieces(0)});
  EXPECT_NE(result.find("\n  <pair name='p' geom1='g' geom2='floor' condim='1'/>\n"
                        "  <pair geom1=\"a_hull\" geom2=\"floor\" condim=\"1\"/>\n</contact>"),
            std::string::npos)
      << result;
  EXPECT_EQ(read(result).robot.links[0].collision.size(), 2U);
}

TEST(MjcfWithCollisions, KeepsThePoseOfWhatIsEnclosed) {
  // In frames, with a reference of the mesh, and with classes that set poses: the hull is where the mesh is.
  const std::string plain_sections =
      "<default><default class='c'><geom pos='7 7 7' euler='0 90 0' friction='2'/></default>"
      "<default class='v'><geom contype='0' conaffinity='0' quat='1 2 3 4' type='mesh' "
      "mesh='part'/></default></default>"
      "<asset>\n  <mesh name='part' file='part.stl' refpos='1 2 3' refquat='0 1 0 1'/>\n</asset>";
  const std::string moving = "<default><geom pos='3 3 3' quat='1 1 1 1'/></default>";
  const std::string in_frame = "<frame pos='1 2 3' euler='10 20 30'><geom class='v' pos='1 1 1'/></frame>";
  for (const std::string& visual : {std::string("<geom class='v'/>"), in_frame})
    for (const std::string& colliding :
         {std::string(), std::string("<geom class='c' size='1'/>"),
          std::string("<frame childclass='c'><geom size='1'/></frame>"),
          std::string("<frame childclass='c' pos='1 1 1'><geom class='main' size='1'/></frame>")}) {
      for (const std::string& sections : {plain_sections, moving + plain_sections}) {
        const std::string text = with_body(visual + colliding, sections);
        const Link before = read(text).robot.links[0];
        const std::string result = write(text, {hull_of(kHull, 0, 0)});
        const Link after = read(result).robot.links[0];
        ASSERT_EQ(after.visual.size(), 1U) << result;
        ASSERT_EQ(after.collision.size(), 1U) << result;
        EXPECT_EQ(after.collision[0].origin, before.visual[0].origin) << result;
        EXPECT_EQ(after.collision[0].mesh()->scale, (Vec3{1, 1, 1}));
        EXPECT_EQ(after.collision[0].mesh()->uri, "meshes/500/a.stl");
        // In the frame of the link.
        const std::string plain = write(text, {hull_of(kHull, 0)});
        expect_near(read(plain).robot.links[0].collision.at(0).origin, Pose{});
      }
    }
}

TEST(MjcfWithCollisions, PrimitivesThatAreKeptBecomeGeomsThatCollide) {
  const std::string text = with_body(
      "\n<geom type='box' size='1 2 3' pos='1 0 0' contype='0' conaffinity='0'/>\n"
      "<geom type='mesh' mesh='part' contype='0' conaffinity='0'/>\n<geom name='c' size='5' solref='1 1'/>\n",
      kMesh);
  const std::string result = write(text, {hull_of(kHull, 0, 1, {0})});
  const Link link = read(result).robot.links[0];
  ASSERT_EQ(link.visual.size(), 2U);
  ASSERT_EQ(link.collision.size(), 2U);
  const auto box = std::ranges::find_if(link.collision, [](const Shape& shape) { return !shape.mesh(); });
  ASSERT_NE(box, link.collision.end());
  EXPECT_EQ(std::get<BoxForm>(box->form).size, (Vec3{2, 4, 6}));
  EXPECT_EQ(box->origin, translation_by({1, 0, 0}));
  EXPECT_NE(result.find("solref=\"1 1\" type=\"box\""), std::string::npos);
  // From the collision geometry: what is kept is not touched.
  NewCollision kept = hull_of(kHull, 0, {}, {0});
  kept.hulls.clear(), kept.from = Geometry::Collision;
  EXPECT_EQ(write(text, {kept}), text);
}

TEST(MjcfWithCollisions, PrimitivesThatAreKeptAreNotFittedToTheMeshOfAClass) {
  const std::string classes =
      "<default><default class='col'><geom type='mesh' mesh='part' group='3'/></default><default class='vis'><geom "
      "contype='0' conaffinity='0'/></default></default>";
  const std::string visual = "<geom class='vis' size='1'/><geom class='vis' type='mesh' mesh='part' pos='1 0 0'/>";
  for (const char* const colliding : {"<geom class='col'/>", "<frame childclass='col'><geom/></frame>"}) {
    NewCollision collision = hull_of(kHull, 0, 1, {0});
    collision.balls = {{{1, 2, 3}, 4}};
    const std::string result = write(with_body(visual + colliding, classes + kMesh), {collision});
    const std::vector<Shape> shapes = read(result).robot.links[0].collision;
    ASSERT_EQ(shapes.size(), 3U) << result;
    for (const Form& wanted : {Form{SphereForm{1}}, Form{SphereForm{4}}, Form{MeshFile{.uri = kHull}}})
      EXPECT_EQ(std::ranges::count(shapes, wanted, &Shape::form), 1) << result;
    EXPECT_NE(result.find("group=\"3\" size=\"1\" type=\"sphere\""), std::string::npos) << result;
  }
}

TEST(MjcfWithCollisions, RelativePathsStillFindTheirFiles) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "prohull_mjcf_test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder / "in" / "assets");
  std::filesystem::create_directories(folder / "out" / "meshes" / "500");
  for (const char* name : {"in/assets/part.stl", "in/assets/wood.png", "out/meshes/500/a.stl"})
    std::ofstream(folder / name) << "x";
  for (const std::string& compiler :
       {std::string("meshdir='assets' texturedir='assets'"), std::string("assetdir='assets' strippath='true'")}) {
    const std::string text =
        with_body("<geom type='mesh' mesh='part' contype='0' conaffinity='0'/><geom size='1'/>",
                  "<compiler " + compiler + "/><asset><mesh file='part.stl'/><texture file='wood.png'/></asset>\n");
    const std::string result = write(text, {hull_of(kHull, 0)}, folder / "in" / "arm.xml", folder / "out");
    const Link link = read(result, folder / "out" / "arm.xml").robot.links[0];
    EXPECT_EQ(link.visual.at(0).mesh()->path, folder / "in" / "assets" / "part.stl") << result;
    EXPECT_EQ(link.collision.at(0).mesh()->path, folder / "out" / "meshes" / "500" / "a.stl") << result;
    EXPECT_NE(result.find("<texture file='../in/assets/wood.png'/>"), std::string::npos) << result;
    EXPECT_EQ(result.find("dir="), std::string::npos) << result;  // MuJoCo would open out/assets/../../in/assets
  }
  std::filesystem::remove_all(folder);
}

TEST(MjcfWithCollisions, RefusesHullsThatMujocoCannotRead) {
  NewCollision collision = hull_of(kHull, 0);
  for (const char* hull : {"a.glb", "package://arm/a.stl"}) {
    collision.hulls = {hull};
    EXPECT_THROW(write(with_body("<geom size='1'/>"), {collision}), InputError);
  }
}

}  // namespace
}  // namespace prohull::robot::of_mjcf
