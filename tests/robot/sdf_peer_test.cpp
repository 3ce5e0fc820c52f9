// What robot/files/sdf.h reads, against the parser of the SDF project.
#include <gtest/gtest.h>

#include <sdf/sdf.hh>

#include "robot/files/sdf.h"
#include "robot/transform.h"
#include "robot_testing.h"

namespace prohull::robot {
namespace {

// Every kind of frame, turned about every axis.
const std::string kModel = R"(<?xml version="1.0"?>
<sdf version="1.9">
  <model name="m">
    <link name="base"><pose>1 2 3 0.1 0.2 0.3</pose></link>
    <link name="arm">
      <pose relative_to="elbow">0 0.5 0 0.4 0 0.1</pose>
      <visual name="v">
        <pose relative_to="tool">0.1 0.2 0.3 0.3 0.2 0.1</pose>
        <geometry><mesh><uri>meshes/arm.stl</uri></mesh></geometry>
      </visual>
      <collision name="c">
        <geometry><box><size>1 1 1</size></box></geometry>
        <max_contacts>7</max_contacts>
      </collision>
    </link>
    <link name="rod"><pose degrees="true" relative_to="arm">1 0 0 30 20 10</pose></link>
    <frame name="elbow" attached_to="base"><pose>0.2 0 0 -1 0.5 2</pose></frame>
    <frame name="tool" attached_to="rod"><pose rotation_format="quat_xyzw">0 0 1 0.5 0.5 -0.5 0.5</pose></frame>
    <joint name="j1" type="revolute">
      <pose relative_to="elbow">0 0 0.3 0 1 0</pose>
      <parent>base</parent><child>arm</child>
      <axis><xyz expressed_in="tool">1 2 2</xyz><limit><lower>-1</lower><upper>2</upper></limit></axis>
    </joint>
    <joint name="j2" type="prismatic">
      <pose>0.1 0 0 0.7 0 0</pose>
      <parent>elbow</parent><child>tool</child>
      <axis><xyz>0 3 4</xyz></axis>
    </joint>
  </model>
</sdf>
)";

RobotFile read(const std::string& text) { return read_sdf(XmlDocument(text, "arm.sdf"), Packages("arm.sdf", {})); }

struct Peer {
  explicit Peer(const std::string& text) {
    for (const sdf::Error& error : root.LoadSdfString(text)) ADD_FAILURE() << error.Message();
  }
  const sdf::Model& model() const { return *root.Model(); }
  static Pose pose_of(const sdf::SemanticPose& semantic, const std::string& to) {
    ignition::math::Pose3d pose;
    EXPECT_TRUE(semantic.Resolve(pose, to).empty());
    return pose_of_quaternion(pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z(),
                              {pose.X(), pose.Y(), pose.Z()});
  }

  sdf::Root root;
};

constexpr double kTolerance = 1e-9;

TEST(SdfPeer, AgreesAboutLinksAndShapes) {
  const Robot robot = read(kModel).robot;
  const Peer peer(kModel);
  ASSERT_EQ(robot.links.size(), peer.model().LinkCount());
  const sdf::Visual& visual = *peer.model().LinkByName("arm")->VisualByIndex(0);
  expect_near(robot.links[1].visual.at(0).origin, Peer::pose_of(visual.SemanticPose(), "arm"), kTolerance);
}

TEST(SdfPeer, AgreesAboutJoints) {
  const Robot robot = read(kModel).robot;
  const Peer peer(kModel);
  ASSERT_EQ(robot.joints.size(), 2U);
  for (const Joint& joint : robot.joints) {
    const sdf::Joint& other = *peer.model().JointByName(joint.name);
    const std::string &parent = robot.links[joint.parent].name, &child = robot.links[joint.child].name;
    std::string name;
    EXPECT_TRUE(other.ResolveParentLink(name).empty());
    EXPECT_EQ(name, parent);
    EXPECT_TRUE(other.ResolveChildLink(name).empty());
    EXPECT_EQ(name, child);
    expect_near(joint.origin, Peer::pose_of(peer.model().LinkByName(child)->SemanticPose(), parent), kTolerance);
    expect_near(joint.anchor, Peer::pose_of(other.SemanticPose(), child).translation, kTolerance);
    ignition::math::Vector3d axis;
    EXPECT_TRUE(other.Axis()->ResolveXyz(axis, child).empty());
    expect_near(joint.axis, {axis.X(), axis.Y(), axis.Z()}, kTolerance);
  }
  EXPECT_EQ(peer.model().JointByName("j1")->Axis()->Upper(), robot.joints[0].upper);
}

TEST(SdfPeer, ReadsWhatIsWritten) {
  const XmlDocument document(kModel, "arm.sdf");
  NewCollision collision;
  collision.link = 1, collision.hulls = {"hulls/arm.stl"}, collision.same_origin_as = 0, collision.kept = {0};
  const Peer peer(sdf_with_collisions(read(kModel), document, std::vector{collision}, "."));
  const sdf::Link& link = *peer.model().LinkByName("arm");
  ASSERT_EQ(link.CollisionCount(), 2U);
  const sdf::Collision& hull = *link.CollisionByIndex(0);
  EXPECT_EQ(hull.Name(), "c");
  ASSERT_TRUE(hull.Geom()->MeshShape());
  EXPECT_EQ(hull.Geom()->MeshShape()->Uri(), "hulls/arm.stl");
  EXPECT_EQ(link.CollisionByIndex(1)->Name(), "arm_hull");
  const Pose visual = Peer::pose_of(link.VisualByIndex(0)->SemanticPose(), "arm");
  for (const std::size_t i : {0U, 1U})
    expect_near(Peer::pose_of(link.CollisionByIndex(i)->SemanticPose(), "arm"), visual, kTolerance);
}

TEST(SdfPeer, AgreesAboutWhatIsIncluded) {
  const TemporaryFolder folder;
  write_file(
      folder / "arm/arm.sdf",
      "<sdf version='1.9'><model name='arm'><link name='base'/><frame name='wrist'><pose>0 1 0 1 0 0</pose></frame>"
      "<include><uri>model://hand</uri><name>left</name><pose relative_to='wrist'>1 2 3 0.1 0.2 0.3</pose>"
      "<placement_frame>tip</placement_frame></include><include><uri>model://hand</uri></include></model></sdf>");
  write_file(folder / "hand/model.config", "<model><name>hand</name><sdf version='1.9'>hand.sdf</sdf></model>");
  write_file(
      folder / "hand/hand.sdf",
      "<sdf version='1.9'><model name='hand'><pose>5 5 5 1 0 0</pose><link name='palm'><pose>0 0 1 0 0.5 0</pose>"
      "</link><link name='tip'><pose>3 0 0 0 0 0.7</pose></link></model></sdf>");
  const Robot robot = read_robot(folder / "arm/arm.sdf").robot;
  sdf::ParserConfig config;
  config.AddURIPath("model://", folder.path().string());
  sdf::Root root;
  for (const sdf::Error& error : root.Load((folder / "arm/arm.sdf").string(), config)) ADD_FAILURE() << error.Message();
  ASSERT_EQ(robot.joints.size(), 5U);  // that hang the links on the world
  for (const Joint& joint : robot.joints) {
    const std::string& name = robot.links[joint.child].name;
    const std::size_t colons = name.find("::");
    if (colons == name.npos) continue;
    const sdf::Model& hand = *root.Model()->ModelByName(name.substr(0, colons));
    const sdf::Link& link = *hand.LinkByName(name.substr(colons + 2));
    expect_near(
        joint.origin,
        composed(Peer::pose_of(hand.SemanticPose(), "__model__"), Peer::pose_of(link.SemanticPose(), "__model__")),
        kTolerance);
  }
}

}  // namespace
}  // namespace prohull::robot
