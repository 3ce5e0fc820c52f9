#include "robot/files/sdf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "prohull/error.h"
#include "robot/transform.h"
#include "robot_testing.h"

namespace prohull::robot {
namespace {

RobotFile read(const std::string& text, const std::filesystem::path& path = "arm.sdf") {
  return read_sdf(XmlDocument(text, path.string()), Packages(path, {}));
}

std::string in_model(const std::string& content, const std::string& version = "1.9") {
  return "<sdf version='" + version + "'>\n<model name='m'>\n" + content + "</model>\n</sdf>\n";
}

std::string message_of(const std::string& text) {
  return refusal_of([&] { read(text); });
}

std::string write(const std::string& text, const std::vector<NewCollision>& collisions,
                  const std::filesystem::path& path = "arm.sdf", const std::filesystem::path& folder = ".") {
  const XmlDocument document(text, path.string());
  return sdf_with_collisions(read_sdf(document, Packages(path, {})), document, collisions, folder);
}

const std::string kHull = "hulls/a&b.stl";
const std::string kBox = "<geometry><box><size>1 2 3</size></box></geometry>";

TEST(Sdf, ASubmeshCoversNothingThatIsKnown) {
  const std::string geometry = "<geometry><mesh><uri>a.obj</uri><submesh><name>b</name></submesh></mesh></geometry>";
  const RobotFile file = read(in_model("<link name='a'><visual name='v'>" + geometry + "</visual><collision name='c'>" +
                                       geometry + "</collision></link>"));
  EXPECT_TRUE(file.robot.links[0].visual[0].mesh());
  EXPECT_EQ(file.robot.links[0].collision[0].form, Form(OtherForm{"submesh"}));
  EXPECT_EQ(file.notes,
            (std::vector<std::string>{"line 3: the whole mesh file is read, although the model shows one submesh of it",
                                      "line 3: the submesh of link 'a' is not read"}));
}

TEST(Sdf, TellsHowFarFramesLead) {
  const auto way = [](const std::string& pose) {
    return read(in_model("<frame name='f'><pose>1e9 0 0 0 0 0</pose></frame>"
                         "<frame name='g'><pose relative_to='f'>-1e9 0 0 0 0 0</pose></frame><link name='a'><visual "
                         "name='v'>" +
                         pose + kBox + "</visual></link>"))
        .robot.links[0]
        .visual[0]
        .way;
  };
  EXPECT_EQ(way("<pose>1 0 0 0 0 0</pose>"), 0);
  EXPECT_EQ(way("<pose relative_to='a'>1 0 0 0 0 0</pose>"), 0);
  EXPECT_EQ(way("<pose relative_to='g'>7 0 0 0 0 0</pose>"), 2e9 + 7);
}

const std::string kMeetsNothing = "<surface><contact><collide_bitmask> 0x00 </collide_bitmask></contact></surface>";

TEST(Sdf, WhatMeetsNothingIsNoCollisionGeometry) {
  const std::string meets = "<surface><contact><collide_bitmask>10</collide_bitmask></contact></surface>";
  const RobotFile file =
      read(in_model("<link name='a'><collision name='b'>" + kBox + kMeetsNothing + "</collision><collision name='c'>" +
                    kBox + meets + "</collision><collision name='d'>" + kBox + "</collision></link>"));
  ASSERT_EQ(file.robot.links[0].collision.size(), 2U);
  EXPECT_EQ(file.robot.links[0].collision[0].name, "c");
  EXPECT_EQ(file.notes, (std::vector<std::string>{"line 3: a <collision> of link 'a' has a collide_bitmask of 0: it "
                                                  "meets nothing, and counts as none"}));
}

TEST(Sdf, AHullTakesNoPlaceThatMeetsNothing) {
  const std::string text = in_model("<link name='a'><visual name='v'>" + kBox + "</visual>\n<collision name='b'>" +
                                    kBox + kMeetsNothing + "</collision></link>\n");
  NewCollision collision;
  collision.hulls = {kHull};
  const RobotFile written = read(write(text, {collision}));
  ASSERT_EQ(written.robot.links[0].collision.size(), 1U);
  EXPECT_EQ(written.robot.links[0].collision[0].mesh()->uri, kHull);
}

TEST(Sdf, ReadsShapes) {
  const RobotFile file = read(in_model(
      "<link name='a'><visual name='v'><pose>1 2 3 0 0 0</pose>"
      "<geometry><mesh><uri> meshes/a.stl </uri><scale>1 2 -3</scale></mesh></geometry></visual>"
      "<collision name='c'>" +
      kBox +
      "</collision><collision name='s'><geometry><sphere><radius>2</radius></sphere></geometry></collision>"
      "<collision name='y'><geometry><cylinder><radius>2</radius><length>5</length></cylinder></geometry></collision>"
      "<collision name='k'><geometry><capsule><radius>2</radius><length>5</length></capsule></geometry></collision>"
      "<collision name='e'><geometry><empty/></geometry></collision>"
      "<collision name='p'><geometry><plane><normal>0 0 1</normal></plane></geometry></collision></link>"));
  EXPECT_EQ(file.robot.name, "m");
  ASSERT_EQ(file.robot.links.size(), 1U);
  const Link& link = file.robot.links[0];
  EXPECT_EQ(link.line, 3U);
  ASSERT_EQ(link.visual.size(), 1U);
  EXPECT_EQ(link.visual[0].name, "v");
  EXPECT_EQ(link.visual[0].mesh()->uri, "meshes/a.stl");
  EXPECT_EQ(link.visual[0].mesh()->scale, (Vec3{1, 2, -3}));
  EXPECT_EQ(link.visual[0].origin, translation_by({1, 2, 3}));
  ASSERT_EQ(link.collision.size(), 5U);  // <empty> is none
  EXPECT_EQ(std::get<BoxForm>(link.collision[0].form).size, (Vec3{1, 2, 3}));
  EXPECT_EQ(std::get<SphereForm>(link.collision[1].form).radius, 2);
  EXPECT_EQ(std::get<CylinderForm>(link.collision[2].form).length, 5);
  EXPECT_EQ(std::get<CapsuleForm>(link.collision[3].form).length, 5);
  EXPECT_EQ(std::get<OtherForm>(link.collision[4].form).what, "plane");
}

TEST(Sdf, ReadsPosesInEachNotation) {
  const std::string link = "<link name='a'><visual name='v'>POSE" + kBox + "</visual></link>";
  const auto pose = [&](const std::string& text) {
    std::string content = link;
    return read(in_model(content.replace(content.find("POSE"), 4, text))).robot.links[0].visual[0].origin;
  };
  EXPECT_EQ(pose(""), Pose{});
  EXPECT_EQ(pose("<pose/>"), Pose{});
  const double half = std::sqrt(0.5);
  for (const std::string& quarter :
       {std::string("<pose>1 0 0 0 0 1.5707963267948966</pose>"),
        std::string("<pose degrees='true'>1 0 0 0 0 90</pose>"),
        "<pose rotation_format='quat_xyzw'>1 0 0 0 0 " + std::to_string(half) + " " + std::to_string(half) + "</pose>"})
    expect_near(placed(pose(quarter), {1, 0, 5}), {1, 1, 5});
  // Roll about x first, yaw about z last.
  expect_near(placed(pose("<pose degrees='1'>0 0 0 90 0 90</pose>"), {0, 1, 0}), {0, 0, 1});
  expect_near(placed(pose("<pose degrees='1'>0 0 0 90 0 90</pose>"), {0, 0, 1}), {1, 0, 0});
}

TEST(Sdf, PosesMayBeRelativeToOtherFrames) {
  const RobotFile file =
      read(in_model("<link name='a'><pose>1 0 0 0 0 0</pose></link>"
                    "<link name='b'><pose relative_to='j'>0 0 1 0 0 0</pose>"
                    "<visual name='v'><pose relative_to='f'>0 1 0 0 0 0</pose>" +
                    kBox +
                    "</visual></link>"
                    "<frame name='f' attached_to='a'><pose degrees='true'>0 0 0 0 0 90</pose></frame>"
                    "<joint name='j' type='fixed'><pose relative_to='a'>0 2 0 0 0 "
                    "0</pose><parent>f</parent><child>b</child></joint>"));
  const Robot& robot = file.robot;
  ASSERT_EQ(robot.joints.size(), 1U);
  EXPECT_EQ(robot.joints[0].parent, 0U);  // f is attached to a
  expect_near(robot.joints[0].origin.translation, {0, 2, 1});
  // f is at (1, 0, 0) and turned: (0, 1, 0) there is (0, 0, 0) in the model; b is at (1, 2, 1).
  expect_near(robot.links[1].visual[0].origin.translation, {-1, -2, -1});
}

TEST(Sdf, ReadsJointsWithAnchorAndAxisInTheChild) {
  const std::string links =
      "<link name='a'/><link name='b'><pose degrees='true'>0 0 1 0 0 90</pose></link><link name='c'/>";
  const auto joint = [&](const std::string& axis, const std::string& version = "1.9") {
    return read(in_model(links +
                             "<joint name='j' type='revolute'><pose>1 0 0 0 0 0</pose><parent>a</parent>"
                             "<child>b</child><axis>" +
                             axis +
                             "<limit><lower>-1</lower><upper>2</upper></limit></axis></joint>"
                             "<joint name='k' type='fixed'><parent>b</parent><child>c</child></joint>",
                         version))
        .robot.joints[0];
  };
  const Joint plain = joint("<xyz>2 0 0</xyz>");
  EXPECT_EQ(plain.type, JointType::Revolute);
  EXPECT_EQ(plain.lower, -1);
  EXPECT_EQ(plain.upper, 2);
  expect_near(plain.origin.translation, {0, 0, 1});
  expect_near(plain.anchor, {1, 0, 0});
  expect_near(plain.axis, {1, 0, 0});
  expect_near(joint("<xyz expressed_in='__model__'>1 0 0</xyz>").axis, {0, -1, 0});
  expect_near(joint("<xyz>1 0 0</xyz><use_parent_model_frame>1</use_parent_model_frame>", "1.6").axis, {0, -1, 0});
  expect_near(joint("<xyz>1 0 0</xyz>", "1.6").axis, {1, 0, 0});
  expect_near(joint("<xyz>1 0 0</xyz>", "1.4").axis, {0, -1, 0});  // SDF 1.4 had no other frame
}

TEST(Sdf, ReadsTheKindsOfJoints) {
  const auto joints = [](const std::string& type, const std::string& limit = "") {
    return read(in_model("<link name='a'/><link name='b'/><joint name='j' type='" + type +
                         "'><parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz>" + limit +
                         "</axis><axis2><xyz>0 1 0</xyz></axis2></joint>"))
        .robot.joints;
  };
  EXPECT_EQ(joints("revolute")[0].type, JointType::Continuous);
  EXPECT_EQ(joints("revolute", "<limit><lower>-1e16</lower><upper>inf</upper></limit>")[0].type, JointType::Continuous);
  EXPECT_EQ(joints("revolute", "<limit><lower>-inf</lower><upper>1</upper></limit>")[0].lower, -HUGE_VAL);
  EXPECT_EQ(joints("prismatic")[0].type, JointType::Prismatic);
  EXPECT_EQ(joints("ball")[0].type, JointType::Ball);
  EXPECT_EQ(joints("continuous", "<limit><lower>-1</lower><upper>1</upper></limit>")[0].type, JointType::Continuous);
  EXPECT_EQ(joints("continuous", "<limit><lower>-1</lower><upper>1</upper></limit>")[0].upper, HUGE_VAL);
  const std::vector<Joint> two = joints("universal");
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[0].axis, (Vec3{1, 0, 0}));
  EXPECT_EQ(two[1].axis, (Vec3{0, 1, 0}));
  EXPECT_EQ(two[1].name, "j_axis2");
  EXPECT_EQ(two[1].origin, Pose{});
}

TEST(Sdf, ReadsWhatMovesInOtherWaysAsFloating) {
  for (const std::string type : {"screw", "gearbox"}) {
    const RobotFile file = read(in_model("<link name='a'/><link name='b'/><joint name='j' type='" + type +
                                         "'><parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz></axis></joint>"));
    EXPECT_EQ(file.robot.joints.at(0).type, JointType::Floating);
    EXPECT_NE(file.notes.at(0).find("a " + type + " joint; it is read as floating"), std::string::npos);
  }
}

TEST(Sdf, ReadsJointsThatMimic) {
  const RobotFile file = read(in_model(
      "<link name='a'/><link name='b'/><link name='c'/>"
      "<joint name='k' type='revolute'><parent>b</parent><child>c</child><axis><xyz>0 0 1</xyz><mimic joint='j'>"
      "<multiplier>2</multiplier><offset>1</offset><reference>0.25</reference></mimic></axis></joint>"
      "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>",
      "1.11"));
  ASSERT_EQ(file.robot.joints.size(), 2U);
  EXPECT_EQ(file.robot.joints[0].name, "j");  // the parent's joint comes first
  const Mimic mimic = file.robot.joints[1].mimic.value();
  EXPECT_EQ(mimic.joint, 0U);
  EXPECT_EQ(mimic.multiplier, 2);
  EXPECT_EQ(mimic.offset, 0.5);  // 2 (q - 0.25) + 1
}

TEST(Sdf, ReadsNestedModels) {
  const RobotFile file = read(in_model(
      "<link name='a'/>"
      "<model name='hand' placement_frame='palm'><pose>5 0 0 0 0 0</pose>"
      "<link name='palm'><pose>0 1 0 0 0 0</pose></link><link name='tip'><pose relative_to='palm'>0 0 1 0 0 0</pose>"
      "</link><joint name='j' type='fixed'><parent>palm</parent><child>tip</child></joint></model>"
      "<joint name='k' type='fixed'><parent>a</parent><child>hand::palm</child></joint>"));
  const Robot& robot = file.robot;
  ASSERT_EQ(robot.links.size(), 3U);
  EXPECT_EQ(robot.links[1].name, "hand::palm");
  ASSERT_EQ(robot.joints.size(), 2U);
  expect_near(robot.joints[0].origin.translation, {5, 0, 0});
  EXPECT_EQ(robot.joints[1].name, "hand::j");
  expect_near(robot.joints[1].origin.translation, {0, 0, 1});
}

TEST(Sdf, MakesAForestOfAnyJoints) {
  const std::string loop =
      "<link name='a'/><link name='b'/><link name='c'/>"
      "<joint name='w' type='fixed'><parent>world</parent><child>a</child></joint>"
      "<joint name='ab' type='ball'><parent>a</parent><child>b</child></joint>"
      "<joint name='bc' type='ball'><parent>b</parent><child>c</child></joint>"
      "<joint name='ca' type='ball'><parent>c</parent><child>a</child></joint>";
  const RobotFile file = read(in_model(loop));
  ASSERT_EQ(file.robot.links.size(), 3U);  // joints to the world are left out
  EXPECT_EQ(read(in_model("<link name='world'/>" + loop)).robot.links.size(), 3U) << "as old files have it";
  ASSERT_EQ(file.robot.joints.size(), 2U);
  EXPECT_EQ(file.robot.joints[1].name, "bc");
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_NE(file.notes[0].find("'ca'"), std::string::npos);
}

TEST(Sdf, AJointThatMovesTheOnlyTreeInTheWorldIsKept) {
  const auto robot = [](const std::string& type) {
    return read(in_model("<link name='a'/><link name='b'/><joint name='w' type='" + type +
                         "'><parent>world</parent><child>a</child><axis><xyz>0 0 1</xyz></axis></joint>"
                         "<joint name='ab' type='fixed'><parent>a</parent><child>b</child></joint>"))
        .robot;
  };
  EXPECT_EQ(robot("fixed").links.size(), 2U);
  for (const std::string type : {"revolute", "prismatic"}) {
    const Robot moved = robot(type);
    ASSERT_EQ(moved.links.size(), 3U);
    EXPECT_EQ(moved.links[2].name, "world");
    ASSERT_EQ(moved.joints.size(), 2U);
    EXPECT_EQ(moved.joints[0].name, "w");
    EXPECT_EQ(moved.joints[0].parent, 2U);
  }
}

TEST(Sdf, TurnsAJointWhoseChildHangsAlready) {
  // a -> b <- c: the joint from c to b is read as one from b to c that turns the other way.
  const Robot robot =
      read(in_model("<link name='a'/><link name='b'/><link name='c'><pose>0 3 0 0 0 0</pose></link>"
                    "<joint name='ab' type='fixed'><parent>a</parent><child>b</child></joint>"
                    "<joint name='cb' type='revolute'><pose>1 0 0 0 0 0</pose><parent>c</parent><child>b</child>"
                    "<axis><xyz>0 0 1</xyz></axis></joint>"))
          .robot;
  ASSERT_EQ(robot.joints.size(), 2U);
  const Joint& joint = robot.joints[1];
  EXPECT_EQ(joint.parent, 1U);
  EXPECT_EQ(joint.child, 2U);
  expect_near(joint.origin.translation, {0, 3, 0});
  expect_near(joint.anchor, {1, -3, 0});
  expect_near(joint.axis, {0, 0, -1});
}

TEST(Sdf, PlacesLinksThatNothingJoins) {
  const Robot robot = read(in_model("<link name='a'/><link name='b'><pose>0 3 0 0 0 0</pose></link>")).robot;
  ASSERT_EQ(robot.links.size(), 3U);
  EXPECT_EQ(robot.links[2].name, "world");
  ASSERT_EQ(robot.joints.size(), 2U);
  EXPECT_EQ(robot.joints[1].type, JointType::Floating);
  EXPECT_EQ(robot.joints[1].parent, 2U);
  expect_near(robot.joints[1].origin.translation, {0, 3, 0});
}

TEST(Sdf, ReadsTheFirstModelOfAWorldAndSaysSo) {
  const RobotFile file = read(
      "<sdf version='1.9'><world name='w'><include><uri>model://sun</uri></include><model name='m'><link name='a'/>"
      "<include><uri>model://hand</uri></include></model><model name='n'><link name='b'/></model></world></sdf>");
  EXPECT_EQ(file.robot.links[0].name, "a");
  ASSERT_EQ(file.notes.size(), 3U);
  EXPECT_NE(file.notes[0].find("2 models"), std::string::npos);
  EXPECT_TRUE(has(file.notes[1], "line 1 includes 'model://sun', which is not read: there is no package sun in"))
      << file.notes[1];
  EXPECT_NE(file.notes[2].find("model://hand"), std::string::npos);
}

class SdfIncludes : public testing::Test {
 protected:
  SdfIncludes() {
    write_file(folder_ / "arm/arm.sdf",
               "<sdf version='1.9'><model name='arm'>\n<link name='base'/>\n"
               "<include><uri>model://hand</uri><name>left</name><pose>1 0 0 0 0 0</pose></include>\n"
               "<include><uri>../hand/model-1_9.sdf</uri></include>\n"
               "<joint name='j' type='fixed'><parent>base</parent><child>left::tip::end</child></joint>\n"
               "</model></sdf>");
    write_file(folder_ / "arm/meshes/a.stl");
    write_file(folder_ / "hand/model.config",
               "<model><sdf version='1.9'>model-1_9.sdf</sdf><sdf version='1.4'>model-1_4.sdf</sdf></model>");
    write_file(folder_ / "hand/model-1_9.sdf",
               "<sdf version='1.9'>\n<model name='hand'><pose>5 5 5 0 0 0</pose>\n<link name='palm'>\n"
               "<visual name='v'><geometry><mesh><uri>meshes/a.stl</uri></mesh></geometry></visual></link>\n"
               "<include><uri>parts/tip</uri><pose>0 1 0 0 0 0</pose></include></model></sdf>");
    write_tip("<link name='end'><visual name='v'><geometry><mesh><uri>b.stl</uri></mesh></geometry></visual></link>");
    write_file(folder_ / "hand/parts/tip/b.stl");
  }

  void write_tip(const std::string& content) const {
    write_file(folder_ / "hand/parts/tip/model.sdf",
               "<sdf version='1.9'>\n<model name='tip'>" + content + "</model></sdf>");
  }
  RobotFile read_arm(const FileOptions& options = {}) const { return read_robot(folder_ / "arm/arm.sdf", options); }
  std::string refusal(const std::string& tip) const {
    write_tip(tip);
    return refusal_of([&] { read_arm(); });
  }

  TemporaryFolder folder_;
};

TEST_F(SdfIncludes, StandInThePlaceOfTheElement) {
  const RobotFile file = read_arm();
  std::vector<std::string> names;
  for (const Link& link : file.robot.links) names.push_back(link.name);
  EXPECT_EQ(names, (std::vector<std::string>{"base", "left::palm", "left::tip::end", "hand::palm", "hand::tip::end",
                                             "world"}));
  EXPECT_TRUE(file.notes.empty()) << file.notes[0];
  EXPECT_EQ(file.robot.links[2].line, 2U) << "of its own file";
  const auto joint = std::ranges::find(file.robot.joints, "j", &Joint::name);
  ASSERT_NE(joint, file.robot.joints.end());
  expect_near(joint->origin.translation, {1, 1, 0});
  EXPECT_TRUE(file.robot.links[1].visual.at(0).mesh()->path.empty()) << "not the file of this name beside the arm";
  EXPECT_EQ(file.robot.links[2].visual.at(0).mesh()->path, folder_ / "hand/parts/tip/b.stl");
  const std::string written = with_collisions(file, {{{.link = 4, .hulls = {kHull}}}}, folder_ / "new/place");
  EXPECT_FALSE(has(written, "include")) << written;
  write_file(folder_ / "new/place/arm.sdf", written);
  const Robot again = read_robot(folder_ / "new/place/arm.sdf").robot;
  EXPECT_EQ(again.links.at(4).collision.size(), 1U);
  EXPECT_EQ(again.links.at(4).visual.at(0).mesh()->path, folder_ / "hand/parts/tip/b.stl");
}

TEST_F(SdfIncludes, AreTheModelsOfAWorldWithoutOthers) {
  const std::string worlds = "<sdf version='1.9'><world name='w'><include><uri>model://sun</uri></include>";
  write_file(folder_ / "arm/arm.sdf", worlds + "<include><uri>model://hand</uri></include></world></sdf>");
  const RobotFile file = read_arm();
  EXPECT_EQ(file.robot.name, "hand");
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_TRUE(has(file.notes[0], "line 1 includes 'model://sun', which is not read: there is no package sun"));
  write_file(folder_ / "arm/arm.sdf", worlds + "</world></sdf>");
  EXPECT_TRUE(has(refusal("<link name='end'/>"), "line 1: <include> names 'model://sun', there is no package sun"));
}

TEST_F(SdfIncludes, AreFoundInFoldersOfModels) {
  std::filesystem::rename(folder_ / "hand", folder_ / "hands");
  std::filesystem::create_directories(folder_ / "models");
  std::filesystem::rename(folder_ / "hands", folder_ / "models/hand");
  write_file(folder_ / "arm/arm.sdf",
             "<sdf version='1.9'><model name='m'><include><uri>model://hand</uri></include></model></sdf>");
  const std::string models = (folder_ / "models").string();
  EXPECT_TRUE(has(refusal_of([&] { read_arm(); }), "there is no package hand"));
  EXPECT_EQ(read_arm({.package_paths = {models}}).robot.links.size(), 3U);
  for (const char* name : {"GAZEBO_MODEL_PATH", "SDF_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH"}) {
    const Variable variable(name, models);
    EXPECT_EQ(read_arm().robot.links.size(), 3U) << name;
  }
}

TEST_F(SdfIncludes, ThatCannotBeTakenAreRefusedOrNoted) {
  EXPECT_TRUE(has(refusal("<include><uri>model://hand</uri></include>"),
                  "model.sdf: line 2: <include> names 'model://hand', which includes itself"));
  EXPECT_TRUE(has(refusal("<include><uri>../../../arm/arm.sdf</uri></include>"), "which includes itself"));
  EXPECT_TRUE(has(refusal("<link>"), "model.sdf: line 2: no XML"));
  write_file(folder_ / "hand/parts/tip/other.sdf", "<robot/>");
  EXPECT_TRUE(has(refusal("<include><uri>other.sdf</uri></include>"), "whose root is <robot>, not <sdf>"));
  write_file(folder_ / "hand/parts/tip/other.sdf", "<sdf version='1.4'><model name='o'><link name='o'/></model></sdf>");
  write_tip(
      "<link name='end'/><include><uri>other.sdf</uri></include><include merge='true'><uri>x</uri></include>"
      "<include><pose>0 0 0 0 0 0</pose></include>");
  EXPECT_EQ(read_arm().notes.size(), 6U);
  EXPECT_EQ(read_arm().robot.links.size(), 6U);
  EXPECT_TRUE(has(refusal_of([&] { read_arm({.package_paths = {}, .no_outside_files = true}); }, Defect::CannotRead),
                  "--no-outside-files"));
}

TEST_F(SdfIncludes, AreBounded) {
  const auto twice = [](int next) {
    const std::string name = std::to_string(next);
    return "<sdf version='1.9'><model name='m'><link name='l'/><include><uri>" + name +
           ".sdf</uri><name>a</name></include>"
           "<include><uri>" +
           name + ".sdf</uri><name>b</name></include></model></sdf>";
  };
  write_file(folder_ / "arm/arm.sdf", twice(0));
  for (int i = 0; i < 40; ++i) write_file(folder_ / "arm" / (std::to_string(i) + ".sdf"), twice(i + 1));
  EXPECT_TRUE(has(refusal_of([&] { read_arm(); }), "more than 10,000 models"));
}

TEST(Sdf, RefusesWithTheLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"<link name='a'/>\n<link name='a'/>", "line 4: there is a second <link> called 'a', the first is in line 3"},
      {"<link name='world'><visual name='v'><geometry><sphere><radius>1</radius></sphere></geometry></visual></link>",
       "line 3: <link> is called 'world', a name that SDF reserves"},
      {"<link/>", "line 3: <link> has no name"},
      {"", "no <link>"},
      {"<link name='a'/>\n<joint name='j' type='fixed'><parent>a</parent><child>b</child></joint>", "names 'b'"},
      {"<link name='a'/>\n<joint name='j' type='fixed'><child>a</child></joint>", "no <parent>"},
      {"<link name='a'/>\n<joint name='j' type='fixed'><parent>a</parent><child>a</child></joint>", "with itself"},
      {"<link name='a'/><link name='b'/><joint name='j' type='x'><parent>a</parent><child>b</child></joint>", "'x'"},
      {"<link name='a'/><link name='b'/><joint name='j' type='revolute'><parent>a</parent><child>b</child></joint>",
       "no <axis>"},
      {"<link name='a'/><link name='b'/><joint name='j' type='revolute'><parent>a</parent><child>b</child>"
       "<axis><xyz>0 0 0</xyz></axis></joint>",
       "length 0"},
      {"<link name='a'><pose relative_to='b'/></link><link name='b'><pose relative_to='a'/></link>",
       "relative to itself"},
      {"<link name='a'><pose relative_to='x'/></link>", "names 'x'"},
      {"<link name='a'><pose>0 0 nan 0 0 0</pose></link>", "'nan'"},
      {"<link name='a'><pose>0 0 0</pose></link>", "3 numbers, expected 6"},
      {"<link name='a'><pose>1e50 0 0 0 0 0</pose></link>", "too large"},
      {"<link name='a'><pose rotation_format='quat_xyzw'>0 0 0 0 0 0 0</pose></link>", "length 0"},
      {"<link name='a'/><frame name='f' attached_to='g'/><frame name='g' attached_to='f'/>", "relative to itself"},
      {"<link name='a'><visual name='v'><geometry><box><size>1 0 1</size></box></geometry></visual></link>",
       "more than 0"},
      {"<link name='a'><visual name='v'><geometry><mesh/></geometry></visual></link>", "no <uri>"},
      {"<link name='a'><visual name='v'/></link>", "no <geometry>"},
      {"<link name='a'><visual name='v'><geometry/></visual></link>", "no shape"},
      {"<link name='a'/><link name='b'/><joint name='j' type='revolute'><parent>a</parent><child>b</child>"
       "<axis><mimic joint='j'/></axis></joint>",
       "mimics itself"},
  };
  for (const auto& [content, expected] : cases) {
    const std::string message = message_of(in_model(content));
    EXPECT_TRUE(message.starts_with("arm.sdf: line ")) << content << ": " << message;
    EXPECT_NE(message.find(expected), std::string::npos) << content << ": " << message;
  }
  EXPECT_NE(message_of("<sdf version='1.9'/>").find("no <model>"), std::string::npos);
}

TEST(Sdf, ReadsManyLinksQuickly) {
  std::string content = "<link name='l0'/>";
  for (int i = 1; i < 20'000; ++i) {
    const std::string name = std::to_string(i), before = std::to_string(i - 1);
    content += "<link name='l" + name + "'><pose relative_to='l" + before + "'>1 0 0 0 0 0</pose></link>" +
               "<joint name='j" + name + "' type='fixed'><parent>l" + before + "</parent><child>l" + name +
               "</child></joint>\n";
  }
  const Robot robot = read(in_model(content)).robot;
  ASSERT_EQ(robot.joints.size(), 19'999U);
  EXPECT_EQ(robot.joints.back().origin, translation_by({1, 0, 0}));
}

TEST(SdfWithCollisions, ChangesTheFirstCollisionAndRemovesTheOthers) {
  const std::string before =
      "<?xml version='1.0'?>\r\n<!-- kept -->\r\n<sdf version='1.9'>\r\n  <model name='m'>\r\n"
      "    <link name='a'>\r\n"
      "      <visual name='v'>\r\n        <pose relative_to='a' degrees='true'>1 2 3  0 0 90</pose>\r\n        " +
      kBox +
      "\r\n      </visual>\r\n"
      "      <collision name='c'>\r\n";
  const std::string text = before +
                           "        <laser_retro>1</laser_retro>\r\n"
                           "        <pose>9 9 9 0 0 0</pose>\r\n"
                           "        <geometry><sphere><radius>1</radius></sphere></geometry>\r\n"
                           "        <surface><x:y xmlns:x='z'><![CDATA[ <a> ]]></x:y></surface>\r\n"
                           "      </collision>\r\n"
                           "      <!-- second -->\r\n"
                           "      <collision name='d'>\r\n        " +
                           kBox +
                           "\r\n      </collision>\r\n"
                           "      <unknown a = \"1\" />\r\n"
                           "    </link>\r\n  </model>\r\n</sdf>\r\n";
  const std::string expected =
      before +
      "        <laser_retro>1</laser_retro>\r\n"
      "        <pose relative_to='a' degrees='true'>1 2 3  0 0 90</pose>\r\n"
      "        <geometry>\r\n          <mesh>\r\n            <uri>hulls/a&amp;b.stl</uri>\r\n          </mesh>\r\n"
      "        </geometry>\r\n"
      "        <surface><x:y xmlns:x='z'><![CDATA[ <a> ]]></x:y></surface>\r\n"
      "      </collision>\r\n"
      "      <!-- second -->\r\n"
      "      <unknown a = \"1\" />\r\n"
      "    </link>\r\n  </model>\r\n</sdf>\r\n";
  EXPECT_EQ(write(text, {hull_of(kHull, 0, 0)}), expected);
  EXPECT_EQ(write(text, {}), text);
  // In the frame of the link, the pose goes.
  EXPECT_EQ(write(text, {hull_of(kHull, 0)}).find("9 9 9"), std::string::npos);
}

TEST(SdfWithCollisions, LeavesNoSecondPoseOrGeometry) {
  const std::string text =
      in_model("<link name='a'><collision name='c'><pose>0 0 0 0 0 0</pose><pose>1 0 0 0 0 0</pose>" + kBox + kBox +
               "</collision></link>");
  for (const std::optional<std::size_t> origin : {std::optional<std::size_t>(), std::optional<std::size_t>(0)}) {
    NewCollision collision = hull_of(kHull, 0, origin);
    collision.from = Geometry::Collision;
    const std::string result = write(text, {collision});
    EXPECT_EQ(result.find("<pose>0 0 0 0 0 0</pose>") != result.npos, origin.has_value()) << result;
    for (const char* gone : {"<pose>1 0 0", "<box>"}) EXPECT_EQ(result.find(gone), result.npos) << result;
  }
}

TEST(SdfWithCollisions, ReadsBackWithTheNewCollisions) {
  const std::string text =
      in_model("  <link name='a'>\n    <visual name='v'>\n      <pose>1 2 3 0 0 0</pose>\n      " + kBox +
               "\n    </visual>\n    <visual name='e'><geometry><empty/></geometry></visual>\n"
               "    <visual name='w'>\n      <geometry>\n        <mesh><uri>a.stl</uri></mesh>\n      </geometry>\n"
               "    </visual>\n    <sensor name='a_hull' type='contact'/>\n  </link>\n  <link name='b'/>\n");
  const std::string result = write(text, {hull_of(kHull, 0, 1, {0})});
  const Link link = read(result).robot.links[0];
  EXPECT_EQ(link.visual.size(), 2U);
  ASSERT_EQ(link.collision.size(), 2U);
  EXPECT_EQ(link.collision[0].mesh()->uri, "hulls/a&b.stl");
  EXPECT_EQ(link.collision[0].origin, Pose{});
  EXPECT_EQ(link.collision[0].name, "a_hull_2");  // a_hull is a sensor
  EXPECT_EQ(link.collision[1].name, "a_hull_3");
  EXPECT_EQ(std::get<BoxForm>(link.collision[1].form).size, (Vec3{1, 2, 3}));
  EXPECT_EQ(link.collision[1].origin, translation_by({1, 2, 3}));
}

TEST(SdfWithCollisions, TakesSeveralPiecesAndSpheres) {
  const std::string visual = "<visual name='v'><pose>1 2 3 0 0 0</pose>" + kBox + "</visual>";
  const std::string old = "<collision name='c'><pose>4 4 4 0 0 0</pose>" + kBox + "</collision>";
  for (const std::string& before :
       {visual, visual + old, visual + old + "<collision name='d'>" + kBox + "</collision>"}) {
    NewCollision collision = hull_of(kHull, 0, 0);
    collision.hulls = {"hulls/a_01.stl", "hulls/a_02.stl"};
    collision.balls = {{{0.1, -2e-7, 3}, 0.25}};
    const Link link = read(write(in_model("<link name='a'>" + before + "</link>"), {collision})).robot.links[0];
    ASSERT_EQ(link.collision.size(), 3U);
    std::set<std::string> names;
    for (const Shape& shape : link.collision) names.insert(shape.name);
    EXPECT_EQ(names.size(), 3U);
    for (const std::size_t i : {0U, 1U}) {
      EXPECT_TRUE(link.collision[i].mesh());
      EXPECT_EQ(link.collision[i].origin, translation_by({1, 2, 3}));
    }
    EXPECT_EQ(std::get<SphereForm>(link.collision[2].form).radius, 0.25);
    EXPECT_EQ(link.collision[2].origin, translation_by({0.1, -2e-7, 3}));
  }
}

TEST(SdfWithCollisions, CollisionElementsThatAreKeptStayWhereTheyAre) {
  const std::string box = "<collision name='c'>" + kBox + "<max_contacts>3</max_contacts></collision>";
  NewCollision collision = hull_of(kHull, 0, {}, {0});
  collision.from = Geometry::Collision;
  const std::string result = write(in_model("<link name='a'>" + box +
                                            "<collision name='d'><geometry><mesh><uri>a.stl</uri></mesh></geometry>"
                                            "</collision></link>"),
                                   {collision});
  EXPECT_NE(result.find(box), std::string::npos);
  const Link link = read(result).robot.links[0];
  ASSERT_EQ(link.collision.size(), 2U);
  EXPECT_EQ(link.collision[1].name, "d");
  EXPECT_EQ(link.collision[1].mesh()->uri, "hulls/a&b.stl");
}

TEST(SdfWithCollisions, WorksWithoutLines) {
  const std::string text =
      "<sdf version='1.9'><model name='m'><link name='a'><visual name='v'><pose>1 0 0 0 0 0</pose>" + kBox +
      "</visual><collision name='c'>" + kBox + "</collision><collision name='d'>" + kBox +
      "</collision></link></model></sdf>";
  const std::string result = write(text, {hull_of(kHull, 0, 0, {0})});
  const Link link = read(result).robot.links[0];
  ASSERT_EQ(link.collision.size(), 2U);
  EXPECT_EQ(link.collision[0].origin, translation_by({1, 0, 0}));
  EXPECT_EQ(link.collision[1].origin, translation_by({1, 0, 0}));
}

TEST(SdfWithCollisions, RelativePathsStillFindTheirFiles) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "prohull_sdf_test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder / "in" / "meshes");
  std::filesystem::create_directories(folder / "out");
  std::ofstream(folder / "in" / "meshes" / "a b.stl") << "x";
  const std::string mesh = "<geometry><mesh><uri>meshes/a b.stl</uri></mesh></geometry>";
  const std::string text =
      in_model("<link name='a'>\n<visual name='v'>" + mesh + "</visual>\n<collision name='c'>" + mesh +
               "</collision>\n</link>\n<link name='b'><visual name='v'>" + mesh + "</visual></link>");
  const RobotFile moved =
      read(write(text, {hull_of(kHull, 0)}, folder / "in" / "arm.sdf", folder / "out"), folder / "out" / "arm.sdf");
  for (const std::size_t link : {0U, 1U})
    EXPECT_EQ(moved.robot.links[link].visual[0].mesh()->path.filename(), "a b.stl");
  EXPECT_EQ(moved.robot.links[0].collision[0].mesh()->uri, "hulls/a&b.stl");
  // A copy of a shape finds its file, too.
  NewCollision kept = hull_of(kHull, 1, {}, {0});
  const RobotFile copied =
      read(write(text, {kept}, folder / "in" / "arm.sdf", folder / "out"), folder / "out" / "arm.sdf");
  EXPECT_EQ(copied.robot.links[1].collision[1].mesh()->path.filename(), "a b.stl");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace prohull::robot
