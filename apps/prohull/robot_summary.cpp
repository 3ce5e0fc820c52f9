#include "robot_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "console.h"
#include "prohull/detail/rounded.h"
#include "robot/motion/joint_chain.h"
#include "robot/report/report_facts.h"

namespace prohull::cli {
namespace {

using namespace prohull::robot;

std::string millimetres(double length) { return fmt::format("{:.6g} mm", 1000 * length); }
std::string at_most(double length) { return fmt::format("{:.3g} mm", 1000 * rounded_up(length, 3)); }
std::string at_least(double length) { return fmt::format("{:.3g} mm", 1000 * rounded_down(length, 3)); }

/// Columns as wide as their widest cell; the first is aligned to the left.
class Table {
 public:
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

  std::string text() const {
    std::vector<std::size_t> widths;
    for (const auto& row : rows_)
      for (std::size_t i = 0; i < row.size(); ++i) {
        if (i == widths.size()) widths.push_back(0);
        widths[i] = std::max(widths[i], row[i].size());
      }
    std::string text;
    for (const auto& row : rows_) {
      std::string line = "  ";
      for (std::size_t i = 0; i < row.size(); ++i)
        line += i == 0 ? fmt::format("{:<{}}", row[i], widths[i]) : fmt::format("  {:>{}}", row[i], widths[i]);
      text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
  }

 private:
  std::vector<std::vector<std::string>> rows_;
};

std::string ratio(double a, double b) { return b > 0 ? times_text(a / b) : "-"; }

/// "500" faces of a hull, "8 pieces" or "64 spheres"
std::string size_of(const LinkHull& hull) {
  if (!hull.pieces.empty()) return counted(hull.pieces.size(), "piece");
  if (!hull.balls.empty()) return counted(hull.balls.size(), "sphere");
  return grouped(hull.mesh.face_count());
}

void add_hulls(Table& table, const Link& link, const LinkHulls& made) {
  for (const LinkHull& hull : made.hulls)
    table.add({link.name, grouped(made.triangles.face_count()), size_of(hull),
               (made.is_estimated && made.sealed_volume > 0 ? "~ " : "") + ratio(hull.volume, made.sealed_volume),
               ratio(hull.volume, made.convex_volume), at_most(hull.verdict.distance().upper),
               hull.certified() ? "yes" : "NO"});
  if (made.status == LinkStatus::Primitives) table.add({link.name, "primitives, kept"});
  if (!made.why.empty()) table.add({link.name, "left as it is"});
}

std::string notes_text(const std::string& link, const LinkHull& hull, bool has_others) {
  const std::string which = has_others ? fmt::format("{}, {} faces", link, hull.target_faces) : link;
  std::string text;
  if (!hull.within_bounds)
    text += fmt::format("  {}: NOT within the distance asked for: {}\n", which, at_most(hull.verdict.distance().upper));
  if (const std::string from_triangles = at_most(hull.verdict.distance_to_triangles->upper);
      hull.has_openings() && from_triangles != at_most(hull.verdict.distance().upper))
    text += fmt::format("  {}: its openings count as closed, and from its triangles alone it reaches at most {}\n",
                        which, from_triangles);
  for (const std::string& note : hull.notes) text += fmt::format("  {}: {}\n", which, note);
  return text;
}

/// A line with the number of links, what holds of them, and the first names.
std::string links_text(std::span<const std::string> links, std::string_view one, std::string_view many) {
  if (links.empty()) return "";
  return fmt::format("  {}: {}\n", counted(links.size(), one, many), first_of(links));
}

/// Nothing else in the summary is about these links.
std::string collision_only_text(const ReportInput& facts) {
  std::vector<std::string> links;
  for (const LinkHulls& made : facts.hulls)
    if (has_collision_only(facts, made)) links.push_back(facts.file.robot.links[made.link].name);
  return links_text(links, "link has collision geometry only, which it keeps, and nothing about it was looked at",
                    "links have collision geometry only, which they keep, and nothing about them was looked at");
}

std::string hulls_text(const ReportInput& facts) {
  Table table;
  const bool has_hulls = cover_words(facts.hulls) == "hulls";
  table.add({"link", "faces", has_hulls ? "hull" : "cover", "/ part", "/ convex", "reach", "certified"});
  for (const LinkHulls& made : facts.hulls) add_hulls(table, facts.file.robot.links[made.link], made);
  std::string text = table.text();
  if (std::ranges::any_of(facts.hulls, [](const LinkHulls& made) {
        return made.is_estimated && !made.hulls.empty() && made.sealed_volume > 0;
      }))
    text += "  ~: the volume of the part is estimated, by a wrap\n";
  for (const LinkHulls& made : facts.hulls) {
    const std::string& name = facts.file.robot.links[made.link].name;
    if (!made.why.empty()) text += fmt::format("  {}: left as it is: {}\n", name, made.why);
    if (made.non_finite_faces > 0)
      text += fmt::format(
          "  {}: {} left out\n", name,
          counted(made.non_finite_faces, "triangle that is not finite was", "triangles that are not finite were"));
    for (const LinkHull& hull : made.hulls) text += notes_text(name, hull, made.hulls.size() > 1);
  }
  return text + collision_only_text(facts) +
         links_text(facts.without_spheres,
                    "link has geometry but no spheres, and planners that read these see none of it",
                    "links have geometry but no spheres, and planners that read these see none of it");
}

/// How a link stands, as a word of the table, and where links are counted.
struct StandingWords {
  std::string_view word, counted;
};

StandingWords words_for(const LinkCheck& check, double allow) {
  static constexpr StandingWords kWords[]{{"covered", "covered"},
                                          {"covered, but for rounding", "covered"},
                                          {"within the allowance", "within the allowance"},
                                          {"LEAKS", "leaking"},
                                          {"UNDECIDED", "undecided"},
                                          {"NO COLLISION GEOMETRY", "without collision geometry"},
                                          {"no visual geometry", ""},
                                          {"NOT CHECKED", "not checked"}};
  return kWords[static_cast<std::size_t>(standing(check, allow))];
}

/// "3 links covered, 3 leaking, 1 undecided": of all links with something to cover; empty if there are none.
std::string counts_text(std::span<const LinkCheck> checks, double allow) {
  const auto count = [&](std::string_view word) {
    return static_cast<std::size_t>(
        std::ranges::count(checks, word, [&](const LinkCheck& check) { return words_for(check, allow).counted; }));
  };
  if (count("") == checks.size()) return "";
  std::string text = counted(count("covered"), "link") + " covered";
  for (const std::string_view word :
       {"within the allowance", "leaking", "undecided", "without collision geometry", "not checked"})
    if (const std::size_t links = count(word); links > 0) text += fmt::format(", {} {}", grouped(links), word);
  return text;
}

std::string leak_text(const LinkCheck& check) {
  if (check.verdict == CheckVerdict::Covered) return "0";
  return check.sticks_out_at_least > 0 ? at_least(check.sticks_out_at_least)
                                       : "<= " + at_most(check.sticks_out_at_most);
}

std::string shipped_text(const ReportInput& facts) {
  const std::string counts = counts_text(facts.shipped, facts.allow);
  if (counts.empty()) return "";
  const auto leak = [](const LinkCheck& check) {
    const bool leaks = check.verdict == CheckVerdict::Leaks;
    return std::tuple(leaks, check.sticks_out_at_least, check.sticks_out_at_most);
  };
  const LinkCheck& worst = *std::ranges::max_element(facts.shipped, {}, leak);
  if (worst.verdict != CheckVerdict::Leaks) return fmt::format("  shipped collision geometry: {}\n", counts);
  return fmt::format("  shipped collision geometry: {}; the worst is {}, by {}\n", counts,
                     facts.file.robot.links[worst.link].name, leak_text(worst));
}

std::string motion_text(const MotionResult& motion, std::string_view covers, bool sampled_pairs) {
  const auto sampled = static_cast<std::size_t>(
      std::ranges::count_if(motion.pairs, [](const MotionPair& pair) { return is_sampled(pair.kind); }));
  const auto adjacent =
      static_cast<std::size_t>(std::ranges::count(motion.pairs, PairKind::Adjacent, &MotionPair::kind));
  const PairVerdicts verdicts = verdicts_of(motion);
  std::string srdf;
  if (verdicts.all() > 0)
    srdf += fmt::format("  {} not adjacent: {} proven never to meet, {} always, {} meet somewhere, {} open\n",
                        counted(verdicts.all(), "pair that is", "pairs that are"), verdicts.never, verdicts.always,
                        verdicts.meets, verdicts.open);
  srdf += fmt::format("  SRDF: {}", counted(adjacent, "adjacent pair"));
  if (const std::size_t proven = verdicts.never + verdicts.always; proven > 0)
    srdf += fmt::format(", {}", counted(proven, "proven pair"));
  if (sampled > 0 && sampled_pairs)
    srdf += fmt::format(", and {}, which is no proof", counted(sampled, "sampled pair"));
  else if (sampled > 0)
    srdf += fmt::format("; {} left out, which --sampled-pairs adds",
                        counted(sampled, "sampled pair is", "sampled pairs are"));
  return srdf + fmt::format("\n  motion: {} configurations; false collisions {} with {} {}, {} with convex hulls; {}\n",
                            grouped(motion.configurations), grouped(motion.false_hull()),
                            covers == "collision geometry" ? "this" : "these", covers, grouped(motion.false_convex()),
                            motion.missed() == 0 ? "none missed" : fmt::format("{} MISSED", grouped(motion.missed())));
}

/// How many there are, and what they are about.
std::string certificates_text(std::span<const LinkCertificate> all) {
  if (all.empty()) return "";
  const auto of_robot = static_cast<std::size_t>(std::ranges::count_if(all, &LinkCertificate::is_of_robot));
  std::string text = fmt::format("  certificates: {}, {} about mesh files of the robot", all.size(), of_robot);
  if (all.size() > of_robot) text += fmt::format(", {} about copies in meshes/original", all.size() - of_robot);
  return text + "; report.json names the files for prohull_check\n";
}

std::string motion_certificate_text(const std::filesystem::path& folder, const ReportInput& facts) {
  const auto& [file, pairs] = facts.motion_certificate;
  if (file.empty()) return "";
  return fmt::format("  {}: certificate of {} of {}; to check it: prohull_check_motion {}\n", file.string(), pairs,
                     counted(verdicts_of(*facts.motion).never, "pair that never meets", "pairs that never meet"),
                     shell_word((folder / file).string()));
}

/// MuJoCo collides with the convex hull of a mesh. That of a hull has at least the volume of the link's own.
std::string filled_text(std::span<const LinkHulls> links) {
  std::size_t concave = 0;
  double most = 1;
  for (const LinkHulls& link : links)
    for (const LinkHull& hull : link.hulls)
      if (link.collision == Collision::Hull && hull.certified() && hull.volume < link.convex_volume)
        ++concave, most = std::max(most, link.convex_volume / hull.volume);
  if (concave == 0) return "";
  return fmt::format(
      "  MuJoCo collides with the convex hull of a mesh: {} filled, the worst to some {} times its volume; "
      "--collision convex keeps them\n",
      counted(concave, "concave hull is", "concave hulls are"), times_text(most));
}

std::string described(const Form& form) {
  static constexpr const char* kNames[] = {"mesh", "box", "sphere", "cylinder", "capsule", "other"};
  return kNames[form.index()];
}

/// "forearm.stl, box"
std::string described(std::span<const Shape> all) {
  std::string text;
  for (const Shape& shape : all) {
    const MeshFile* const mesh = shape.mesh();
    text += text.empty() ? "" : ", ";
    text += !mesh ? described(shape.form) : mesh->path.empty() ? mesh->why_not : mesh->path.filename().string();
  }
  return text.empty() ? "no geometry" : text;
}

/// "a hull of 500 faces"
std::string cover_of(const Budget& budget) {
  if (budget.collision == Collision::Hull) return fmt::format("a hull of {} faces", fmt::join(budget.faces, " and "));
  if (budget.collision == Collision::Spheres) return fmt::format("up to {}", counted(budget.spheres, "sphere"));
  return fmt::format("up to {} of up to {} vertices", counted(budget.pieces, "convex piece"), grouped(budget.vertices));
}

bool is_missing(const Shape& shape) { return shape.mesh() && shape.mesh()->path.empty(); }

/// Why a mesh file of a link cannot be read; empty if all can.
std::string why_not_read(std::span<const Shape> all) {
  for (const Shape& shape : all) try {
      if (const MeshFile* const mesh = shape.mesh()) mesh_triangles(*mesh);
    } catch (const InputError& error) {
      return error.what();
    }
  return "";
}

/// What a run would do with a link.
struct Plan {
  std::string text;
  bool is_possible = true;
};

Plan plan_of(const Link& link, const LinkHullOptions& options) {
  const Budget& budget = options.budget_of(link.name);
  const std::vector<Shape>& all = shapes(link, options.from);
  const auto has = [&](const auto& is_so) { return std::ranges::any_of(all, is_so); };
  if (all.empty()) return {"nothing to do"};
  if (budget.skip || has([](const Shape& shape) { return std::holds_alternative<OtherForm>(shape.form); }))
    return {"left as it is"};
  if (has(is_missing) && options.skip_missing) return {"left as it is"};
  if (has(is_missing)) return {"an error, as its mesh is missing", false};
  if (!has([&](const Shape& shape) { return is_covered(shape, budget); })) return {"primitives, kept"};
  if (const std::string why = why_not_read(all); !why.empty()) return {"an error: " + why, false};
  std::string text = cover_of(budget);
  if (budget.max_distance > 0) text += fmt::format(", within {}", millimetres(budget.max_distance));
  if (budget.padding > 0) text += fmt::format(", with a gap of {}", millimetres(budget.padding));
  return {text};
}

/// An argument of --allow with which what sticks out passes.
std::string allowance_text(double length) {
  constexpr double kMicrometre = 1e-6;
  return fmt::format("{:.3g}mm", 1000 * rounded_up(std::max(length, kMicrometre), 3));
}

void say_notes(const RobotFile& file, const LinkCheck& check, double allow) {
  const std::string& name = file.robot.links[check.link].name;
  const Vec3& p = check.worst_point;
  const std::string place = fmt::format("({:.5g}, {:.5g}, {:.5g}), in the frame of the link", p.x, p.y, p.z);
  if (check.sticks_out_at_least > 0)
    say("  {}: leaks farthest at {}\n", name, place);
  else if (check.verdict == CheckVerdict::Leaks && check.faces_outside > 0 && !passes(check, allow))
    say("  {}: leaks next to nothing near {}; `--allow {}` lets that pass\n", name, place,
        allowance_text(check.sticks_out_at_most));
  for (const std::string& note : check.notes) say("  {}: {}\n", name, note);
}

std::string left_text(std::span<const LinkHulls> links) {
  const auto left = std::ranges::count_if(links, [](const LinkHulls& link) { return !link.why.empty(); });
  if (left == 0) return "";
  return fmt::format("; {} left as {}, with nothing proven", counted(left, "link is", "links are"),
                     left == 1 ? "it is" : "they are");
}

}  // namespace

bool is_certified(const LinkHulls& link) { return std::ranges::all_of(link.hulls, &LinkHull::certified); }

std::string frame_text(const RobotFile& file, std::string_view what) {
  const Robot& robot = file.robot;
  if (file.format == RobotFormat::Urdf || robot.links.empty()) return "";
  const std::string& root = robot.links[root_of(robot, 0)].name;
  if (root == "world") return "";
  return fmt::format("  {} is in the frame of link '{}', wherever the file places that in its model\n", what, root);
}

std::string beyond_text(const Robot& robot, const JointPath& path) {
  const auto beyond = first_beyond_limits(robot, path);
  if (!beyond) return "";
  const Joint& joint = robot.joints[beyond->joint];
  const int digits =
      std::max(digits_apart(beyond->position, joint.lower, 6), digits_apart(beyond->position, joint.upper, 6));
  return fmt::format("BEYOND LIMITS: {0}{1} {2}: {3} is at {4:.{7}g}, and its limits are {5:.{7}g} and {6:.{7}g}",
                     beyond->is_in_row() ? "" : "after ", path.rows().row,
                     path.rows().numbers.empty() ? beyond->row() : path.rows().numbers[beyond->row()], joint.name,
                     beyond->position, joint.lower, joint.upper, digits);
}

nlohmann::json beyond_facts(const Robot& robot, const JointPath& path) {
  const auto beyond = first_beyond_limits(robot, path);
  if (!beyond) return nullptr;
  return {{"row", beyond->row()},
          {"time", path.time_at(beyond->place)},
          {"joint", robot.joints[beyond->joint].name},
          {"position", beyond->position}};
}

void say_robot(const RobotFile& file) {
  const Robot& robot = file.robot;
  say("{}: {}, {}, {}\n", file.path.string(), robot.name, counted(robot.links.size(), "link"),
      counted(robot.joints.size(), "joint"));
  for (const std::string& note : file.notes) say("  {}\n", note);
}

bool say_plan(const RobotFile& file, const LinkHullOptions& options) {
  bool is_possible = true;
  for (const Link& link : file.robot.links) {
    const Plan plan = plan_of(link, options);
    say("  {}: {}: {}\n", link.name, described(shapes(link, options.from)), plan.text);
    is_possible &= plan.is_possible;
  }
  return is_possible;
}

void say_check(const RobotFile& file, std::span<const LinkCheck> checks, double allow) {
  Table table;
  table.add({"link", "leaks by", "/ part", "/ convex", "reach", "verdict"});
  for (const LinkCheck& check : checks) {
    const std::string& name = file.robot.links[check.link].name;
    if (robot::was_measured(check))
      table.add({name, leak_text(check), ratio(check.collision_volume, check.visual_volume),
                 ratio(check.collision_volume, check.convex_volume), at_most(check.reach.upper),
                 std::string(words_for(check, allow).word)});
    else
      table.add({name, "", "", "", "", std::string(words_for(check, allow).word)});
  }
  say("{}", table.text());
  for (const LinkCheck& check : checks) say_notes(file, check, allow);
  const auto failed = std::ranges::count_if(checks, [&](const LinkCheck& check) { return !passes(check, allow); });
  const auto missing = std::ranges::count(checks, CheckVerdict::Missing, &LinkCheck::verdict);
  if (failed == 0)
    say("yes: the collision geometry {}\n", passing_text(checks, allow));
  else
    say("NO: {}{}\n", counts_text(checks, allow),
        missing > 0 ? ""
                    : fmt::format("; `prohull urdf {} -o DIR` makes collision meshes that cover all of them",
                                  shell_word(file.path.string())));
}

void say_disabled(const Robot& robot, const std::string& file, std::span<const DisabledCheck> checks) {
  // A pair that is free by the collision geometry counts by the visual one.
  const auto verdict_of = [](const DisabledCheck& check) {
    const PairVerdict verdict = check.collision.verdict;
    const bool is_free = verdict == PairVerdict::Never || verdict == PairVerdict::NoGeometry;
    return is_free || check.visual.verdict == PairVerdict::Meets ? check.visual.verdict : verdict;
  };
  const auto count = [&](PairVerdict verdict) { return std::ranges::count(checks, verdict, verdict_of); };
  for (const DisabledCheck& check : checks) {
    const auto is = [&](PairVerdict verdict) {
      return check.collision.verdict == verdict || check.visual.verdict == verdict;
    };
    const bool has_wrong_reason = check.has_refuted_reason();
    if (!is(PairVerdict::Meets) && !is(PairVerdict::Open) && !is(PairVerdict::Unknown) && !has_wrong_reason) continue;
    say("  line {}, {} and {}{}: {}{}\n", check.row.line, check.row.link1, check.row.link2,
        check.row.reason.empty() ? "" : fmt::format(", \"{}\"", check.row.reason),
        check.is_refuted() ? "REFUTED: " : "",
        has_wrong_reason ? "the reason is refuted, as they never meet, and the row does no harm"
                         : verdict_text(check, robot));
  }
  const auto refuted = std::ranges::count_if(checks, &DisabledCheck::is_refuted);
  say("{}: {}: {} adjacent, {} never meet, {} always, {} meet, {} open; {}\n", file,
      counted(checks.size(), "disabled pair"), count(PairVerdict::Adjacent),
      count(PairVerdict::Never) + count(PairVerdict::NoGeometry), count(PairVerdict::Always), count(PairVerdict::Meets),
      count(PairVerdict::Open), refuted > 0 ? fmt::format("{} REFUTED", refuted) : "none refuted");
}

std::string mujoco_text(const MujocoFiles& made, std::span<const LinkHulls> hulls) {
  std::string text = fmt::format("  {}: the robot for MuJoCo\n", made.files[0].path.string());
  for (const std::string& note : made.notes) text += fmt::format("    {}\n", note);
  return text + filled_text(hulls);
}

std::string robot_summary(const std::filesystem::path& folder, const ReportInput& facts, bool sampled_pairs) {
  std::size_t hulls = 0, certified = 0;
  for (const LinkHulls& link : facts.hulls)
    for (const LinkHull& hull : link.hulls) ++hulls, certified += hull.certified();
  const std::string_view covers = cover_words(facts.hulls);
  std::string text = hulls_text(facts) + shipped_text(facts);
  text += certificates_text(facts.certificates);
  if (facts.file.format == RobotFormat::Mjcf) text += filled_text(facts.hulls);
  if (facts.motion) text += motion_text(*facts.motion, covers, sampled_pairs);
  text += motion_certificate_text(folder, facts);
  if (hulls == 0)
    return text +
           fmt::format("{}: the robot, and report.html; no hull was made: {}\n", folder.string(), why_no_hull(facts));
  text += fmt::format(
      "{}: the robot with its {}, and report.html; {} of {} certified{}\n", folder.string(), covers, certified,
      covers == "hulls" ? counted(hulls, "hull is", "hulls are") : counted(hulls, "link is", "links are"),
      left_text(facts.hulls));
  return text;
}

}  // namespace prohull::cli
