#include "robot/check/disabled_pairs.h"

#include <gtest/gtest.h>

#include "robot/report/report.h"
#include "robot_testing.h"

namespace prohull::robot::of_disabled_pairs {
namespace {

/// Cubes of side 1, each of which slides out of the one before; they are 3 apart at rest, and the visual ones are
/// smaller.
const char* const kRobot = R"(<robot name="r">
  <link name="a"><collision><geometry><box size="1 1 1"/></geometry></collision>
                 <visual><geometry><box size="0.5 0.5 0.5"/></geometry></visual></link>
  <link name="b"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <link name="c"><collision><geometry><box size="1 1 1"/></geometry></collision>
                 <visual><geometry><box size="0.5 0.5 0.5"/></geometry></visual></link>
  <link name="d"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <link name="e"><collision><geometry><mesh filename="lost.stl"/></geometry></collision></link>
  <joint name="p" type="prismatic"><parent link="a"/><child link="b"/><origin xyz="3 0 0"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/></joint>
  <joint name="q" type="prismatic"><parent link="b"/><child link="c"/><origin xyz="0 0 3"/><axis xyz="-1 0 0"/>
    <limit lower="0" upper="REACH" effort="1" velocity="1"/></joint>
  <joint name="r" type="fixed"><parent link="c"/><child link="d"/><origin xyz="0 0 -3"/></joint>
  <joint name="s" type="continuous"><parent link="d"/><child link="e"/></joint>
</robot>)";

RobotFile robot_with_reach(const std::string& reach) {
  std::string text = kRobot;
  text.replace(text.find("REACH"), 5, reach);
  return read_robot(text, "r.urdf");
}

std::string row(const std::string& a, const std::string& b, const std::string& reason) {
  return "<disable_collisions link1=\"" + a + "\" link2=\"" + b + "\" reason=\"" + reason + "\"/>\n";
}

const std::string kSrdf = "<robot name=\"r\">\n" + row("d", "a", "Never") + row("a", "b", "Adjacent") +
                          row("a", "c", "Never") + row("a", "head", "Never") + row("a", "a", "Never") +
                          row("a", "e", "Never") + row("a", "d", "User") + row("d", "b", "Never") + "</robot>";

std::vector<DisabledCheck> checks_with(const RobotFile& file) {
  return check_disabled_pairs(file.robot, read_srdf(file.robot, kSrdf, "r.srdf").rows);
}

TEST(DisabledPairs, AreDecidedRowByRow) {
  const RobotFile file = robot_with_reach("1.5");  // d is at least 0.5 from a
  const std::vector<DisabledCheck> checks = checks_with(file);
  ASSERT_EQ(checks.size(), 8U);
  EXPECT_EQ(checks[0].row.link1, "d");
  EXPECT_EQ(checks[0].row.line, 2U);
  EXPECT_EQ(checks[0].collision.verdict, PairVerdict::Never);
  EXPECT_EQ(checks[0].visual.verdict, PairVerdict::NoGeometry);
  EXPECT_EQ(checks[1].collision.verdict, PairVerdict::Adjacent);
  EXPECT_EQ(checks[2].collision.verdict, PairVerdict::Never);
  EXPECT_EQ(checks[2].visual.verdict, PairVerdict::Never);
  EXPECT_EQ(checks[3].collision.verdict, PairVerdict::Unknown);
  EXPECT_EQ(checks[4].collision.verdict, PairVerdict::Unknown);
  EXPECT_EQ(checks[5].collision.verdict, PairVerdict::Open);
  EXPECT_TRUE(has(checks[5].collision.why, "lost.stl"));
  for (std::size_t i = 0; i < 7; ++i) EXPECT_FALSE(checks[i].is_refuted()) << i;
}

TEST(DisabledPairs, AreRefutedWhereTheyMeetUnlessTheirReasonAllowsForIt) {
  const RobotFile file = robot_with_reach("2.75");
  const std::vector<DisabledCheck> checks = checks_with(file);
  EXPECT_EQ(checks[0].collision.verdict, PairVerdict::Meets);
  EXPECT_TRUE(checks[0].is_refuted());
  const std::vector<double>& positions = checks[0].collision.positions;
  EXPECT_LE(3 + positions[0] - positions[1], 1) << "the cubes overlap";
  EXPECT_FALSE(checks[2].is_refuted());
  EXPECT_EQ(checks[6].collision.verdict, PairVerdict::Meets);
  EXPECT_FALSE(checks[6].is_refuted()) << "the user disabled it";
  EXPECT_EQ(checks[7].collision.verdict, PairVerdict::Meets) << "b and d are at the same height";
  EXPECT_TRUE(checks[7].is_refuted());
}

TEST(DisabledPairs, AreDecidedWhereTwoJointsMoveBetweenThem) {
  std::string text = kRobot;  // without b's geometry, two joints lead from a to c
  const std::size_t begin = text.find("<link name=\"b\">"), end = text.find("<link name=\"c\">");
  text.replace(begin, end - begin, "<link name=\"b\"/>");
  text.replace(text.find("REACH"), 5, "2.75");
  text.replace(text.find("xyz=\"0 0 3\""), 11, "xyz=\"0 0 0\"");
  const RobotFile file = read_robot(text, "r.urdf");
  const std::string srdf = "<robot name=\"r\">" + row("a", "c", "Never") + row("a", "b", "Adjacent") + "</robot>";
  const auto checks = check_disabled_pairs(file.robot, read_srdf(file.robot, srdf, "r.srdf").rows);
  EXPECT_EQ(checks[0].collision.verdict, PairVerdict::Meets);
  EXPECT_TRUE(checks[0].is_refuted());
  EXPECT_EQ(checks[1].collision.verdict, PairVerdict::Adjacent);
}

TEST(DisabledPairs, AreThoseByDefaultToo) {
  const RobotFile file = robot_with_reach("1");
  const std::string srdf =
      "<robot name=\"r\"><disable_default_collisions link=\"a\"/>" + row("a", "d", "User") +
      "<enable_collisions link1=\"c\" link2=\"a\"/><disable_default_collisions link=\"x\"/></robot>";
  const std::vector<DisabledRow> rows = read_srdf(file.robot, srdf, "r.srdf").rows;
  std::vector<std::string> pairs;
  for (const DisabledRow& r : rows) pairs.push_back(r.link1 + " " + r.link2 + " " + r.reason);
  EXPECT_EQ(pairs,
            (std::vector<std::string>{"a d User", "a b disable_default_collisions", "a e disable_default_collisions",
                                      "x all others disable_default_collisions"}));
  EXPECT_EQ(disabled_pairs(file.robot, srdf, "r.srdf"), (std::vector<LinkPair>{{0, 1}, {0, 3}, {0, 4}}));
}

TEST(DisabledPairs, AreReadFromTheFileOfThisRobot) {
  const RobotFile file = robot_with_reach("1");
  const auto read = [&](const std::string& content) {
    return read_srdf(file.robot, "<robot name=\"s\">" + content + "</robot>", "s.srdf");
  };
  const Srdf other = read(row("a", "d", "User") + row("a", "x", "Never"));
  EXPECT_EQ(other.pairs(), (std::vector<LinkPair>{{0, 3}}));
  EXPECT_EQ(other.notes, std::vector<std::string>{"s.srdf: it is of the robot 's', not of 'r'"});
  EXPECT_TRUE(read_srdf(file.robot, kSrdf, "r.srdf").notes.empty());
  EXPECT_EQ(read("").notes.size(), 1U) << "it disables nothing";
  EXPECT_TRUE(read("<group name=\"arm\"/>").rows.empty());
  EXPECT_TRUE(has(refusal_of([&] { read(row("x", "y", "Never") + row("a", "x", "Never") + row("a", "a", "Never")); }),
                  "no row of it names two links of this robot: it is of the robot 's', not of 'r'"));
  EXPECT_TRUE(has(refusal_of([&] { read_srdf(file.robot, kRobot, "r.urdf"); }), "it has no element of an SRDF file"));
}

TEST(DisabledPairs, TellAReasonThatIsRefuted) {
  for (const auto& [reach, is_wrong] : {std::pair("1", true), std::pair("2.75", false)}) {
    const RobotFile file = robot_with_reach(reach);
    const std::string srdf = "<robot name=\"r\">" + row("a", "d", "Always") + row("a", "d", "Never") + "</robot>";
    const auto checks = check_disabled_pairs(file.robot, read_srdf(file.robot, srdf, "r.srdf").rows);
    EXPECT_EQ(checks[0].has_refuted_reason(), is_wrong);
    EXPECT_FALSE(checks[0].is_refuted());
    EXPECT_FALSE(checks[1].has_refuted_reason());
  }
}

TEST(DisabledPairs, AreInReports) {
  const RobotFile file = robot_with_reach("2.75");
  ReportInput input{.file = file, .hulls = {}, .shipped = {}, .motion = {}, .allow = 0, .seconds = 0, .version = "1"};
  input.disabled = checks_with(file);
  const nlohmann::json rows = report_json(input)["disabled_pairs"];
  ASSERT_EQ(rows.size(), 8U);
  EXPECT_EQ(rows[0]["links"], (nlohmann::json{"d", "a"}));
  EXPECT_EQ(rows[0]["refuted"], true);
  EXPECT_EQ(rows[0]["collision"]["verdict"], "meets");
  EXPECT_TRUE(rows[0]["collision"]["witness"]["positions"].contains("p"));
  EXPECT_EQ(rows[3]["collision"]["verdict"], "unknown");
  const std::string junit = report_junit(input);
  EXPECT_TRUE(has(junit, "<testsuite name=\"r: disabled pairs\" tests=\"8\" failures=\"2\" errors=\"0\" skipped=\"3\""))
      << junit;
  EXPECT_TRUE(has(junit, "<failure type=\"meets\" message=\"the collision geometry meets at p "));
  const std::string page = report_html(input, {.pictures = false});
  EXPECT_TRUE(has(page, "Pairs that the SRDF disables"));
  EXPECT_TRUE(has(page, "2 disabled pairs of the SRDF are refuted"));
}

}  // namespace
}  // namespace prohull::robot::of_disabled_pairs
