#include "robot/report/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "prohull/detail/rounded.h"
#include "prohull/error.h"
#include "prohull/sample.h"
#include "random.h"
#include "robot/files/xml.h"
#include "robot/report/pictures.h"
#include "robot/report/report_facts.h"
#include "robot/report/report_page.h"
#include "robot_folder.h"

namespace prohull::robot {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

RobotFile robot_of(const std::vector<std::string>& names) {
  RobotFile file;
  file.path = "arm.urdf";
  file.robot.name = "arm";
  for (const std::string& name : names) {
    file.robot.links.emplace_back();
    file.robot.links.back().name = name;
  }
  return file;
}

TriangleMesh scaled(TriangleMesh mesh, double factor) {
  for (Vec3& p : mesh.positions) p = factor * p;
  return mesh;
}

LinkHulls certified_hulls(std::size_t link) {
  LinkHulls hulls;
  hulls.link = link, hulls.status = LinkStatus::Hulled;
  hulls.triangles = make_sample("sphere", 300);
  hulls.sealed_volume = 4.0, hulls.convex_volume = 8.0;
  LinkHull hull;
  hull.target_faces = 100;
  hull.mesh = scaled(make_sample("sphere", 100), 1.2);
  hull.verdict.certified = hull.target_reached = true;
  hull.verdict.proof = "coverage", hull.source = "mesh";
  hull.verdict.distance_to_triangles = DistanceBounds{};
  hull.volume = 4.2;
  hulls.hulls.push_back(hull);
  return hulls;
}

/// Of links that have nothing to enclose.
std::vector<LinkHulls> empty_hulls(std::size_t links) {
  std::vector<LinkHulls> all(links);
  for (std::size_t i = 0; i < links; ++i) all[i].link = i;
  return all;
}

LinkCheck check_with(std::size_t link, CheckVerdict verdict) {
  LinkCheck check;
  check.link = link, check.verdict = verdict;
  if (verdict == CheckVerdict::Leaks) check.sticks_out_at_least = 0.81e-3, check.sticks_out_at_most = 0.83e-3;
  if (verdict == CheckVerdict::Undecided) check.sticks_out_at_most = 0.83e-3;
  return check;
}

ReportInput input_of(const RobotFile& file) {
  return {.file = file, .hulls = {}, .shipped = {}, .motion = {}, .allow = 0, .seconds = 1.5, .version = "1.2.3"};
}

/// A robot of which each link has another verdict.
ReportInput all_verdicts(const RobotFile& file) {
  ReportInput input = input_of(file);
  for (std::size_t i = 0; i < 6; ++i) input.shipped.push_back(check_with(i, CheckVerdict(i)));
  return input;
}

bool has(const std::string& text, std::string_view part) { return text.find(part) != text.npos; }

std::size_t count(const std::string& text, std::string_view part) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; at += part.size()) ++found;
  return found;
}

TEST(ReportFacts, ABoundStaysOneWhenItIsRounded) {
  EXPECT_EQ(length_text(0.00082341), "0.823 mm");
  EXPECT_EQ(length_text(0.00082341, Rounded::Up), "0.824 mm");
  EXPECT_EQ(length_text(0.00082391, Rounded::Down), "0.823 mm");
  EXPECT_EQ(length_text(0.00083, Rounded::Up), "0.830 mm");
  EXPECT_EQ(length_text(0.0123456), "12.3 mm");
  EXPECT_EQ(length_text(1.2345), "1.23 m");
  EXPECT_EQ(length_text(4.2e-6), "4.20 µm");
  EXPECT_EQ(length_text(0), "0 mm");
  EXPECT_EQ(length_text(kInfinity), "unbounded");
  EXPECT_EQ(range_text(0.00081, 0.00083), "0.810 to 0.830 mm");
  EXPECT_EQ(range_text(0.00081, 0.00081), "0.810 mm");
}

/// The number that a length says, in metres, as a reader of the text gets it.
double read_metres(const std::string& text) {
  const std::string number = text.substr(0, text.find(' '));
  const std::size_t e = std::min(number.find('e'), number.size());
  const int own = e < number.size() ? std::stoi(number.substr(e + 1)) : 0;
  const int of_unit = text.ends_with("mm") ? -3 : text.ends_with("µm") ? -6 : 0;
  return std::stod(number.substr(0, e) + "e" + std::to_string(own + of_unit));
}

TEST(ReportFacts, NoBoundIsRoundedToItsOtherSide) {
  EXPECT_GE(read_metres(length_text(0.000830000000001, Rounded::Up)), 0.000830000000001);
  EXPECT_GE(read_metres(length_text(4.2300000000001e-6, Rounded::Up)), 4.2300000000001e-6);
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> exponent(-22, 6);
  for (int i = 0; i < 2'000; ++i) {
    const double metres = std::pow(10, exponent(random)), coarse = nearest_of_digits(metres, 3);
    for (const double bound : {metres, coarse, std::nextafter(coarse, 0), std::nextafter(coarse, 1e9)}) {
      EXPECT_GE(read_metres(length_text(bound, Rounded::Up)), bound) << length_text(bound, Rounded::Up);
      EXPECT_LE(read_metres(length_text(bound, Rounded::Down)), bound) << length_text(bound, Rounded::Down);
    }
  }
}

TEST(ReportFacts, WhatSticksOutAsAllowedIsNotSaidToBeCovered) {
  const RobotFile file = robot_of({"a", "b"});
  ReportInput input = input_of(file);
  input.shipped = {check_with(0, CheckVerdict::Covered), check_with(1, CheckVerdict::Leaks)};
  input.allow = 2e-3;
  EXPECT_TRUE(findings_of(input)[0].good);
  EXPECT_EQ(findings_of(input)[0].text,
            "The shipped collision geometry covers the visual geometry of every link, or lets it stick out by at most "
            "2.00 mm.");
  input.shipped[1] = check_with(1, CheckVerdict::Undecided), input.allow = 0;
  input.shipped[1].rounding = input.shipped[1].sticks_out_at_most;
  EXPECT_EQ(findings_of(input)[0].text,
            "The shipped collision geometry covers the visual geometry of every link, but for rounding.");
  input.shipped.pop_back(), input.allow = 2e-3;
  EXPECT_EQ(findings_of(input)[0].text,
            "The shipped collision geometry covers the visual geometry of every link, exactly.");
}

TEST(ReportFacts, TheOneLinkWithAHullIsNotTheOneLink) {
  const RobotFile file = robot_of({"a", "b"});
  ReportInput input = input_of(file);
  input.hulls = empty_hulls(2), input.hulls[0] = certified_hulls(0);
  EXPECT_EQ(findings_of(input)[0].text,
            "The one link with a hull is certified: no point of its visual meshes lies outside of its hull.");
}

TEST(ReportFacts, CountsHaveSeparatorsAndPlurals) {
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(12003004), "12,003,004");
  EXPECT_EQ(counted(1, "link"), "1 link");
  EXPECT_EQ(counted(0, "link"), "0 links");
}

TEST(ReportFacts, CleanTextIsUtf8WithoutControlCharacters) {
  const std::string mark = "\xEF\xBF\xBD";
  EXPECT_EQ(clean_text("gr\xC3\xBC\xC3\x9F \xF0\x9F\xA4\x96"), "gr\xC3\xBC\xC3\x9F \xF0\x9F\xA4\x96");
  EXPECT_EQ(clean_text("gr\xFC\xDF"), "gr" + mark + mark);
  EXPECT_EQ(clean_text(std::string_view("a\0b\x1b\x7f", 5)), "a" + mark + "b" + mark + mark);
  EXPECT_EQ(clean_text("\xC0\xAF"), mark + mark) << "an overlong slash";
  EXPECT_EQ(clean_text("\xED\xA0\x80"), mark + mark + mark) << "a surrogate";
  EXPECT_EQ(clean_text("\xE2\x82"), mark + mark) << "cut off";
  EXPECT_EQ(clean_text("\xF8\x88\x80\x80\x80").size(), 5 * mark.size());
}

TEST(ReportFacts, AHullThatIsNotCertifiedIsAFailureAndALargeOneNeedsALook) {
  const RobotFile file = robot_of({"a", "b"});
  ReportInput input = input_of(file);
  input.hulls = {certified_hulls(0), certified_hulls(1)};
  EXPECT_TRUE(marks_of(input).empty());
  EXPECT_TRUE(findings_of(input).front().good);

  input.hulls[0].hulls[0].volume = 4.8;
  input.hulls[1].hulls[0].verdict.certified = false;
  const std::vector<Mark> marks = marks_of(input);
  ASSERT_EQ(marks.size(), 2);
  EXPECT_EQ(marks[0].severity, Severity::Look);
  EXPECT_EQ(marks[1].severity, Severity::Failure);
  EXPECT_FALSE(findings_of(input).front().good);
  EXPECT_EQ(totals_of(input).certified, 1);
}

TEST(ReportFacts, TrianglesThatAreLeftOutAreNotSaidToLieInside) {
  const RobotFile file = robot_of({"a"});
  ReportInput input = input_of(file);
  input.hulls = {certified_hulls(0)};
  input.hulls[0].non_finite_faces = 2;
  EXPECT_EQ(findings_of(input).front().text,
            "The one link is certified: no point of a finite triangle of its visual meshes lies outside of its hull.");
  EXPECT_EQ(report_json(input)["links"][0]["non_finite_faces"], 2);
}

TEST(ReportFacts, OpeningsAreToldWithTheDistanceFromTheTriangles) {
  const RobotFile file = robot_of({"a"});
  ReportInput input = input_of(file);
  input.hulls = {certified_hulls(0)};
  LinkHull& hull = input.hulls[0].hulls[0];
  const auto verdict = [&] { return report_json(input)["links"][0]["hulls"][0]["verdict"]; };
  EXPECT_TRUE(verdict()["distance_to_solid"].is_null()) << "nothing is known of one";
  hull.verdict.cap_faces = 2, hull.verdict.distance_to_solid = DistanceBounds{.upper = 0.25};
  hull.verdict.distance_to_triangles->lower = hull.verdict.distance_to_triangles->upper = 0.5;
  EXPECT_EQ(verdict()["distance_to_triangles"]["upper"], 0.5);
  EXPECT_EQ(verdict()["distance_to_solid"]["upper"], 0.25);
  EXPECT_EQ(verdict()["cap_faces"], 2);
}

TEST(ReportFacts, NoPlaceIsToldWhereNoneIsKnown) {
  const RobotFile file = robot_of({"a"});
  ReportInput input = input_of(file);
  input.shipped = {check_with(0, CheckVerdict::Covered)};
  DistanceBounds& reach = input.shipped[0].reach;
  reach = {0, 0.5, {1, 2, 3}};
  EXPECT_TRUE(report_json(input)["links"][0]["shipped"]["distance"]["farthest"].is_null());
  reach.lower = 0.25;
  EXPECT_EQ(report_json(input)["links"][0]["shipped"]["distance"]["farthest"], nlohmann::json({1., 2., 3.}));
}

TEST(ReportFacts, NoRatioHasTwentyDigits) {
  EXPECT_EQ(ratio_text(1.234), "1.23 ×");
  EXPECT_EQ(ratio_text(1.6e20), "> 10000 ×");
}

TEST(ReportFacts, PiecesAndSpheresAreCalledSo) {
  const RobotFile file = robot_of({"a"});
  ReportInput input = input_of(file);
  input.hulls = {certified_hulls(0)};
  LinkHull& cover = input.hulls[0].hulls[0];
  cover.volume = 6, cover.target_faces = 0, cover.source = "", cover.verdict.proof = "union";  // large, as covers are

  input.hulls[0].collision = Collision::Convex;
  cover.pieces = {make_sample("box", 12), make_sample("box", 12)};
  EXPECT_TRUE(marks_of(input).empty());
  EXPECT_EQ(findings_of(input).front().text,
            "The one link is certified: no point of its visual meshes lies outside of its convex pieces.");
  const nlohmann::json pieces = report_json(input)["links"][0];
  EXPECT_EQ(pieces["collision"], "convex");
  EXPECT_EQ(pieces["hulls"][0]["pieces"], 2);
  EXPECT_TRUE(pieces["hulls"][0]["spheres"].is_null());
  EXPECT_TRUE(pieces["hulls"][0]["target_faces"].is_null());
  EXPECT_TRUE(pieces["hulls"][0]["source"].is_null());
  EXPECT_TRUE(has(report_html(input), "inside of its translucent 2 convex pieces"));

  input.hulls[0].collision = Collision::Spheres;
  cover.pieces.clear(), cover.balls = {{{}, 1}, {{}, 2}, {{}, 3}}, cover.verdict.certified = false;
  ASSERT_EQ(marks_of(input).size(), 1U);
  EXPECT_EQ(marks_of(input)[0].text, "The union of 3 spheres is not certified: it may not enclose the link.");
  const nlohmann::json spheres = report_json(input)["links"][0];
  EXPECT_EQ(spheres["collision"], "spheres");
  EXPECT_EQ(spheres["hulls"][0]["spheres"], 3);
  EXPECT_TRUE(spheres["hulls"][0]["faces"].is_null());
  EXPECT_EQ(totals_of(input).balls, 3U);
}

TEST(ReportFacts, CollisionGeometryWithoutVisualGeometryNeedsALook) {
  RobotFile file = robot_of({"wall", "frame"});
  file.robot.links[0].collision.emplace_back();
  ReportInput input = input_of(file);
  input.hulls = empty_hulls(2);
  const std::vector<Mark> marks = marks_of(input);
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_EQ(marks[0].link, 0U);
  EXPECT_EQ(marks[0].severity, Severity::Look);
  EXPECT_TRUE(has(marks[0].text, "collision geometry only"));
  EXPECT_EQ(findings_of(input)[0].text,
            "No hull was made: 1 link has collision geometry only, which --from collision takes.");
}

TEST(ReportFacts, WhereNoHullWasMadeAReasonIsTold) {
  const RobotFile file = robot_of({"a", "b", "c"});
  ReportInput input = input_of(file);
  input.hulls = empty_hulls(3);
  EXPECT_EQ(why_no_hull(input), "no link has visual geometry");
  input.from = Geometry::Collision;
  EXPECT_EQ(why_no_hull(input), "no link has collision geometry");
  input.hulls[0].status = input.hulls[1].status = LinkStatus::Primitives;
  input.hulls[2].status = LinkStatus::Skipped, input.hulls[2].why = "as its budget says";
  EXPECT_EQ(why_no_hull(input),
            "2 links have primitives only, which are kept; 1 link is left as it is, with nothing proven");
}

TEST(ReportFacts, AMissedCollisionIsAFailure) {
  const RobotFile file = robot_of({"a", "b"});
  ReportInput input = input_of(file);
  input.motion.emplace();
  input.motion->pairs.push_back({.b = 1, .visual = 3, .hull = 2, .missed = 1});
  EXPECT_EQ(totals_of(input).failures, 1);
  EXPECT_FALSE(findings_of(input).back().good);
  EXPECT_TRUE(has(report_html(input, {.pictures = false}), "✕ 1"));
}

TEST(ReportJson, HasAnEntryForEachLinkAndNoNumberThatIsNone) {
  const RobotFile file = robot_of({"a", "b"});
  ReportInput input = input_of(file);
  input.hulls = {certified_hulls(0), {}};
  input.hulls[1].link = 1;
  input.hulls[0].sealed_volume = kNan;
  input.hulls[0].hulls[0].verdict.distance_to_triangles->upper = kInfinity;
  input.shipped = {check_with(0, CheckVerdict::Leaks), check_with(1, CheckVerdict::NoVisual)};
  input.shipped[0].worst_point = {kNan, 0, 1};
  const nlohmann::json report = nlohmann::json::parse(report_json(input).dump());
  ASSERT_EQ(report["links"].size(), 2);
  EXPECT_EQ(report["links"][0]["status"], "hulled");
  EXPECT_TRUE(report["links"][0]["sealed_volume"].is_null());
  EXPECT_TRUE(report["links"][0]["hulls"][0]["volume_ratio"].is_null());
  EXPECT_TRUE(report["links"][0]["hulls"][0]["verdict"]["distance_to_triangles"]["upper"].is_null());
  EXPECT_EQ(report["links"][0]["shipped"]["verdict"], "leaks");
  EXPECT_TRUE(report["links"][0]["shipped"]["worst_point"][0].is_null());
  EXPECT_FALSE(report["links"][1]["shipped"].contains("sticks_out")) << "nothing was measured";
  EXPECT_EQ(report["totals"]["certified"], 1);
  EXPECT_NEAR(report["totals"]["median_convex_ratio"].get<double>(), 4.2 / 8, 1e-12);
}

TEST(ReportJson, TellsWhenItWasMadeAndFromWhatAndWhichPositionsCount) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "sign";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "part.gltf") << R"({"buffers": [{"uri": "part.bin"}]})";
  for (const char* const name : {"arm.urdf", "part.bin", "common.urdf"}) std::ofstream(folder / name) << "";
  RobotFile file = robot_of({"base", "hand", "finger"});
  file.path = folder / "arm.urdf", file.included = {folder / "common.urdf"};
  file.robot.links[0].visual.push_back({.form = MeshFile{.uri = "part.gltf", .path = folder / "part.gltf"}});
  file.robot.links[1].collision.push_back({.form = MeshFile{.uri = "gone.stl", .path = folder / "gone.stl"}});
  file.robot.joints = {{.name = "slide", .type = JointType::Prismatic, .child = 1, .lower = 0, .upper = 2},
                       {.name = "same", .type = JointType::Prismatic, .parent = 1, .child = 2, .lower = 0, .upper = 1}};
  file.robot.joints[1].mimic = Mimic{.joint = 0};
  ReportInput input = input_of(file);
  setenv("SOURCE_DATE_EPOCH", "86400", 1);
  sign(input, {""});
  unsetenv("SOURCE_DATE_EPOCH");
  const nlohmann::json report = report_json(input);
  EXPECT_EQ(report["date"], "1970-01-02T00:00:00Z");
  std::vector<std::string> names;
  for (const nlohmann::json& source : report["sources"])
    names.push_back(std::filesystem::path(source["file"]).filename().string());
  EXPECT_EQ(names, (std::vector<std::string>{"arm.urdf", "common.urdf", "gone.stl", "part.bin", "part.gltf"}));
  EXPECT_EQ(report["sources"][0]["xxh128"], "99aa06d3014798d86001c324468d497f") << "of an empty file, by xxhsum -H128";
  EXPECT_EQ(report["sources"][2]["xxh128"], "") << "it cannot be read";
  EXPECT_NEAR(report["joints"][0]["upper"], 1, 1e-9) << "where the joint that follows is within its limits";
  EXPECT_EQ(report["joints"][1]["follows"], "slide");
  const std::string page = report_html(input, {.pictures = false});
  EXPECT_TRUE(has(page, "1970-01-02T00:00:00Z"));
  EXPECT_TRUE(has(page, "99aa06d3014798d86001c324468d497f"));
  EXPECT_TRUE(has(page, "1 m"));
}

TEST(ReportPage, LinksThatNeedALookAreOpenAndTheOthersFolded) {
  const RobotFile file = robot_of({"a", "b", "c", "d"});
  ReportInput input = input_of(file);
  for (std::size_t i = 0; i < 4; ++i) input.shipped.push_back(check_with(i, CheckVerdict::Covered));
  EXPECT_EQ(count(report_html(input, {.pictures = false}), "<details class=\"card\" open>"), 0);
  input.shipped[2] = check_with(2, CheckVerdict::Leaks);
  const std::string page = report_html(input, {.pictures = false});
  EXPECT_EQ(count(page, "<details class=\"card\" open>"), 1);
  EXPECT_LT(page.find("<details class=\"card\" open>"), page.find("id=\"link-2\""));
}

TEST(ReportJson, CanBeWrittenWhateverBytesTheRobotHas) {
  RobotFile file = robot_of({"\xFF\xFE", "a\x01"});
  file.robot.name = "\xC3", file.notes = {"\x80"};
  file.path = "\xFF.urdf";
  EXPECT_NO_THROW((void)report_json(input_of(file)).dump());
}

TEST(ReportJunit, HasACaseForEachLinkAndAFailureForEachThatDoesNotPass) {
  const RobotFile file = robot_of({"covered", "leaks", "undecided", "bare", "frame", "lost"});
  const std::string text = report_junit(all_verdicts(file));
  const XmlDocument document(text, "report.xml");
  const XmlElement& suites = document.root();
  EXPECT_EQ(suites.name, "testsuites");
  EXPECT_EQ(*suites.attribute("failures"), "3");
  EXPECT_EQ(*suites.attribute("errors"), "1");
  EXPECT_EQ(*suites.attribute("skipped"), "1");
  ASSERT_EQ(suites.children.size(), 1);
  const auto& cases = suites.children[0]->children;
  ASSERT_EQ(cases.size(), 6);
  EXPECT_TRUE(cases[0]->children.empty());
  for (const std::size_t failed : {1u, 2u, 3u}) {
    ASSERT_TRUE(cases[failed]->child("failure")) << failed;
    EXPECT_EQ(*cases[failed]->child("failure")->attribute("type"), name_of(CheckVerdict(failed)));
  }
  EXPECT_TRUE(has(*cases[1]->child("failure")->attribute("message"), "0.810 to 0.830 mm"));
  EXPECT_TRUE(cases[4]->child("skipped"));
  ASSERT_TRUE(cases[5]->child("error"));
  EXPECT_EQ(*cases[5]->child("error")->attribute("type"), "missing");
}

TEST(ReportJunit, WhatIsAllowedPasses) {
  const RobotFile file = robot_of({"covered", "leaks", "undecided", "bare", "frame", "lost"});
  ReportInput input = all_verdicts(file);
  input.allow = 1e-3;
  EXPECT_EQ(count(report_junit(input), "<failure"), 1) << "what has no collision geometry";
  EXPECT_EQ(count(report_junit(input), "<error "), 1) << "what has no file";
}

TEST(ReportJunit, AHullThatIsNotCertifiedFails) {
  const RobotFile file = robot_of({"a"});
  ReportInput input = input_of(file);
  input.hulls = {certified_hulls(0)};
  EXPECT_EQ(count(report_junit(input), "<failure"), 0);
  input.hulls[0].hulls[0].verdict.certified = false;
  EXPECT_EQ(count(report_junit(input), "<failure"), 1);
}

TEST(ReportJunit, CountsWhatWasNotCheckedAsErrors) {
  const RobotFile file = robot_of({"lost", "leaks"});
  ReportInput input = input_of(file);
  input.shipped = {check_with(0, CheckVerdict::Missing), check_with(1, CheckVerdict::Leaks)};
  const std::string junit = report_junit(input);
  EXPECT_EQ(count(junit, "<error "), 1);
  EXPECT_EQ(count(junit, "<failure "), 1);
  EXPECT_EQ(count(junit, " failures=\"1\" errors=\"1\" skipped=\"0\""), 2) << "of the robot and of the suite";
}

TEST(ReportJunit, IsXmlWhateverBytesTheRobotHas) {
  RobotFile file = robot_of({"<a> & \"b\" 'c' \xFF\x01"});
  file.robot.name = "]]>\xFF";
  ReportInput input = input_of(file);
  input.shipped = {check_with(0, CheckVerdict::Leaks)};
  input.shipped[0].notes = {"</failure> & \x02"};
  const XmlDocument document(report_junit(input), "report.xml");
  EXPECT_EQ(*document.root().children[0]->children[0]->attribute("name"), "<a> & \"b\" 'c' \xEF\xBF\xBD\xEF\xBF\xBD");
}

TEST(ReportPage, IsOneFileThatLoadsNothingAndTellsItsProgress) {
  const RobotFile file = robot_of({"covered", "leaks", "undecided", "bare", "frame", "lost"});
  ReportInput input = all_verdicts(file);
  input.shipped[1].visual = make_sample("sphere", 100), input.shipped[1].collision = make_sample("box", 12);
  double last = 0;
  const Progress forward = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "draw");
    EXPECT_GE(fraction, last);
    last = fraction;
    return true;
  };
  const std::string page = report_html(input, {.threads = 1, .progress = forward});
  EXPECT_EQ(count(page, "<img"), 2) << "the robot, and the link that has meshes";
  EXPECT_EQ(count(page, "src="), 2);
  EXPECT_EQ(count(page, " src=\"data:image/png;base64,iVBORw0KGgo"), 2);
  EXPECT_EQ(count(page, " alt=\""), 2);
  EXPECT_TRUE(has(page, "sticks out farthest"));
  for (const std::string_view loads : {"<script", "<link", "http:", "https:", "url(", "@import"})
    EXPECT_FALSE(has(page, loads)) << loads;
  EXPECT_DOUBLE_EQ(last, 1);
}

TEST(ReportPage, ShowsTextsOfTheRobotAndInterpretsNone) {
  const std::string evil = "<script>alert('x')</script> & \"q\" \xFF";
  RobotFile file = robot_of({evil, evil});
  file.robot.name = evil, file.notes = {evil}, file.path = evil;
  ReportInput input = input_of(file);
  input.hulls = {certified_hulls(0), {}};
  input.hulls[0].repairs = {evil}, input.hulls[0].hulls[0].notes = {evil};
  input.hulls[0].hulls[0].source = evil;
  input.hulls[1].link = 1, input.hulls[1].status = LinkStatus::Skipped, input.hulls[1].why = evil;
  input.shipped = {check_with(0, CheckVerdict::Leaks)};
  input.shipped[0].notes = {evil};
  input.version = evil;
  input.motion.emplace();
  input.motion->pairs.push_back({.b = 1, .visual = 3, .missed = 1});
  const std::string page = report_html(input, {.pictures = false});
  EXPECT_FALSE(has(page, "<script"));
  EXPECT_FALSE(has(page, "\xFF"));
  EXPECT_TRUE(has(page, "&lt;script&gt;alert(&apos;x&apos;)&lt;/script&gt; &amp; &quot;q&quot; \xEF\xBF\xBD"));
}

TEST(ReportPage, LinksToAPageThatShowsTheRobot) {
  const RobotFile file = robot_of({"covered", "leaks", "undecided", "bare", "frame", "lost"});
  const ReportInput input = all_verdicts(file);
  EXPECT_TRUE(has(report_html(input, {.pictures = false, .view = "view.html"}), "<a href=\"view.html\">"));
  EXPECT_TRUE(has(report_html(input, {.pictures = false, .view = "\"><b>"}), "<a href=\"&quot;&gt;&lt;b&gt;\">"));
  EXPECT_FALSE(has(report_html(input, {.pictures = false}), "Turn the robot around"));
}

TEST(ReportPage, LinksLeadToCardsThatExist) {
  const RobotFile file = robot_of({"covered", "leaks", "undecided", "bare", "frame", "lost"});
  const std::string page = report_html(all_verdicts(file), {.pictures = false});
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string id = "link-" + std::to_string(i);
    EXPECT_EQ(has(page, "href=\"#" + id + "\""), has(page, "id=\"" + id + "\"")) << id;
  }
  EXPECT_FALSE(has(page, "id=\"link-4\"")) << "it has no geometry";
}

TEST(ReportPage, StopsWhenAsked) {
  const RobotFile file = robot_of({"a"});
  ReportInput input = input_of(file);
  input.hulls = {certified_hulls(0)};
  EXPECT_THROW((void)report_html(input, {.progress = [](std::string_view, double) { return false; }}), Cancelled);
}

TEST(Pictures, NothingToDrawIsAnEmptyPicture) {
  TriangleMesh point;
  point.positions = {{1, 2, 3}};
  point.triangles.push_back({});
  TriangleMesh lost = point;
  lost.positions[VertexId{}].x = kNan;
  const std::vector<Picture> pictures{{}, {lost, {}, Shell::Hull, {}}, {point, lost, Shell::Shipped, {}}};
  for (const Picture& picture : pictures) EXPECT_EQ(draw_pictures({&picture, 1}), std::vector<std::string>{""});
  EXPECT_TRUE(draw_pictures({}).empty());
}

TEST(Pictures, TrianglesThatAreNotFiniteAreLeftOut) {
  const PictureOptions small{.width = 48, .height = 36};
  Picture whole{make_sample("sphere", 100), make_sample("box", 12), Shell::Shipped, {}};
  const std::string clean = draw_pictures({&whole, 1}, small).front();
  ASSERT_TRUE(clean.starts_with("\x89PNG"));
  const VertexId lost = whole.inside.positions.push_back({kNan, 0, kInfinity});
  whole.inside.triangles.push_back({VertexId{0}, VertexId{1}, lost});
  whole.marked = Vec3{kNan, 0, 0};
  EXPECT_EQ(draw_pictures({&whole, 1}, small).front(), clean);
}

TEST(Pictures, AreTheSameForAnyNumberOfThreads) {
  const Picture picture{make_sample("sphere", 100), make_sample("box", 12), Shell::Hull, Vec3{1, 0, 0}};
  EXPECT_EQ(draw_pictures({&picture, 1}, {.width = 96, .height = 72, .threads = 1}),
            draw_pictures({&picture, 1}, {.width = 96, .height = 72, .threads = 4}));
}

TEST(Pictures, AreTheSameFromACacheWhoseFilesMayBeBroken) {
  const RobotFolder folder;
  const std::vector<Picture> pictures{{make_sample("box", 12), {}, Shell::Hull, {}},
                                      {{}, make_sample("box", 12), Shell::Hull, {}}};
  PictureOptions options{.width = 48, .height = 36};
  const std::vector<std::string> drawn = draw_pictures(pictures, options);
  options.cache = folder.path();
  for (int run = 0; run < 2; ++run) EXPECT_EQ(draw_pictures(pictures, options), drawn);
  std::size_t kept = 0;
  for (const auto& file : std::filesystem::directory_iterator(options.cache)) {
    std::ofstream(file.path(), std::ios::binary) << "broken, and longer than a fingerprint";
    ++kept;
  }
  EXPECT_EQ(kept, 2U);
  EXPECT_EQ(draw_pictures(pictures, options), drawn);
}

TEST(Pictures, AMarkedPointIsSeen) {
  const PictureOptions small{.width = 48, .height = 36};
  Picture picture{make_sample("sphere", 100), {}, Shell::Shipped, {}};
  const std::string plain = draw_pictures({&picture, 1}, small).front();
  picture.marked = Vec3{0, 1, 0};  // behind, as long as the view does not turn
  EXPECT_NE(draw_pictures({&picture, 1}, small).front(), plain);
}

}  // namespace
}  // namespace prohull::robot
