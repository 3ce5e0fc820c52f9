#include "prohull/collide.h"

#include <fmt/format.h>

#include "asked_mesh.h"
#include "command.h"
#include "prohull/detail/collision_levels.h"
#include "prohull/detail/query_io.h"
#include "prohull/detail/summary.h"
#include "prohull/error.h"
#include "robot/json.h"

namespace prohull::cli {
namespace {

struct CollideOptions {
  std::filesystem::path a, b, poses, out, report;
  std::string pose, out_format;
  InputOptions input;
  bool distance = false, conservative = false;
  unsigned threads = 0;
};

const OutputKind kPairs{"pairs of faces", {".npz", ".csv"}};

std::vector<Pose> poses_of(const CollideOptions& options) {
  if (!options.poses.empty())
    return require_some(read_poses(read_bytes(options.poses), std::filesystem::path(input_name(options.poses))),
                        "poses", options.poses);
  if (options.pose.empty()) return {Pose{}};
  try {
    return {read_pose(options.pose, "--pose")};
  } catch (const InputError& error) {
    refuse(error.what());
  }
}

/// A mesh, or what of a .phull file is asked.
struct Body {
  CollisionIndex index;
  FinestLevel finest_level;
  SolidNotes notes = {};
};

Body read_body(const CollideOptions& options, const std::filesystem::path& path) {
  MeshOrHull read = read_mesh_or_hull(path, options.input);
  stop_if_interrupted();
  return naming(path, [&]() -> Body {
    if (const auto* const levels = std::get_if<ProgressiveHull>(&read))
      return {collision_index(*levels, options.conservative), levels->finest_level()};
    auto& mesh = std::get<TriangleMesh>(read);
    const CollisionIndex index(mesh);
    const SolidNotes notes = is_closed(mesh) ? SolidNotes::turning(mesh, path) : SolidNotes::not_closed(path);
    if (options.conservative && !notes.open.empty())
      throw InputError(Defect::OpenEdge,
                       "it is not closed, so that it encloses nothing, which --conservative could tell of; `prohull "
                       "repair` closes it");
    return {notes.turned.empty() ? index : CollisionIndex(mesh), FinestLevel::Input, notes};
  });
}

struct Answers {
  std::vector<bool> collide;  ///< of each pose
  FacePairBatch pairs;        ///< if they were asked for
  std::vector<Separation> separations;
};

Answers answer(const CollideOptions& options, const Body& a, const Body& b, const std::vector<Pose>& poses) {
  std::vector<PosePair> pairs;
  for (const Pose& pose : poses) pairs.push_back({{}, pose});
  ProgressLine line;
  const CollisionOptions how{.threads = options.threads, .progress = std::ref(line)};
  Answers answers;
  answers.collide =
      options.conservative ? may_collide(a.index, b.index, pairs, how) : collide(a.index, b.index, pairs, how);
  const bool one_collides = poses.size() == 1 && answers.collide[0] && !options.conservative;
  if (one_collides || !options.out.empty()) answers.pairs = intersecting_faces(a.index, b.index, pairs, how);
  if (options.distance) answers.separations = separation(a.index, b.index, pairs, how);
  return answers;
}

std::string bounds(const Separation& s) {
  if (s.lower == 0) return fmt::format("at most {:.17g} apart, proven", s.upper);
  return fmt::format("{:.9g} apart, proven between {:.17g} and {:.17g}", s.upper, s.lower, s.upper);
}

std::string verdict_of_one(const CollideOptions& options, const Answers& answers) {
  const std::string both = fmt::format("{} and {}", input_name(options.a), input_name(options.b));
  if (options.conservative)
    return answers.collide[0] ? fmt::format("MAY COLLIDE: the hulls of {} meet", both)
                              : fmt::format("free: {}, for certain", both);
  if (!answers.collide[0]) return fmt::format("free: {}, exactly", both);
  const std::size_t count = answers.pairs.pairs.size();
  return count == 0 ? fmt::format("COLLIDING: {}, of which one is inside of the other", both)
                    : fmt::format("COLLIDING: {} meet in {}", both, counted(count, "pair of faces", "pairs of faces"));
}

void print_summary(const CollideOptions& options, const Answers& answers) {
  const std::size_t poses = answers.collide.size();
  const auto colliding = static_cast<std::size_t>(std::ranges::count(answers.collide, true));
  if (poses == 1) {
    say("{}\n", verdict_of_one(options, answers));
    if (options.distance && !answers.separations[0].collide()) say("  {}\n", bounds(answers.separations[0]));
  } else {
    say("{} of {} {}\n", grouped(colliding), counted(poses, "pose"), options.conservative ? "may collide" : "collide");
    if (options.distance) {
      const auto distance = [](const Separation& s) {
        return s.collide() ? std::numeric_limits<double>::infinity() : s.upper;
      };
      const auto nearest = std::ranges::min_element(answers.separations, {}, distance);
      if (colliding < poses)
        say("  nearest of those that are free, pose {}: {}\n", nearest - answers.separations.begin(), bounds(*nearest));
    }
  }
  if (!options.out.empty())
    say("  {}: {}\n", output_name(options.out), counted(answers.pairs.pairs.size(), "pair of faces", "pairs of faces"));
}

void print_notes(const Body& body, const std::filesystem::path& path) {
  body.notes.say_them();
  if (const std::string finest = described_finest_level(body.finest_level); !finest.empty())
    say("  {} stands for {}: the finest level of the file is not the input itself\n", input_name(path), finest);
}

nlohmann::json facts_of_body(const Body& body, const std::filesystem::path& path) {
  return {{"path", path.string()},
          {"faces", body.index.face_count()},
          {"solid", body.index.is_solid()},
          {"inside_out", body.notes.is_inside_out()},
          {"finest_level", name_of(finest_level_names(), body.finest_level)}};
}

nlohmann::json separation_facts(const Separation& s) {
  nlohmann::json json{{"lower", s.lower}, {"upper", s.upper}};
  if (s.collide()) return json;
  json["face_a"] = index(s.face_a), json["point_a"] = s.point_a;
  json["face_b"] = index(s.face_b), json["point_b"] = s.point_b;
  return json;
}

nlohmann::json report_of(const CollideOptions& options, const Body& a, const Body& b, const Answers& answers,
                         double seconds) {
  std::vector<std::string> notes = a.notes.all();
  if (options.b != options.a) std::ranges::move(b.notes.all(), std::back_inserter(notes));
  nlohmann::json json = {{"a", facts_of_body(a, options.a)},
                         {"b", facts_of_body(b, options.b)},
                         {"notes", notes},
                         {"conservative", options.conservative},
                         {"poses", answers.collide.size()},
                         {"colliding", std::ranges::count(answers.collide, true)},
                         {"collide", answers.collide},
                         {"seconds", seconds}};
  if (!answers.pairs.offsets.empty()) json["face_pairs"] = answers.pairs.pairs.size();
  if (options.distance) json["distances"] = json_list(answers.separations, separation_facts);
  return json;
}

int run_collide(const CollideOptions& options) {
  const std::string suffix = options.out.empty() ? "" : output_suffix(options.out, kPairs, options.out_format);
  check_files({options.a, options.b, options.poses}, {options.out, options.report});
  const Stopwatch reading;
  const std::vector<Pose> poses = poses_of(options);
  const Body a = read_body(options, options.a), b = read_body(options, options.b);
  const double read_seconds = reading.seconds();
  const Stopwatch asking;
  const Answers answers = answer(options, a, b, poses);
  const double seconds = asking.seconds();
  Outputs outputs;
  outputs.add(options.out, suffix, [&](const auto& file) { return write_face_pairs(file, answers.pairs), true; });
  outputs.add_report(options.report, report_of(options, a, b, answers, seconds));
  outputs.commit();
  print_summary(options, answers);
  print_notes(a, options.a);
  if (options.b != options.a) print_notes(b, options.b);
  say_more("  {} and {}; read and index {:.2f} s, answer {:.3f} s\n", counted(a.index.face_count(), "face"),
           counted(b.index.face_count(), "face"), read_seconds, seconds);
  return std::ranges::find(answers.collide, true) == answers.collide.end() ? kDone : kAnswerIsNo;
}

}  // namespace

void add_collide(CLI::App& app, Run& run) {
  const auto [command, options] = add_command<CollideOptions>(
      app, run, "collide",
      "Decides exactly whether two meshes have a point in common, and exits with code 1 if they do. Touching counts, "
      "and so does a closed mesh that is wholly inside of another one. A closed mesh that is inside out is turned. Of "
      "a "
      "mesh that is not closed only the faces count, which is said even with --quiet. B may be moved and turned, also "
      "to many poses.",
      run_collide);
  add_value(command, "a", options.a, "A", std::string("Mesh or .phull file. ") + kMeshFiles)->required();
  add_value(command, "b", options.b, "B", "Mesh or .phull file, which the poses move.")->required();
  add_format_option(command, options.input);
  add_unit_options(command, options.input, "both meshes");
  CLI::Option* const pose =
      add_value(command, "--pose", options.pose, "NUMBERS",
                "Pose of B: seven numbers x,y,z,qw,qx,qy,qz, a translation and a quaternion; or twelve, the upper "
                "three rows of a matrix of 4 x 4. Without this option B stays where it is.");
  add_value(command, "--poses", options.poses, "FILE",
            "File of poses of B, one a row, .npy, .npz or .csv. An .npy array may also have the shape (n, 4, 4).")
      ->excludes(pose);
  CLI::Option* const out = add_value(
      command, "-o,--out", options.out, "PAIRS",
      "File for the pairs of faces that meet, .npz or .csv: pose, face_a, face_b. With - they go to standard output.");
  add_out_format_option(command, options.out_format, kPairs);
  CLI::Option* const distance = command.add_flag("--distance", options.distance,
                                                 "Also find the least distance of each pose, with proven bounds.");
  command
      .add_flag("--conservative", options.conservative,
                "Ask hulls in place of the meshes, which is faster. The hull of a .phull file is its base mesh; any "
                "other file is taken as a hull itself. Hulls that are free enclose meshes that are free. Hulls that "
                "meet may enclose meshes that are free, too.")
      ->excludes(out)
      ->excludes(distance);
  add_threads_option(command, options.threads, "The answers are the same for any number.");
  add_report_option(command, options.report);
  add_examples(command, {"prohull collide arm.stl wall.stl",
                         "prohull collide arm.stl tool.stl --pose 0.1,0,0.4,1,0,0,0 --distance",
                         "prohull collide arm.ply part.ply --poses poses.npy --report free.json",
                         "prohull collide gear.ply gear.ply --pose 12.5,0,0,1,0,0,0 -o contacts.csv",
                         "prohull collide arm.phull part.phull --poses poses.csv --conservative"});
}

}  // namespace prohull::cli
