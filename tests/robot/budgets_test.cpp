#include "robot/hulls/budgets.h"

#include <gtest/gtest.h>

#include "prohull/error.h"
#include "robot_testing.h"

namespace prohull::robot {
namespace {

const Robot kRobot{.name = "crane",
                   .links = {{.name = "base link"}, {.name = "arm"}, {.name = "forearm"}, {.name = "tool0"}}};

LinkHullOptions read(std::string_view text, std::size_t sets = 1, const Robot& robot = kRobot) {
  LinkHullOptions options;
  options.budget.faces.assign(sets, 500);
  read_budgets(text, "budgets.yaml", robot, options);
  return options;
}

std::string message_of(std::string_view text) {
  return refusal_of([&] { read(text); });
}

TEST(Budgets, OfALinkBeginWithTheDefault) {
  const LinkHullOptions options = read(
      "default: {faces: 300, gap: 5mm}\n"
      "links:\n"
      "  forearm: {max_distance: 0.1in}\n"
      "  tool0: {skip: true}\n"
      "  'base link':\n");
  EXPECT_EQ(options.budget, (Budget{.faces = {300}, .padding = 0.005}));
  EXPECT_EQ(options.budgets.at("forearm"), (Budget{.faces = {300}, .max_distance = 0.1 * 0.0254, .padding = 0.005}));
  EXPECT_TRUE(options.budgets.at("tool0").skip);
  EXPECT_EQ(options.budgets.at("base link"), options.budget);
  EXPECT_EQ(read("").budget, Budget{});
}

TEST(Budgets, HaveANumberOfFacesForEachSet) {
  EXPECT_EQ(read("default: {faces: [800, 100]}", 2).budget.faces, (std::vector<std::size_t>{800, 100}));
  EXPECT_EQ(message_of("links:\n  arm: {faces: [800, 100]}"),
            "budgets.yaml: line 2: 2 numbers of faces, but 1 sets of hulls are asked for");
}

TEST(Budgets, SayOfWhichKindTheCollisionGeometryIs) {
  const LinkHullOptions options = read(
      "default: {collision: convex, pieces: 5}\n"
      "links:\n"
      "  arm: {vertices: 12}\n"
      "  forearm: {collision: spheres, spheres: 30}\n"
      "  tool0: {collision: hull}\n");
  EXPECT_EQ(options.budget, (Budget{.collision = Collision::Convex, .pieces = 5}));
  EXPECT_EQ(options.budgets.at("arm"), (Budget{.collision = Collision::Convex, .pieces = 5, .vertices = 12}));
  EXPECT_EQ(options.budgets.at("forearm"), (Budget{.collision = Collision::Spheres, .pieces = 5, .spheres = 30}));
  EXPECT_EQ(options.budgets.at("tool0"), (Budget{.pieces = 5}));
}

TEST(Budgets, RefuseWhatTheyDoNotKnowWithItsLine) {
  EXPECT_EQ(message_of("links:\n  arm: {face: 3}"),
            "budgets.yaml: line 2: 'face' is not known; expected collision, faces, gap, max_distance, pieces, skip, "
            "spheres, vertices");
  EXPECT_EQ(message_of("limits: 3"), "budgets.yaml: line 1: 'limits' is not known; expected default, links");
  EXPECT_NE(message_of("default: {faces: many}").find("line 1: 'many': expected at least 4 faces"), std::string::npos);
  EXPECT_NE(message_of("default: {faces: 3}").find("at least 4 faces"), std::string::npos);
  EXPECT_NE(message_of("default: {pieces: 0}").find("at least 1 pieces"), std::string::npos);
  EXPECT_NE(message_of("default: {vertices: 3}").find("at least 4 vertices"), std::string::npos);
  EXPECT_NE(message_of("default: {spheres: all}").find("'all': expected at least 1 spheres"), std::string::npos);
  EXPECT_NE(message_of("default: {collision: boxes}").find("'boxes': expected hull, convex or spheres"),
            std::string::npos);
  EXPECT_NE(message_of("default: {faces: [500], gap: 5 miles}").find("is no length"), std::string::npos);
  EXPECT_NE(message_of("default: {gap: -1mm}").find("is no length"), std::string::npos);
  EXPECT_NE(message_of("default: {skip: maybe}").find("true or false"), std::string::npos);
  EXPECT_NE(message_of("- a\n- b").find("expected default, links"), std::string::npos);
  EXPECT_NE(message_of("links: [arm]").find("line 1"), std::string::npos);
  EXPECT_NE(message_of("links:\n  arm: {}\n  arm: {}").find("line 3: the link arm occurs twice"), std::string::npos);
  EXPECT_NE(message_of("links:\n  arm: {}\n  elbow: {}").find("budgets.yaml: line 3: crane has no link 'elbow'"),
            std::string::npos);
  EXPECT_NE(message_of("links:\n  [arm]: {}").find("line 2: '...': expected the name of a link"), std::string::npos);
  EXPECT_NE(message_of("default: {faces: [500").find("no YAML"), std::string::npos);
}

TEST(Budgets, RefuseSizesOfAnotherKind) {
  EXPECT_EQ(message_of("links:\n  arm: {collision: spheres, faces: [20]}"),
            "budgets.yaml: line 2: faces is for collision: hull; leave it out, or say so");
  EXPECT_TRUE(has(message_of("links:\n  arm: {pieces: 3}"), "pieces is for collision: convex"));
  EXPECT_TRUE(has(message_of("links:\n  arm: {vertices: 9}"), "vertices is for collision: convex"));
  EXPECT_TRUE(has(message_of("links:\n  arm: {collision: convex, spheres: 9}"), "spheres is for collision: spheres"));
  EXPECT_TRUE(has(message_of("default: {pieces: 3}\nlinks:\n  arm: {}"), "line 1: pieces is for collision: convex"));
  const std::string mixed = "default: {faces: 80, pieces: 3}\nlinks:\n  arm: {collision: convex}";
  EXPECT_EQ(read(mixed).budgets.at("arm").pieces, 3U) << "a default may be for some links only";
  EXPECT_EQ(read("default: {faces: 80}\nlinks:\n  arm: {collision: spheres, spheres: 9}").budget.faces[0], 80U);
}

TEST(Budgets, AreReadAsTheyWereWritten) {
  Robot robot{.name = "r", .links = {{.name = "arm: \"1\"\n"}, {.name = "empty"}}};
  robot.links[0].visual.resize(1);
  LinkHullOptions options;
  options.budget = {.faces = {500, 80}, .max_distance = 0.002, .padding = 0.0005};
  const std::string text = budgets_text(robot, options);
  EXPECT_EQ(text.find("empty"), std::string::npos);
  const LinkHullOptions again = read(text, 2, robot);
  EXPECT_EQ(again.budget, options.budget);
  ASSERT_EQ(again.budgets.size(), 1U);
  EXPECT_EQ(again.budgets.at(robot.links[0].name), options.budget);
}

TEST(Budgets, AreWrittenAsShortAsTheyCanBe) {
  Robot robot{.name = "r", .links = {{.name = "a"}, {.name = "b"}, {.name = "c"}}};
  for (Link& link : robot.links) link.visual.resize(1);
  LinkHullOptions options;
  options.budget = {.collision = Collision::Convex, .pieces = 4, .max_distance = 0.001, .skip = true};
  options.budgets["b"] = {.collision = Collision::Spheres};
  options.budgets["c"] = {};
  const std::string text = budgets_text(robot, options);
  EXPECT_NE(text.find("\n  \"a\": {pieces: 4, vertices: 64, max_distance: 1mm, skip: true}\n"), std::string::npos);
  EXPECT_NE(text.find("\n  \"b\": {collision: spheres, spheres: 64, max_distance: 0mm, skip: false}\n"),
            std::string::npos);
  const LinkHullOptions again = read(text, 1, robot);
  EXPECT_EQ(again.budget, options.budget);
  EXPECT_EQ(again.budget_of("a"), options.budget);
  EXPECT_EQ(again.budget_of("b"), (Budget{.collision = Collision::Spheres, .pieces = 4}));
  EXPECT_EQ(again.budget_of("c"), (Budget{.pieces = 4}));
}

TEST(LengthOf, TakesUnits) {
  EXPECT_EQ(length_of("0.5", "--allow"), 0.5);
  EXPECT_EQ(length_of("5mm", "--allow"), 5 * 0.001);
  EXPECT_EQ(length_of("2 cm", "--allow"), 2 * 0.01);
  for (const char* bad : {"", "mm", "5mmm", "nan", "inf", "-1", "1e400", "5mm "})
    EXPECT_THROW(length_of(bad, "--allow"), InputError) << bad;
}

}  // namespace
}  // namespace prohull::robot
