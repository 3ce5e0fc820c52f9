#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <string>

#include "command.h"
#include "prohull/detail/rounded.h"
#include "prohull/error.h"
#include "robot/hulls/budgets.h"
#include "robot/json.h"
#include "robot/motion/kinematics.h"
#include "robot/motion/motion.h"
#include "robot/motion/motion_certificate.h"
#include "robot/motion/path_proof.h"
#include "robot_summary.h"
#include "view/motion.h"
#include "view/shown_robot.h"

namespace prohull::cli {
namespace {

using namespace prohull::robot;
using std::filesystem::path;

struct PathOptions {
  path in, srdf, curve, page, report, certificate;
  std::vector<path> paths, world;
  std::vector<std::string> ignored;
  std::string gap = "0";
  robot::FileOptions file;
  InputOptions input;  ///< of the world
  Geometry geometry = Geometry::Collision;
  PathProofOptions proof;
};

/// What is asked, and what was found.
struct Decision {
  const RobotFile& file;
  std::vector<WorldMesh> world;
  std::vector<LinkPair> disabled;
  PathBodies made;
  std::vector<BodyPair> pairs;
  std::vector<BodyPair> left_out;  ///< would be pairs without the SRDF and --ignore
  std::vector<JointPath> paths = {};
  std::vector<PathProof> proofs = {};

  const std::string& name(std::size_t body) const { return made.bodies[body].name; }
};

std::vector<WorldMesh> read_world(const PathOptions& options) {
  std::vector<WorldMesh> world;
  for (const path& file : options.world) world.push_back({file.stem().string(), read_input(file, options.input)});
  return world;
}

/// Names may have commas: of all places to split, the first with a body on either side counts.
std::pair<std::string, std::string> split_at_comma(const std::string& pair, const std::vector<PathBody>& bodies) {
  const auto at = [&](std::size_t comma) { return std::pair(pair.substr(0, comma), pair.substr(comma + 1)); };
  const auto is_body = [&](const std::string& name) { return std::ranges::count(bodies, name, &PathBody::name) > 0; };
  const std::size_t first = pair.find(',');
  if (first == pair.npos) refuse(fmt::format("--ignore {}: expected two names with a comma between them", pair));
  for (std::size_t comma = first; comma != pair.npos; comma = pair.find(',', comma + 1))
    if (const auto names = at(comma); is_body(names.first) && is_body(names.second)) return names;
  return at(first);
}

std::vector<std::pair<std::string, std::string>> ignored_names(const PathOptions& options,
                                                               const std::vector<PathBody>& bodies) {
  std::vector<std::pair<std::string, std::string>> names;
  for (const std::string& pair : options.ignored) names.push_back(split_at_comma(pair, bodies));
  return names;
}

std::vector<BodyPair> without(const std::vector<BodyPair>& all, const std::vector<BodyPair>& pairs) {
  std::vector<BodyPair> others;
  std::ranges::set_difference(all, pairs, std::back_inserter(others));
  return others;
}

Decision read_all(const PathOptions& options, const RobotFile& file) {
  ProgressLine line;
  Decision decision{
      .file = file, .world = read_world(options), .disabled = {}, .made = {}, .pairs = {}, .left_out = {}};
  decision.made = path_bodies(file.robot, options.geometry, decision.world, std::ref(line));
  Srdf srdf;
  if (!options.srdf.empty()) srdf = read_srdf(file.robot, read_bytes(options.srdf), input_name(options.srdf));
  decision.disabled = srdf.pairs();
  decision.pairs =
      pairs_on_path(file.robot, decision.made.bodies, decision.disabled, ignored_names(options, decision.made.bodies));
  decision.made.notes.insert(decision.made.notes.end(), srdf.notes.begin(), srdf.notes.end());
  decision.left_out = without(pairs_on_path(file.robot, decision.made.bodies), decision.pairs);
  if (decision.pairs.empty()) refuse("there is no pair of bodies that could meet: all are adjacent, or ignored");
  for (const path& rows : options.paths)
    decision.paths.emplace_back(file.robot, read_path_rows(read_bytes(rows), input_name(rows)));
  return decision;
}

/// The time is exact: it has as many digits as tell it from all others.
std::string time_text(const JointPath& path, double time) {
  return path.rows().times.empty() ? fmt::format("row {}", time) : fmt::format("{} s", time);
}

/// Six digits of what a time differs from the first or the last one by.
int digits_of_times(const JointPath& path) {
  constexpr int kDigits = 6, kMost = std::numeric_limits<double>::max_digits10;
  const double first = path.time_at(0), last = path.time_at(path.length());
  const double more = std::log10(std::max(std::abs(first), std::abs(last)) / (last - first));
  return more > 0 ? std::min(kMost, kDigits + static_cast<int>(std::ceil(std::min(more, 20.)))) : kDigits;
}

/// Rounded down.
std::string until_text(const JointPath& path, double place) {
  return time_text(path, rounded_down(path.time_at(place), digits_of_times(path)));
}

std::string pair_name(const Decision& decision, const PathPairProof& pair) {
  return fmt::format("{} and {}", decision.name(pair.a), decision.name(pair.b));
}

/// ", but for 1 pair that may touch (base and table)"
std::string exceptions_text(const Decision& decision) {
  constexpr std::size_t kMostNames = 3;
  const std::vector<BodyPair>& all = decision.left_out;
  if (all.empty()) return "";
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(all.size(), kMostNames); ++i)
    names.push_back(fmt::format("{} and {}", decision.name(all[i].first), decision.name(all[i].second)));
  if (all.size() > kMostNames) names.push_back(fmt::format("{} more", grouped(all.size() - kMostNames)));
  return fmt::format(", but for {} that may touch ({})", counted(all.size(), "pair"), fmt::join(names, ", "));
}

std::string why_text(const PathPairProof& pair) {
  return pair.why == kCellsUsedUp ? pair.why + ", which --cells makes larger" : pair.why;
}

double least_of(const PathProof& proof) { return std::ranges::min(proof.curve, {}, &DistanceBound::distance).distance; }

std::string verdict_text(const PathOptions& options, const Decision& decision, std::size_t p) {
  const JointPath& path = decision.paths[p];
  const PathProof& proof = decision.proofs[p];
  const PathPairProof* const first = proof.first();
  if (!first) {
    std::string text = fmt::format("free all along{}, proven for {}", exceptions_text(decision),
                                   counted(path.rows().positions.size(), "row"));
    if (!path.rows().times.empty())
      text += fmt::format(", {:.6g} s", path.rows().times.back() - path.rows().times.front());
    if (!proof.curve.empty())
      text += fmt::format("; at least {:.4g} mm apart", rounded_down(1000 * least_of(proof), 4));
    return text;
  }
  const double free_until = proof.free_until();
  const std::string until = free_until > 0 ? fmt::format("; proven free before {}", until_text(path, free_until)) : "";
  if (first->verdict == PathVerdict::Open)
    return fmt::format("OPEN from {} to {}: {}: {}{}", until_text(path, first->begin),
                       time_text(path, rounded_up(path.time_at(first->end), digits_of_times(path))),
                       pair_name(decision, *first), why_text(*first), until);
  const PathPairProof& earliest = *std::ranges::min_element(proof.pairs, {}, &PathPairProof::begin);
  const std::string undecided = earliest.begin < first->end && !earliest.why.empty()
                                    ? fmt::format("; undecided {}: {}: {}", until.empty() ? "before" : "between",
                                                  pair_name(decision, earliest), why_text(earliest))
                                    : "";
  return fmt::format("{} at {}: {}{}{}", options.proof.gap > 0 ? fmt::format("CLOSER THAN {}", options.gap) : "MEETS",
                     time_text(path, path.time_at(first->end)), pair_name(decision, *first), until, undecided);
}

/// Where the joints rest that the path does not name and that no other joint moves.
std::string rest_text(const Robot& robot, const JointPath& path) {
  std::vector<std::string> names;
  const std::vector<double> positions = path.positions_at(0);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const Joint& joint = robot.joints[j];
    if (joint.type == JointType::Fixed || joint.mimic || std::ranges::count(path.joints(), j) > 0) continue;
    names.push_back(fmt::format("{} at {:.6g}", joint.name, positions[j]));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

void say_others(const PathOptions& options, const PathProof& proof) {
  const auto count = [&](PathVerdict verdict) {
    return std::ranges::count(proof.pairs, verdict, &PathPairProof::verdict);
  };
  const auto meet = count(PathVerdict::Meets), open = count(PathVerdict::Open);
  if (meet + open > 1)
    say("  of {}, {} {} and {} are open\n", counted(proof.pairs.size(), "pair"), meet,
        options.proof.gap > 0 ? "are closer" : "meet", open);
}

void say_path(const PathOptions& options, const Decision& decision, std::size_t p) {
  const Robot& robot = decision.file.robot;
  const JointPath& path = decision.paths[p];
  const PathProof& proof = decision.proofs[p];
  say("{}: {}\n", path.rows().file, verdict_text(options, decision, p));
  if (const PathPairProof* const first = proof.first()) {
    if (path.rows().times.empty()) say("  rows count from 0, as the path has no times\n");
    if (!first->positions.empty()) say("  there: {}\n", positions_text(robot, first->positions));
    if (first->nothing_moves)
      say("  the path does not move them against each other; if they may touch, add --ignore {},{}\n",
          decision.name(first->a), decision.name(first->b));
    say_others(options, proof);
  }
  if (const std::string text = beyond_text(robot, path); !text.empty()) say("  {}\n", text);
  if (const std::string rest = rest_text(robot, path); !rest.empty())
    say("  the path does not name these joints, which stay: {}\n", rest);
}

nlohmann::json facts_of_pair(const Decision& decision, const JointPath& path, const PathPairProof& pair) {
  const Robot& robot = decision.file.robot;
  nlohmann::json json{{"bodies", {decision.name(pair.a), decision.name(pair.b)}},
                      {"verdict", name_of(pair.verdict)},
                      {"why", pair.why},
                      {"begin", path.time_at(pair.begin)},
                      {"end", path.time_at(pair.end)},
                      {"nothing_moves", pair.nothing_moves},
                      {"cells", pair.cells},
                      {"witness", nullptr}};
  if (pair.positions.empty()) return json;
  nlohmann::json& witness = json["witness"];
  for (const auto& [name, position] : named_positions(robot, pair.positions)) witness["positions"][name] = position;
  witness["time"] = path.time_at(pair.end);
  witness["parts"] = {pair.part_a, pair.part_b};
  witness["faces"] = {index(pair.faces.a), index(pair.faces.b)};
  return json;
}

nlohmann::json facts_of_path(const Decision& decision, std::size_t p) {
  const JointPath& path = decision.paths[p];
  const PathProof& proof = decision.proofs[p];
  nlohmann::json json{{"file", path.rows().file},
                      {"rows", path.rows().positions.size()},
                      {"joints", path.rows().joints},
                      {"has_times", !path.rows().times.empty()},
                      {"verdict", name_of(proof.verdict())},
                      {"begin", path.time_at(0)},
                      {"end", path.time_at(path.length())},
                      {"free_until", path.time_at(proof.free_until())},
                      {"least_distance", proof.curve.empty() ? nlohmann::json() : nlohmann::json(least_of(proof))},
                      {"cells", proof.cells()},
                      {"beyond_limits", beyond_facts(decision.file.robot, path)},
                      {"pairs", nlohmann::json::array()}};
  for (const PathPairProof& pair : proof.pairs)
    if (pair.verdict != PathVerdict::Free) json["pairs"].push_back(facts_of_pair(decision, path, pair));
  return json;
}

nlohmann::json report_of(const PathOptions& options, const Decision& decision, double seconds) {
  nlohmann::json paths = nlohmann::json::array();
  const auto names = [&](const BodyPair& pair) {
    return std::array{decision.name(pair.first), decision.name(pair.second)};
  };
  for (std::size_t p = 0; p < decision.paths.size(); ++p) paths.push_back(facts_of_path(decision, p));
  return {{"robot", decision.file.robot.name},
          {"file", decision.file.path.string()},
          {"geometry", name_of(geometry_names(), options.geometry)},
          {"gap", options.proof.gap},
          {"bodies", json_list(decision.made.bodies, &PathBody::name)},
          {"pairs", decision.pairs.size()},
          {"left_out", json_list(decision.left_out, names)},
          {"notes", decision.made.notes},
          {"paths", paths},
          {"seconds", seconds}};
}

/// The text as a cell of a CSV file: with quotes, if it needs them.
std::string as_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::string curve_csv(const Decision& decision) {
  const PathProof& proof = decision.proofs.front();
  const JointPath& path = decision.paths.front();
  std::string text = "begin,end,distance,a,b\n";
  for (const DistanceBound& bound : proof.curve) {
    const PathPairProof& pair = proof.pairs[bound.pair];
    text += fmt::format("{},{},{},{},{}\n", path.time_at(bound.begin), path.time_at(bound.end), bound.distance,
                        as_cell(decision.name(pair.a)), as_cell(decision.name(pair.b)));
  }
  return text;
}

int exit_code(const Decision& decision, std::size_t p) {
  const PathVerdict verdict = decision.proofs[p].verdict();
  if (verdict == PathVerdict::Meets || first_beyond_limits(decision.file.robot, decision.paths[p])) return kAnswerIsNo;
  return verdict == PathVerdict::Free ? kDone : kUndecided;
}

/// The robot along the path, and what stands around it.
std::string page_of(const PathOptions& options, const Decision& decision) {
  ProgressLine line;
  const JointPath& path = decision.paths.front();
  view::ShownRobot robot = view::as_shipped(moved_by(decision.file.robot, path), std::ref(line));
  if (!options.srdf.empty()) robot.disabled = decision.disabled;
  robot.motion = view::shown_motion(path, decision.proofs.front(), decision.made.bodies);
  robot.motion->verdict = verdict_text(options, decision, 0);
  if (const std::string beyond = beyond_text(decision.file.robot, path); !beyond.empty())
    robot.motion->verdict += "; " + beyond;
  robot.motion->is_good = exit_code(decision, 0) == kDone;
  std::vector<view::Shown> shown{{options.in.filename().string(), std::move(robot)}};
  for (const WorldMesh& mesh : decision.world) shown.push_back({mesh.name, mesh.mesh});
  return view::page(
      shown, std::nullopt,
      {.unit = "m", .version = PROHULL_VERSION, .threads = options.proof.threads, .progress = std::ref(line)});
}

/// Returns a line of the summary.
std::string add_certificate(const PathOptions& options, const Decision& decision, Outputs& outputs) {
  if (options.certificate.empty()) return "";
  const PathProof& proof = decision.proofs.front();
  const path folder = std::filesystem::absolute(options.certificate).parent_path();
  const MotionCertificate made = path_certificate(decision.file.robot, decision.paths.front(), options.proof.gap,
                                                  certified_bodies(decision.made.bodies, folder), proof);
  const std::string name = output_name(options.certificate), of = counted(proof.pairs.size(), "pair");
  if (made.pairs == 0) return fmt::format("{}: not written, as none of {} is free all along\n", name, of);
  outputs.add(options.certificate, made.text);
  return fmt::format("{}: certificate of {} of {}, free all along; to check it: prohull_check_motion {}\n", name,
                     made.pairs, of, options.certificate.string());
}

int run_motion(PathOptions options) {
  options.proof.gap = length_of(options.gap, "--gap");
  options.proof.distances = !options.curve.empty() || !options.page.empty();
  options.proof.keep_trees = !options.certificate.empty();
  if ((options.proof.distances || options.proof.keep_trees) && options.paths.size() > 1)
    refuse("--curve, --page and --certificate are for one path");
  if (!options.page.empty()) require_page(options.page);
  std::vector<path> inputs{options.in, options.srdf};
  inputs.insert(inputs.end(), options.paths.begin(), options.paths.end());
  inputs.insert(inputs.end(), options.world.begin(), options.world.end());
  check_files(inputs, {options.curve, options.page, options.report, options.certificate});
  const Stopwatch reading;
  const RobotFile file = read_robot(options.in, options.file);
  Decision decision = read_all(options, file);
  const double read_seconds = reading.seconds();
  const Stopwatch proving;
  {
    ProgressLine line;
    options.proof.progress = std::ref(line);
    decision.proofs = prove_paths(file.robot, decision.paths, decision.made.bodies, decision.pairs, options.proof);
  }
  const double seconds = proving.seconds();
  Outputs outputs;
  if (!options.curve.empty()) outputs.add(options.curve, curve_csv(decision));
  if (!options.page.empty()) outputs.add(options.page, page_of(options, decision));
  const std::string certificate = add_certificate(options, decision, outputs);
  outputs.add_report(options.report, report_of(options, decision, seconds));
  outputs.commit();
  say_robot(file);
  for (const std::string& note : decision.made.notes) say("  {}\n", note);
  if (!options.world.empty()) say("{}", frame_text(file, "--world"));
  std::vector<int> exit_codes;
  for (std::size_t p = 0; p < decision.paths.size(); ++p)
    say_path(options, decision, p), exit_codes.push_back(exit_code(decision, p));
  const std::string rest =
      decision.left_out.empty() ? "" : fmt::format(", {} left out", grouped(decision.left_out.size()));
  say("  {} of bodies{}; read and index {:.2f} s, prove {:.3f} s\n", counted(decision.pairs.size(), "pair"), rest,
      read_seconds, seconds);
  say("{}", certificate);
  const bool is_refused = std::ranges::count(exit_codes, kAnswerIsNo) > 0;
  return is_refused ? kAnswerIsNo : std::ranges::max(exit_codes);
}

void add_world(CLI::App& command, PathOptions& options) {
  add_unit_options(command, options.input, "the meshes of the world");
  const Heading heading(command, "What may meet what");
  add_value(
      command, "--world", options.world, "MESH",
      std::string("Mesh that stands still in the frame of the robot's root, in metres unless --unit says otherwise; "
                  "may be given several times. It is called by the name of its file without the suffix. ") +
          kMeshFiles)
      ->allow_extra_args(false);
  add_value(
      command, "--ignore", options.ignored, "A,B",
      "Two bodies that may touch, links or meshes of the world, as in base_link,table; may be given several times.")
      ->allow_extra_args(false);
  add_value(command, "--srdf", options.srdf, "FILE.srdf",
            "SRDF file, the disabled pairs of links of which are not checked.");
  add_geometry_option(command, options.geometry);
}

}  // namespace

void add_motion(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<PathOptions>(
      app, run, "motion",
      "Decides whether a robot is free all along a path: proven at every moment, not sampled. Otherwise it finds the "
      "first moment at which two links, or a link and the world, meet, as closely as --cells allows, and says before "
      "which moment the path is proven free. The exit code is 0 if all paths are free and "
      "within the limits of the joints, 1 if one is not, and 4 if that is open.",
      run_motion);
  add_robot_input(command, options.in);
  add_value(command, "paths", options.paths, "PATH",
            "Paths of joint positions: CSV files with the names of joints in the first line, and time if there is one; "
            "or JSON files, such as a JointTrajectory of ROS (docs/guides/motion.md). With - the file is read from "
            "standard input.")
      ->required();
  add_robot_file_options(command, options.file);
  add_value(command, "--gap", options.gap, "LENGTH",
            "How far bodies have to be apart at least, in metres or with a unit: 5mm. Closer counts as meeting.");
  add_number(command, "--cells", options.proof.cells, {2, 1e9},
             "Largest number of pieces into which a path is divided for each pair of bodies. What is not decided then "
             "is open.");
  add_value(command, "--curve", options.curve, "FILE.csv",
            "CSV file for the least distance over time: between begin and end, all pairs are at least that far apart, "
            "which is proven. The bounds are no less than 0.6 of the distance, as far as --cells allows.");
  add_value(command, "--page", options.page, "FILE.html",
            "Page of HTML that shows the robot on its path, with a slider of time and the curve of --curve, as "
            "`prohull view` shows robots.");
  add_value(
      command, "--certificate", options.certificate, "FILE.phmotion",
      "File with which prohull_check_motion, a program of one C file that shares nothing with this one, decides again "
      "that pairs of bodies are free all along (docs/certificate.md). Pairs that are not are left out of it.");
  add_threads_option(command, options.proof.threads, "The result is the same for any number.");
  add_report_option(command, options.report);
  add_world(command, options);
  add_examples(command, {"prohull motion arm.urdf pick.csv", "prohull motion arm.urdf pick.csv place.json --gap 5mm",
                         "prohull motion arm.urdf pick.csv --world table.stl --unit mm --ignore base_link,table",
                         "prohull motion arm.urdf pick.csv --srdf arm.srdf --curve clearance.csv --report pick.json",
                         "prohull motion arm.urdf pick.csv --page pick.html"});
}

}  // namespace prohull::cli
