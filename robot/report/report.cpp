#include "robot/report/report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <set>

#include "prohull/detail/extension.h"
#include "prohull/error.h"
#include "robot/files/mesh_references.h"
#include "robot/files/packages.h"
#include "robot/files/xml.h"
#include "robot/hulls/cache.h"
#include "robot/json.h"
#include "robot/motion/joint_limits.h"
#include "robot/motion/kinematics.h"
#include "robot/report/report_facts.h"

namespace prohull::robot {
namespace {

using Json = nlohmann::json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }
Json number(const std::optional<double>& value) { return value ? number(*value) : Json(); }
Json point(const Vec3& p) { return {number(p.x), number(p.y), number(p.z)}; }

Json texts(const std::vector<std::string>& sentences) { return json_list(sentences, clean_text); }

std::string file_name(const std::filesystem::path& file) { return clean_text(file.generic_string()); }

Json distance(const DistanceBounds& bounds) {
  return {{"at_least", number(bounds.lower)},
          {"at_most", number(bounds.upper)},
          {"farthest", bounds.lower > 0 ? point(bounds.farthest) : Json()}};
}

Json facts_of(const LinkCertificate& certificate) {
  return {{"file", file_name(certificate.file)},
          {"hull", json_list(certificate.hull, file_name)},
          {"original", file_name(certificate.original)},
          {"original_is_of_robot", certificate.is_of_robot},
          {"claims", texts(certificate.claims)}};
}

Json facts_of(const LinkHull& hull, const LinkHulls& link) {
  return {{"target_faces", hull.target_faces > 0 ? Json(hull.target_faces) : Json()},
          {"faces", hull.balls.empty() ? Json(hull.mesh.face_count()) : Json()},
          {"pieces", hull.pieces.empty() ? Json() : Json(hull.pieces.size())},
          {"spheres", hull.balls.empty() ? Json() : Json(hull.balls.size())},
          {"verdict", prohull::facts(hull.verdict)},
          {"target_reached", hull.target_reached},
          {"within_bounds", hull.within_bounds},
          {"source", hull.source.empty() ? Json() : Json(hull.source)},
          {"volume", number(hull.volume)},
          {"volume_ratio", number(ratio(hull.volume, link.sealed_volume))},
          {"convex_ratio", number(ratio(hull.volume, link.convex_volume))},
          {"self_intersections", hull.self_intersections},
          {"notes", texts(hull.notes)}};
}

void add_hulls(const LinkHulls& link, std::span<const LinkCertificate> certificates, Json& facts) {
  facts["status"] = name_of(link.status);
  facts["collision"] = prohull::name_of(collision_names(), link.collision);
  facts["why"] = link.why.empty() ? Json() : Json(clean_text(link.why));
  facts["faces"] = link.triangles.face_count();
  facts["non_finite_faces"] = link.non_finite_faces;
  facts["sealed_volume"] = number(link.sealed_volume);
  facts["sealed_volume_is_estimated"] = link.is_estimated;
  facts["convex_volume"] = number(link.convex_volume);
  facts["kept_primitives"] = link.primitives.size();
  facts["repairs"] = texts(link.repairs);
  facts["seconds"] = number(link.seconds);
  facts["from_cache"] = link.from_cache;
  facts["hulls"] = json_list(link.hulls, [&](const LinkHull& hull) { return facts_of(hull, link); });
  for (const LinkCertificate& certificate : certificates)
    if (certificate.link == link.link) facts["hulls"][certificate.set]["certificate"] = facts_of(certificate);
}

Json facts_of(const LinkCheck& check, double allow) {
  Json facts{{"verdict", name_of(check.verdict)},
             {"passes", passes(check, allow)},
             {"visual_faces", check.visual_faces},
             {"collision_faces", check.collision_faces},
             {"pieces", check.pieces},
             {"notes", texts(check.notes)}};
  if (!was_measured(check)) return facts;
  facts["sticks_out"] = {{"at_least", number(check.sticks_out_at_least)},
                         {"at_most", number(check.sticks_out_at_most)}};
  facts["worst_point"] = check.sticks_out_at_least > 0 ? point(check.worst_point) : Json();
  facts["faces_outside"] = check.faces_outside;
  facts["visual_volume"] = number(check.visual_volume);
  facts["collision_volume"] = number(check.collision_volume);
  facts["convex_volume"] = number(check.convex_volume);
  facts["volume_ratio"] = number(ratio(check.collision_volume, check.visual_volume));
  facts["convex_ratio"] = number(ratio(check.collision_volume, check.convex_volume));
  facts["distance"] = distance(check.reach);
  facts["mean_distance"] = number(check.mean_distance);
  return facts;
}

Json facts_of(const std::vector<HashedFile>& files) {
  return json_list(files, [](const HashedFile& file) -> Json {
    return {{"file", file_name(file.path)}, {"xxh128", file.hash}};
  });
}

Json joints_of(const Robot& robot) {
  Json joints = Json::array();
  const std::vector<JointRange> ranges = allowed_ranges(robot);
  for (std::size_t j = 0; j < ranges.size(); ++j) {
    const Joint& joint = robot.joints[j];
    if (joint.type == JointType::Fixed) continue;
    joints.push_back({{"name", clean_text(joint.name)},
                      {"type", prohull::name_of(joint_type_names(), joint.type)},
                      {"lower", number(ranges[j].lower)},
                      {"upper", number(ranges[j].upper)},
                      {"follows", joint.mimic ? Json(clean_text(robot.joints[joint.mimic->joint].name)) : Json()}});
  }
  return joints;
}

Json links_of(const ReportInput& input) {
  Json links = Json::array();
  const std::vector<Mark> marks = marks_of(input);
  for (std::size_t i = 0; i < input.file.robot.links.size(); ++i) {
    Json facts{{"name", clean_text(input.file.robot.links[i].name)}, {"needs_a_look", Json::array()}};
    if (const LinkHulls* const hulls = hulls_of(input, i)) add_hulls(*hulls, input.certificates, facts);
    if (const LinkCheck* const check = check_of(input, i)) facts["shipped"] = facts_of(*check, input.allow);
    for (const Mark& mark : marks)
      if (mark.link == i) facts["needs_a_look"].push_back(mark.text);
    links.push_back(std::move(facts));
  }
  return links;
}

Json witness_of(const PairProof& proof, const Robot& robot) {
  if (proof.positions.empty()) return {};
  Json positions = Json::object();
  for (const auto& [name, position] : named_positions(robot, proof.positions))
    positions[clean_text(name)] = number(position);
  return {{"positions", positions}, {"faces", {std::size_t(proof.faces.a), std::size_t(proof.faces.b)}}};
}

Json facts_of(const PairProof& proof, const Robot& robot) {
  return {{"verdict", name_of(proof.verdict)},
          {"why", clean_text(proof.why)},
          {"proven_free", number(proof.proven_free)},
          {"cells", proof.cells},
          {"witness", witness_of(proof, robot)}};
}

Json proof_of(const MotionPair& pair, const Robot& robot) {
  if (!pair.proof) return {};
  Json facts = facts_of(*pair.proof, robot);
  if (!facts["witness"].is_null()) facts["witness"]["visual_meets"] = pair.visual_meets_at_witness;
  return facts;
}

Json facts_of(const DisabledCheck& check, const Robot& robot) {
  return {{"links", {clean_text(check.row.link1), clean_text(check.row.link2)}},
          {"reason", clean_text(check.row.reason)},
          {"line", check.row.line},
          {"refuted", check.is_refuted()},
          {"collision", facts_of(check.collision, robot)},
          {"visual", facts_of(check.visual, robot)}};
}

Json facts_of(const MotionPair& pair, const Robot& robot) {
  return {{"links", {clean_text(robot.links[pair.a].name), clean_text(robot.links[pair.b].name)}},
          {"kind", name_of(pair.kind)},
          {"visual", pair.visual},
          {"hull", pair.hull},
          {"convex", pair.convex},
          {"false_hull", pair.false_hull},
          {"false_convex", pair.false_convex},
          {"missed", pair.missed},
          {"proof", proof_of(pair, robot)}};
}

Json certificate_facts(const ReportInput& input) {
  if (input.motion_certificate.file.empty()) return {};
  return {{"file", file_name(input.motion_certificate.file)}, {"pairs", input.motion_certificate.pairs}};
}

Json facts_of(const MotionResult& motion, const Robot& robot) {
  return {{"configurations", motion.configurations},
          {"seed", motion.seed},
          {"pairs", json_list(motion.pairs, [&](const MotionPair& pair) { return facts_of(pair, robot); })},
          {"false_hull", motion.false_hull()},
          {"false_convex", motion.false_convex()},
          {"missed", motion.missed()},
          {"configurations_in_collision",
           {{"visual", motion.visual_configurations},
            {"hull", motion.hull_configurations},
            {"convex", motion.convex_configurations}}},
          {"microseconds", {{"visual", number(motion.visual_us)}, {"hull", number(motion.hull_us)}}}};
}

Json facts_of(const Totals& totals) {
  return {{"links", totals.links},
          {"hulled", totals.hulled},
          {"certified", totals.certified},
          {"primitives", totals.primitives},
          {"skipped", totals.skipped},
          {"empty", totals.empty},
          {"faces_before", totals.faces_before},
          {"faces_after", totals.faces_after},
          {"pieces", totals.pieces},
          {"spheres", totals.balls},
          {"median_volume_ratio", number(totals.volume_ratio)},
          {"median_convex_ratio", number(totals.convex_ratio)},
          {"checked", totals.checked},
          {"passed", totals.passed},
          {"median_shipped_volume_ratio", number(totals.shipped_ratio)},
          {"sticks_out",
           {{"at_least", number(totals.sticks_out_at_least)}, {"at_most", number(totals.sticks_out_at_most)}}},
          {"failures", totals.failures},
          {"looks", totals.looks}};
}

/// <testcase>, with what happened within.
std::string test_case(const std::string& robot, const std::string& link, const std::string& time,
                      const std::string& outcome) {
  return fmt::format("    <testcase classname=\"{}\" name=\"{}\"{}{}\n", xml_escaped(robot),
                     xml_escaped(clean_text(link)), time,
                     outcome.empty() ? "/>" : fmt::format(">\n{}    </testcase>", outcome));
}

std::string element(std::string_view tag, std::string_view type, const std::string& message,
                    const std::vector<std::string>& notes = {}) {
  std::string text;
  for (const std::string& note : notes) text += clean_text(note) + "\n";
  return fmt::format("      <{0}{1} message=\"{2}\">{3}</{0}>\n", tag,
                     type.empty() ? "" : fmt::format(" type=\"{}\"", type), xml_escaped(message), xml_escaped(text));
}

/// The test cases of one kind, and their counts.
struct Suite {
  std::string name, cases;
  std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;
  double seconds = 0;

  void add(const std::string& robot, const std::string& link, std::optional<double> time, const std::string& outcome) {
    const auto is = [&](std::string_view tag) { return outcome.find(fmt::format("<{} ", tag)) < outcome.find('>'); };
    ++tests, failures += is("failure"), errors += is("error"), skipped += is("skipped");
    seconds += time.value_or(0);
    cases += test_case(robot, link, time ? fmt::format(" time=\"{:.3f}\"", *time) : "", outcome);
  }
  std::string counts() const {
    return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\"", tests, failures,
                       errors, skipped, seconds);
  }
  std::string text() const {
    return fmt::format("  <testsuite name=\"{}\" {}>\n{}  </testsuite>\n", xml_escaped(name), counts(), cases);
  }
};

std::string place_text(const Vec3& p) { return fmt::format(" at ({:.6g}, {:.6g}, {:.6g}) m", p.x, p.y, p.z); }

std::string outcome_of(const LinkCheck& check, double allow) {
  if (check.verdict == CheckVerdict::NoVisual) return element("skipped", "", "there is no visual geometry to cover");
  if (passes(check, allow)) return {};
  std::string message = fmt::format("the shipped collision geometry {}", verdict_text(check));
  if (check.sticks_out_at_least > 0) message += place_text(check.worst_point);
  return element(check.verdict == CheckVerdict::Missing ? "error" : "failure", name_of(check.verdict), message,
                 check.notes);
}

std::string outcome_of(const LinkHulls& hulls) {
  if (hulls.status != LinkStatus::Hulled) return element("skipped", "", "no hull was asked for or needed");
  if (is_certified(hulls)) return {};
  std::vector<std::string> notes;
  for (const LinkHull& hull : hulls.hulls) notes.insert(notes.end(), hull.notes.begin(), hull.notes.end());
  return element("failure", "not-certified", "a hull is not certified: it may not enclose the link", notes);
}

std::string outcome_of(const DisabledCheck& check, const Robot& robot) {
  const auto is = [&](PairVerdict verdict) {
    return check.collision.verdict == verdict || check.visual.verdict == verdict;
  };
  if (check.is_refuted()) return element("failure", "meets", verdict_text(check, robot));
  const bool is_skipped = is(PairVerdict::Open) || is(PairVerdict::Unknown);
  return is_skipped ? element("skipped", "", verdict_text(check, robot)) : "";
}

std::vector<Suite> suites_of(const ReportInput& input) {
  const Robot& robot = input.file.robot;
  const std::string name = clean_text(robot.name);
  std::vector<Suite> suites;
  if (!input.hulls.empty()) suites.push_back({name + ": hulls", {}});
  for (const LinkHulls& hulls : input.hulls) {
    suites.back().add(name, robot.links[hulls.link].name, hulls.seconds, outcome_of(hulls));
  }
  if (!input.shipped.empty()) suites.push_back({name + ": shipped collision geometry", {}});
  for (const LinkCheck& check : input.shipped)
    suites.back().add(name, robot.links[check.link].name, std::nullopt, outcome_of(check, input.allow));
  if (!input.disabled.empty()) suites.push_back({name + ": disabled pairs", {}});
  for (const DisabledCheck& check : input.disabled)
    suites.back().add(name, check.row.link1 + " and " + check.row.link2, std::nullopt, outcome_of(check, robot));
  return suites;
}

void add_mesh(const std::filesystem::path& mesh, const Packages& packages, std::set<std::filesystem::path>& files) {
  if (!files.insert(mesh).second || lower_case_extension(mesh) != ".gltf") return;
  try {
    for (const FileReference& reference : references_in(
             mesh, [&](const std::string& name) { return packages.find_description(name, mesh.parent_path()).path; }))
      files.insert(reference.file);
  } catch (const InputError&) {
    // What reads the mesh tells of it.
  }
}

std::string date_text() {
  const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
  constexpr std::time_t kYear10000 = 253402300800;
  std::time_t asked = -1;
  const char* const end = epoch ? epoch + std::strlen(epoch) : nullptr;
  const bool is_asked = epoch && std::from_chars(epoch, end, asked).ptr == end && asked >= 0 && asked < kYear10000;
  return fmt::format("{:%FT%TZ}", fmt::gmtime(is_asked ? asked : std::time(nullptr)));
}

}  // namespace

void sign(ReportInput& input, std::initializer_list<std::filesystem::path> others) {
  const RobotFile& robot = input.file;
  const Packages packages(robot.path, robot.options);
  std::set<std::filesystem::path> files(others);
  files.insert(robot.included.begin(), robot.included.end());
  for (const Link& link : robot.robot.links)
    for (const Geometry which : {Geometry::Visual, Geometry::Collision})
      for (const Shape& shape : shapes(link, which))
        if (const MeshFile* const mesh = shape.mesh()) add_mesh(mesh->path, packages, files);
  files.erase(std::filesystem::path());
  files.erase(robot.path);
  input.date = date_text();
  input.sources = {{robot.path, hash_of_file(robot.path)}};
  for (const std::filesystem::path& file : files) input.sources.push_back({file, hash_of_file(file)});
}

Json report_json(const ReportInput& input) {
  const Robot& robot = input.file.robot;
  std::vector<std::string> notes = input.file.notes;
  notes.insert(notes.end(), input.srdf_notes.begin(), input.srdf_notes.end());
  return {
      {"robot", clean_text(robot.name)},
      {"file", file_name(input.file.path)},
      {"format", prohull::name_of(robot_format_names(), input.file.format)},
      {"version", clean_text(input.version)},
      {"from", input.from == Geometry::Visual ? "visual" : "collision"},
      {"allow", number(input.allow)},
      {"seconds", number(input.seconds)},
      {"date", input.date},
      {"sources", facts_of(input.sources)},
      {"joints", joints_of(robot)},
      {"findings", json_list(findings_of(input), &Finding::text)},
      {"notes", texts(notes)},
      {"links", links_of(input)},
      {"motion", input.motion ? facts_of(*input.motion, robot) : Json()},
      {"motion_certificate", certificate_facts(input)},
      {"disabled_pairs", json_list(input.disabled, [&](const DisabledCheck& check) { return facts_of(check, robot); })},
      {"totals", facts_of(totals_of(input))}};
}

std::string report_junit(const ReportInput& input) {
  Suite all{clean_text(input.file.robot.name), {}};
  for (const Suite& suite : suites_of(input)) {
    all.tests += suite.tests, all.failures += suite.failures;
    all.errors += suite.errors, all.skipped += suite.skipped;
    all.seconds += suite.seconds;
    all.cases += suite.text();
  }
  return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\" {}>\n{}</testsuites>\n",
                     xml_escaped(all.name), all.counts(), all.cases);
}

}  // namespace prohull::robot
