#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <optional>
#include <utility>

#include "command.h"
#include "prohull/distance.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/float32_hull.h"
#include "prohull/hull_file.h"
#include "prohull/mesh_io.h"
#include "prohull/replay.h"
#include "prohull/tight_hull.h"

namespace prohull::cli {
namespace {

struct Options {
  std::filesystem::path in, out, hierarchy, report;
  HullOptions hull;
  double normal_deviation_degrees = 45;
  double max_distance = 0;  ///< 0: any
  bool strict = false, tight = false, allow_self_intersections = false, no_self_intersections = false;
};

const Names<Strategy>& strategy_names() {
  static const Names<Strategy> names{
      {"lazy", Strategy::Lazy}, {"paper1", Strategy::Paper1}, {"paper2", Strategy::Paper2}};
  return names;
}

nlohmann::json facts_of(const RefusalCounts& counts) {
  nlohmann::json json;
  for (std::size_t i = 0; i < kRefusalKinds; ++i) json[std::string(name(Refusal(i)))] = counts[Refusal(i)];
  return json;
}

std::string listed(const RefusalCounts& counts) {
  std::string text;
  for (std::size_t i = 0; i < kRefusalKinds; ++i)
    if (const std::size_t count = counts[Refusal(i)])
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name(Refusal(i)), grouped(count));
  return text;
}

/// What was made, and whether it is proven.
struct Outcome {
  TriangleMesh hull;                      ///< as written
  std::optional<ProgressiveHull> levels;  ///< unless it is a tight hull
  Stopped stopped;
  RefusalCounts refused, blocked;
  std::size_t rounded_vertices = 0;
  bool certified = false;
  DistanceBounds distance = {};  ///< from the hull as written to the original
  MeshQuality quality = {};
  std::size_t input_self_intersections = 0, self_intersections = 0;
  double build_seconds = 0, write_seconds = 0, verify_seconds = 0;

  bool reached() const { return stopped == Stopped::TargetReached; }
  std::size_t added_self_intersections() const {
    return self_intersections - std::min(self_intersections, input_self_intersections);
  }
};

std::size_t coarsest_within(const ProgressiveHull& hull, double distance) {
  ProgressLine line("distance");
  try {
    return faces_within(hull, distance, {.progress = [&](double) { return line(0); }});
  } catch (const Cancelled&) {
    throw Interrupted{};
  }
}

double fraction_done(const HullProgress& p) {
  const double all = static_cast<double>(p.original_faces - std::min(p.target_faces, p.original_faces - 1));
  return static_cast<double>(p.original_faces - p.faces) / all;
}

TightHull build_tight(const TriangleMesh& mesh, HullOptions hull_options, double max_distance) {
  if (max_distance == 0) return build_tight_hull(mesh, hull_options);
  ProgressLine line("search");
  std::size_t builds = 0, last_target = 0;
  hull_options.progress = [&](const HullProgress& p) {
    builds += std::exchange(last_target, p.target_faces) != p.target_faces;
    return line((static_cast<double>(builds) - 1 + fraction_done(p)) / (kMaxTightBuilds + 1));
  };
  return build_tight_hull_within(mesh, max_distance, hull_options);
}

Outcome build(const ClosedMesh& input, const Options& options) {
  ProgressLine line("build");
  HullOptions hull_options = options.hull;
  hull_options.progress = [&](const HullProgress& p) { return line(fraction_done(p)); };
  Outcome outcome;
  if (options.tight) {
    TightHull tight = build_tight(input.mesh, hull_options, options.max_distance);
    outcome = {std::move(tight.mesh), std::nullopt, tight.stopped, tight.refused, tight.blocked};
  } else {
    HullResult result = build_hull(input.mesh, hull_options);
    if (options.max_distance > 0 && result.stopped != Stopped::Cancelled)
      result.hull = result.hull.with_base(coarsest_within(result.hull, options.max_distance));
    outcome = {result.hull.base(), std::move(result.hull), result.stopped, result.refused, result.blocked};
  }
  if (outcome.stopped == Stopped::Cancelled || interrupted()) throw Interrupted{};
  return outcome;
}

// A file beside another one, of the same format, that becomes it once it is certified, and vanishes otherwise.
class Candidate {
 public:
  explicit Candidate(const std::filesystem::path& target)
      : target_(exists(target) ? canonical(target) : target), path_(target_) {
    path_.replace_filename(
        fmt::format(".{}.{}.uncertified{}", target.stem().string(), getpid(), target_.extension().string()));
  }
  Candidate(const Candidate&) = delete;
  Candidate& operator=(const Candidate&) = delete;
  ~Candidate() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }
  void accept() { std::filesystem::rename(path_, target_); }

 private:
  std::filesystem::path target_, path_;
};

// The proof of what was written: the file is read again. The splits of a progressive hull, replayed, lead from its base
// mesh to the original; where the file holds another mesh, for it is tight or rounded to float32, that is compared with
// the original exactly.
bool certify(const Outcome& outcome, HullSide side, const std::filesystem::path& file, const TriangleMesh& original) {
  ProgressLine line("verify");
  const auto progress = [&](double fraction) { return line(fraction); };
  const TriangleMesh written = read_mesh(file);
  bool certified = !outcome.levels || verify_replay(*outcome.levels, original, progress).holds;
  if (certified && (!outcome.levels || written != outcome.levels->base())) {
    try {
      EnclosureOptions enclosure;
      enclosure.progress = progress;
      certified = side == HullSide::Outer ? verify_enclosure(original, written, enclosure).encloses
                                          : verify_enclosure(written, original, enclosure).encloses;
    } catch (const Cancelled&) {
      throw Interrupted{};
    }
  }
  if (interrupted()) throw Interrupted{};
  return certified;
}

void check_outputs(const Options& options) {
  mesh_format(options.out);
  if (options.out.extension() == ".gz")
    throw InputError(Defect::InvalidOption,
                     options.out.string() + ": meshes are read from .gz, but not written; leave it out");
  require_distinct({options.in, options.out, options.hierarchy, options.report});
  for (const auto& path : {options.out, options.hierarchy, options.report}) require_writable(path);
}

Outcome build_for_file(const ClosedMesh& input, const Options& options) {
  Stopwatch building;
  Outcome outcome = build(input, options);
  if (options.hull.float32_coordinates) {
    Float32Hull moved = with_float32_coordinates(outcome.hull, options.hull.side);
    outcome.hull = std::move(moved.mesh);
    outcome.rounded_vertices = moved.moved_vertices;
  }
  outcome.build_seconds = building.seconds();
  outcome.distance = distance_bounds(outcome.hull, input.mesh, {.progress = [](double) { return !interrupted(); }});
  outcome.quality = mesh_quality(outcome.hull);
  outcome.input_self_intersections = count_self_intersections(input.mesh);
  outcome.self_intersections = count_self_intersections(outcome.hull);
  return outcome;
}

void write_certified(const ClosedMesh& input, const Options& options, Outcome& outcome) {
  Stopwatch writing;
  Candidate candidate(options.out);
  write_mesh(candidate.path(), outcome.hull);
  outcome.write_seconds = writing.seconds();

  Stopwatch verifying;
  outcome.certified = certify(outcome, options.hull.side, candidate.path(), input.mesh);
  outcome.verify_seconds = verifying.seconds();
  if (!outcome.certified) return;
  candidate.accept();
  if (!options.hierarchy.empty()) save_hull(options.hierarchy, *outcome.levels);
}

double void_ratio(const Outcome& outcome, const ClosedMesh& input) {
  return signed_volume(outcome.hull) / input.report.volume - 1;
}

void print_input(const Options& options, const ClosedMesh& input) {
  fmt::print("{}: {} faces, {} component{}\n", options.in.string(), grouped(input.report.faces),
             grouped(input.report.components), input.report.components == 1 ? "" : "s");
  for (const std::string& repair : describe(input.repairs)) fmt::print("  {}\n", repair);
}

std::string described_self_intersections(const Outcome& outcome) {
  if (outcome.self_intersections == 0)
    return outcome.input_self_intersections == 0
               ? "none"
               : fmt::format("none (the mesh: {} pairs of faces)", grouped(outcome.input_self_intersections));
  return fmt::format("{} pairs of faces (the mesh: {}; added: {})", grouped(outcome.self_intersections),
                     grouped(outcome.input_self_intersections), grouped(outcome.added_self_intersections()));
}

void print_summary(const Options& options, const Input& input, const Outcome& outcome) {
  const bool outer = options.hull.side == HullSide::Outer;
  const std::size_t faces = outcome.hull.face_count();
  fmt::print("{}: {} hull of {} faces, void {:.3f} %, at most {:.4g} from the mesh\n", options.out.string(),
             outer ? "outer" : "inner", grouped(faces), 100 * void_ratio(outcome, input.closed),
             outcome.distance.upper);
  fmt::print("  self-intersections: {}\n", described_self_intersections(outcome));
  fmt::print("  triangles: {}\n", described(outcome.quality));
  if (outcome.rounded_vertices > 0)
    fmt::print("  moved {} vertices to coordinates that the file keeps\n", grouped(outcome.rounded_vertices));
  if (!outcome.reached())
    fmt::print("  no legal collapse is left above the {} faces asked for; what refused the {} edges left: {}\n",
               grouped(options.hull.target_faces), grouped(3 * faces / 2), listed(outcome.blocked));
  if (outcome.certified && !options.hierarchy.empty())
    fmt::print("{}: all levels from {} to {} faces\n", options.hierarchy.string(), grouped(faces),
               grouped(input.closed.report.faces));
  fmt::print("  certified: {}\n", outcome.certified ? fmt::format("yes, the file as written {} the original",
                                                                  outer ? "encloses" : "is enclosed by")
                                                    : "NO: nothing was written; please report this mesh");
  fmt::print("  read {:.2f} s, build {:.2f} s, write {:.2f} s, verify {:.2f} s\n",
             input.read_seconds + input.repair_seconds, outcome.build_seconds, outcome.write_seconds,
             outcome.verify_seconds);
}

nlohmann::json options_report(const Options& options) {
  const HullOptions& hull = options.hull;
  return {{"faces", hull.target_faces},
          {"side", name_of(side_names(), hull.side)},
          {"max_distance", options.max_distance > 0 ? nlohmann::json(options.max_distance) : nlohmann::json()},
          {"tight", options.tight},
          {"strategy", name_of(strategy_names(), hull.strategy)},
          {"max_valence", hull.max_valence},
          {"min_compactness_ratio", hull.min_compactness_ratio},
          {"sufficient_compactness", hull.sufficient_compactness},
          {"max_normal_deviation_degrees", options.normal_deviation_degrees},
          {"allow_self_intersections", !options.tight && !hull.refuses_self_intersections()},
          {"seed", hull.seed},
          {"best_of", hull.best_of},
          {"float32_coordinates", hull.float32_coordinates}};
}

nlohmann::json report_of(const Options& options, const Input& input, const Outcome& outcome) {
  nlohmann::json in = facts(input.closed.report);
  in["path"] = options.in.string();
  in["repairs"] = describe(input.closed.repairs);
  in["self_intersections"] = outcome.input_self_intersections;
  return {{"input", in},
          {"hull",
           {{"path", options.out.string()},
            {"faces", outcome.hull.face_count()},
            {"vertices", outcome.hull.vertex_count()},
            {"volume", signed_volume(outcome.hull)},
            {"void_ratio", void_ratio(outcome, input.closed)},
            {"distance_bound", outcome.distance.upper},
            {"self_intersections", outcome.self_intersections},
            {"added_self_intersections", outcome.added_self_intersections()},
            {"quality", facts(outcome.quality)},
            {"rounded_vertices", outcome.rounded_vertices}}},
          {"certified", outcome.certified},
          {"stopped", outcome.reached() ? "target_reached" : "no_legal_collapse"},
          {"refusals", facts_of(outcome.refused)},
          {"blocked", facts_of(outcome.blocked)},
          {"seconds",
           {{"read", input.read_seconds},
            {"repair", input.repair_seconds},
            {"build", outcome.build_seconds},
            {"write", outcome.write_seconds},
            {"verify", outcome.verify_seconds}}},
          {"options", options_report(options)}};
}

int run_build(Options options) {
  check_outputs(options);
  options.hull.float32_coordinates = stores_float32(mesh_format(options.out));
  options.hull.max_normal_deviation = options.normal_deviation_degrees * kDegree;
  if (options.allow_self_intersections && options.hull.side == HullSide::Inner)
    throw InputError(Defect::InvalidOption,
                     "--allow-self-intersections: not of an inner hull, it could stick out of the mesh");
  if (options.allow_self_intersections) options.hull.self_intersections = SelfIntersections::Allowed;
  if (options.no_self_intersections) options.hull.self_intersections = SelfIntersections::Refused;

  const Input input = read_closed_mesh(options.in);
  print_input(options, input.closed);
  Outcome outcome = build_for_file(input.closed, options);
  write_certified(input.closed, options, outcome);
  print_summary(options, input, outcome);
  write_report(options.report, report_of(options, input, outcome));
  return !outcome.certified || (options.strict && !outcome.reached()) ? kAnswerIsNo : kDone;
}

}  // namespace

void add_build(CLI::App& app, Run& run) {
  const auto options = std::make_shared<Options>();
  HullOptions& hull = options->hull;
  CLI::App& command = *app.add_subcommand("build", "Build a hull of a closed mesh, certified");
  command.add_option("in", options->in, "Closed mesh: PLY, OBJ, OFF or STL, also .gz or .zip")
      ->required()
      ->type_name("IN");
  command.add_option("-o,--out", options->out, "Where the hull goes: .ply, .obj, .off or .stl")
      ->required()
      ->type_name("OUT");
  command.add_option("--faces", hull.target_faces, "Stop at this many faces, at least 4")
      ->capture_default_str()
      ->check(CLI::Range(4.0, 1e9));
  command
      .add_option("--max-distance", options->max_distance,
                  "The coarsest level, of at least --faces, with no point farther from the mesh, in its unit; proven. "
                  "With --tight: the coarsest of some ten hulls built to find it")
      ->check(CLI::PositiveNumber)
      ->type_name("D");
  add_choice(command, "--side", hull.side, side_names(), "outer: encloses the mesh; inner: is enclosed by it");
  CLI::Option* tight = command.add_flag("--tight", options->tight,
                                        "Move vertices towards the mesh between collapses: the least void, never "
                                        "self-intersecting, some ten times slower");
  add_choice(command, "--strategy", hull.strategy, strategy_names(),
             "lazy: tight and fast; paper1, paper2: the two of Platis and Theoharis (2003)");
  command.add_option("--hierarchy", options->hierarchy, "Also write all levels, for lod and verify")
      ->excludes(tight)
      ->type_name("H.phull");
  CLI::Option* allow = command.add_flag("--allow-self-intersections", options->allow_self_intersections,
                                        "Do not refuse collapses that make an outer hull intersect itself: faster; the "
                                        "default of paper1 and paper2");
  command
      .add_flag("--no-self-intersections", options->no_self_intersections,
                "Refuse them; the default of lazy, of --tight and of inner hulls")
      ->excludes(allow);
  allow->excludes(tight);
  command
      .add_option("--best-of", hull.best_of,
                  "Build with so many seeds, on all threads, and keep the hull of least void; lazy and --tight only")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 1e6))
      ->type_name("N");
  command
      .add_option("--seed", hull.seed,
                  "The first of the seeds; others give slightly different hulls, of lazy and --tight")
      ->capture_default_str();
  command
      .add_option(
          "--threads", hull.threads,
          "At most so many, and no more than there are cores; 0: all of them. The hull is the same for any number")
      ->capture_default_str();
  command.add_flag("--strict", options->strict, "Exit with 1 if the face count is not reached");
  add_report_option(command, options->report);
  constexpr const char* kGuards = "Guards";
  command.add_option("--max-valence", hull.max_valence, "Most faces around a new vertex")
      ->capture_default_str()
      ->check(CLI::Range(3.0, 1e6))
      ->group(kGuards);
  command
      .add_option("--compactness-ratio", hull.min_compactness_ratio,
                  "Least compactness of a star after a collapse, relative to before, 0 to 1")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0))
      ->group(kGuards);
  command
      .add_option("--sufficient-compactness", hull.sufficient_compactness,
                  "Compactness that is enough whatever it was before, 0 to 1 (lazy only)")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0))
      ->group(kGuards);
  command
      .add_option("--normal-deviation", options->normal_deviation_degrees,
                  "Most degrees by which a collapse may turn a face, 0 to 90")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 90.0))
      ->group(kGuards);
  add_examples(command, {"prohull build horse.ply --faces 2000 -o hull.ply",
                         "prohull build arm.stl --faces 500 -o arm_collision.stl --report arm.json",
                         "prohull build arm.stl --faces 200 --tight -o arm_collision.stl",
                         "prohull build arm.stl --faces 200 --tight --best-of 9 -o arm_collision.stl",
                         "prohull build arm.stl --faces 50 --tight --max-distance 2 -o arm_collision.stl",
                         "prohull build rock.obj --side inner --faces 300 -o occluder.obj",
                         "prohull build horse.ply --faces 200 -o hull.ply --hierarchy horse.phull"});
  command.callback([options, &run] { run = [options] { return run_build(*options); }; });
}

}  // namespace prohull::cli
