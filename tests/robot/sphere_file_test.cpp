#include "robot/files/sphere_file.h"

#include <gtest/gtest.h>

#include <yaml-cpp/yaml.h>

#include <limits>

#include "input_error.h"
#include "prohull/error.h"
#include "robot/motion/planner_files.h"
#include "robot_of_joints.h"

namespace prohull::robot::of_sphere_file {
namespace {

std::string refusal(const std::string& text) {
  return error_of([&] { read_sphere_file(text, "spheres.yaml"); }).what();
}

void expect_read_back(const std::vector<LinkBalls>& links) {
  const std::vector<LinkBalls> read = read_sphere_file(sphere_file(links), "spheres.yaml");
  ASSERT_EQ(read.size(), links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    EXPECT_EQ(read[i].link, links[i].link);
    EXPECT_EQ(read[i].balls, links[i].balls);
  }
}

TEST(SphereFile, ReadsBackAsTheSameDoubles) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  expect_read_back({{"base", {{{0.1, -1.0 / 3, 1e-5}, 2e22}, {{1e300, kLeast, -0.0}, 1}}},
                    {"arm: [1] \"\n#'", {{{1, 2, 3}, 0.25}}},
                    {"none", {}},
                    {"\xC3\xA9 true", {}}});
  expect_read_back({});
}

TEST(SphereFile, HasPointsInAllNumbersForYaml11) {
  const LinkBalls link{"a", {{{1e-5, 1, 1.5e-7}, 1e20}}};
  EXPECT_EQ(sphere_file(std::span(&link, 1)),
            "collision_spheres:\n  \"a\":\n    - {center: [1.0e-05, 1.0, 1.5e-07], radius: 1.0e+20}\n");
}

TEST(SphereFile, RefusesNamesThatYamlCannotHold) {
  const LinkBalls link{"a\xFF", {}};
  EXPECT_THROW(sphere_file(std::span(&link, 1)), InputError);
}

TEST(SphereFile, IsReadAsOthersWriteIt) {
  const auto links = read_sphere_file(
      "robot: 'UR'\n"
      "collision_spheres:\n"
      "  tool0:\n"
      "    - \"center\": [0, 0.5, 1e-3]\n"
      "      \"radius\": 0.1\n"
      "    - {center: [0, 0, 0], radius: -0.01}\n",
      "ur.yml");
  ASSERT_EQ(links.size(), 1U);
  EXPECT_EQ(links[0].link, "tool0");
  EXPECT_EQ(links[0].balls, (std::vector<Ball>{{{0, 0.5, 1e-3}, 0.1}}));
  EXPECT_EQ(links[0].switched_off, 1U);
}

TEST(SphereJson, ReadsBackAsTheSameDoubles) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  const LinkBalls link{"a \"\xC3\xA9", {{{0.1, -1.0 / 3, 1e-5}, 2e22}, {{1e300, kLeast, -0.0}, 1}}};
  const LinkBalls read = read_sphere_json(sphere_json(link), "a.json");
  EXPECT_EQ(read.link, link.link);
  EXPECT_EQ(read.balls, link.balls);
  EXPECT_EQ(read.switched_off, 0U);
  EXPECT_THROW(sphere_json({"a\xFF", {}}), InputError);
}

TEST(SphereJson, LeavesOutWhatIsSwitchedOff) {
  const LinkBalls read = read_sphere_json(R"({"spheres": [{"center": [0, 0, 0], "radius": -1}]})", "a.json");
  EXPECT_TRUE(read.balls.empty());
  EXPECT_EQ(read.switched_off, 1U);
}

TEST(SphereJson, RefusesAnythingElse) {
  for (const char* text :
       {"", "{", "[]", "{}", R"({"spheres": 1})", R"({"spheres": [1]})", R"({"spheres": [{}]})",
        R"({"spheres": [{"center": [0, 0], "radius": 1}]})", R"({"spheres": [{"center": [0, 0, "x"], "radius": 1}]})",
        R"({"spheres": [{"center": [0, 0, 0]}]})", R"({"spheres": [{"center": [0, 0, 1e999], "radius": 1}]})"}) {
    const std::string refusal = error_of([&] { read_sphere_json(text, "a.json"); }).what();
    EXPECT_TRUE(refusal.starts_with("a.json: ")) << text << ": " << refusal;
  }
}

TEST(SphereJson, MayHaveDeeplyNestedValues) {
  const std::string deep = std::string(500'000, '[') + std::string(500'000, ']');
  for (const std::string& sphere : {R"({"radius": 1, "center": )" + deep + "}", deep})
    EXPECT_THROW(read_sphere_json(R"({"spheres": [)" + sphere + "]}", "a.json"), InputError);
}

TEST(SphereFile, RefusesAnythingElseWithTheLine) {
  const std::string head = "collision_spheres:\n  a:\n";
  EXPECT_EQ(refusal(""), "spheres.yaml: line 1: expected collision_spheres: and below it links");
  EXPECT_EQ(refusal("[1]"), "spheres.yaml: line 1: expected collision_spheres: and below it links");
  EXPECT_EQ(refusal("collision_spheres: other.yml"),
            "spheres.yaml: line 1: collision_spheres: expected the name of a link and its spheres on each line");
  EXPECT_EQ(refusal(head + "    x"),
            "spheres.yaml: line 3: expected a list of spheres, each with a center and a radius");
  EXPECT_EQ(refusal(head + "    - {center: [0, 0, 0]}"),
            "spheres.yaml: line 3: expected a sphere, as {center: [x, y, z], radius: r}");
  EXPECT_EQ(refusal(head + "    - {center: [0, 0], radius: 1}"),
            "spheres.yaml: line 3: center: expected three numbers, as [x, y, z]");
  EXPECT_EQ(refusal(head + "    - {center: [0, 0, big], radius: 1}"), "spheres.yaml: line 3: 'big': expected a number");
  EXPECT_EQ(refusal(head + "    - {center: [0, 0, 0], radius: .inf}"),
            "spheres.yaml: line 3: '.inf': expected a finite number");
  EXPECT_EQ(refusal(head + "    []\n  a: []"), "spheres.yaml: line 4: the link a occurs twice");
  EXPECT_NE(refusal(head + "    - {center: [0, 0, 0"), "");
  EXPECT_NE(refusal(std::string(100000, '[')), "");
}

TEST(SphereFile, RefusesAliasesOfTooManySpheres) {
  std::string text = "all: &all\n";
  for (int i = 0; i < 2000; ++i) text += "  - {center: [0, 0, 0], radius: 1}\n";
  text += "collision_spheres:\n";
  for (int i = 0; i < 60; ++i) text += "  l" + std::to_string(i) + ": *all\n";
  EXPECT_NE(refusal(text).find("more than 100000 spheres"), std::string::npos);
}

/// An arm of which the last link but one has no balls.
struct Planned {
  Robot robot = robot_of(5, {limited(joint(JointType::Revolute, 0, 1, {}, {0, 0, 1}), -1, 2),
                             joint(JointType::Continuous, 1, 2, {1, 0, 0}, {0, 0, 1}),
                             mimicking(joint(JointType::Prismatic, 2, 3, {1, 0, 0}, {0, 0, 1}), 0, 1, 0),
                             joint(JointType::Fixed, 3, 4, {1, 0, 0}, {1, 0, 0})});
  std::vector<LinkBalls> balls{{"link0", {{{0.1, 0, 0}, 0.5}}},
                               {"link1", {{{0, 0, 1e-5}, 1}, {{1, 0, 0}, 2}}},
                               {"link2", {{{0, 0, 0}, 1}}},
                               {"link3", {}},
                               {"link4", {{{0, 0, 0}, 1}}}};
  std::vector<MotionPair> pairs{{.a = 0, .b = 1, .kind = PairKind::Adjacent},
                                {.a = 0, .b = 2, .kind = PairKind::ProvenNever},
                                {.a = 0, .b = 3, .kind = PairKind::ProvenNever},
                                {.a = 0, .b = 4, .kind = PairKind::Never},
                                {.a = 1, .b = 4, .kind = PairKind::Sometimes}};
  PlannerRobot planner() const { return {robot, balls, pairs, "arm.urdf"}; }
};

TEST(PlannerFiles, OfCuRoboLeaveOutPairsThatAreProven) {
  const Planned arm;
  const std::string text = curobo_file(arm.planner());
  const YAML::Node file = YAML::Load(text)["robot_cfg"]["kinematics"];
  EXPECT_EQ(file["base_link"].as<std::string>(), "link0");
  EXPECT_EQ(file["ee_link"].as<std::string>(), "link4");
  using Names = std::vector<std::string>;
  EXPECT_EQ(file["collision_link_names"].as<Names>(), (Names{"link0", "link1", "link2", "link4"}));
  EXPECT_EQ(file["self_collision_ignore"].size(), 1U);
  EXPECT_EQ(file["self_collision_ignore"]["link0"].as<Names>(), (Names{"link1", "link2"}));
  EXPECT_EQ(file["cspace"]["joint_names"].as<Names>(), (Names{"joint0", "joint1"}));
  EXPECT_EQ(file["cspace"]["retract_config"].as<std::vector<double>>(), (std::vector<double>{0.5, 0}));
  const std::vector<LinkBalls> read = read_sphere_file(text, "arm_curobo.yml");
  ASSERT_EQ(read.size(), 4U);
  EXPECT_EQ(read[1].balls, arm.balls[1].balls);
}

TEST(PlannerFiles, NameLinksToWhichAPlannerIsBlind) {
  Planned arm;
  arm.robot.links[3].visual.clear();
  EXPECT_EQ(curobo_file(arm.planner()).find("# No spheres"), std::string::npos) << "link3 has no geometry";
  arm.robot.links[3].collision = {{BoxForm{{1, 1, 1}}}};
  EXPECT_EQ(links_without_spheres(arm.robot, arm.balls), std::vector<std::string>{"link3"});
  const std::string line = "# No spheres, and so no collisions, of these links that have geometry: \"link3\"\n";
  for (const std::string& text : {curobo_file(arm.planner()), xrdf_file(arm.planner())}) {
    EXPECT_TRUE(text.starts_with(line)) << text;
    EXPECT_TRUE(YAML::Load(text).IsMap());
  }
}

TEST(PlannerFiles, OfXrdfHaveTheSameSpheresAndPairs) {
  const Planned arm;
  const YAML::Node file = YAML::Load(xrdf_file(arm.planner()));
  EXPECT_EQ(file["format"].as<std::string>(), "xrdf");
  const auto spheres = file["geometry"][file["self_collision"]["geometry"].as<std::string>()]["spheres"];
  EXPECT_EQ(spheres.size(), 4U);
  EXPECT_EQ(spheres["link1"][1]["radius"].as<double>(), 2);
  EXPECT_EQ(file["self_collision"]["ignore"]["link0"].size(), 2U);
  EXPECT_EQ(file["cspace"]["acceleration_limits"].size(), 2U);
  EXPECT_EQ(file["default_joint_positions"]["joint0"].as<double>(), 0.5);
}

}  // namespace
}  // namespace prohull::robot::of_sphere_file
