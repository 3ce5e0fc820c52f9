#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

#include "command.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/float32_hull.h"
#include "prohull/hull_file.h"
#include "prohull/mesh_io.h"
#include "prohull/replay.h"

namespace prohull::cli {
namespace {

struct Options {
  std::filesystem::path in, out, hierarchy, report;
  HullOptions hull;
  double normal_deviation_degrees = 45;
  bool strict = false, no_self_intersections = false;
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

HullResult build(const ClosedMesh& input, const Options& options) {
  ProgressLine line("build");
  HullOptions hull_options = options.hull;
  hull_options.progress = [&](const HullProgress& p) {
    const double all = static_cast<double>(p.original_faces - std::min(p.target_faces, p.original_faces - 1));
    return line(static_cast<double>(p.original_faces - p.faces) / all);
  };
  HullResult result = build_hull(input.mesh, hull_options);
  if (result.stopped == Stopped::Cancelled || interrupted()) throw Interrupted{};
  return result;
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

// The proof of what was written: the splits are replayed, and the file is read again and compared bit for bit with the
// base mesh that they start from. Where rounding to the file's float32 moved vertices, the two files are compared
// exactly.
bool certify(const HullResult& result, const std::filesystem::path& file, const TriangleMesh& original) {
  ProgressLine line("verify");
  const auto progress = [&](double fraction) { return line(fraction); };
  const TriangleMesh written = read_mesh(file);
  bool certified = verify_replay(result.hull, original, progress).holds;
  if (certified && written != result.hull.base()) {
    try {
      EnclosureOptions enclosure;
      enclosure.progress = progress;
      certified = result.hull.side() == HullSide::Outer ? verify_enclosure(original, written, enclosure).encloses
                                                        : verify_enclosure(written, original, enclosure).encloses;
    } catch (const Cancelled&) {
      throw Interrupted{};
    }
  }
  if (interrupted()) throw Interrupted{};
  return certified;
}

int run_build(Options options) {
  const bool float32 = stores_float32(mesh_format(options.out));
  if (options.out.extension() == ".gz")
    throw InputError(Defect::InvalidOption,
                     options.out.string() + ": meshes are read from .gz, but not written; leave it out");
  options.hull.float32_coordinates = float32;
  options.hull.max_normal_deviation = options.normal_deviation_degrees * std::numbers::pi / 180;
  options.hull.allow_self_intersections = !options.no_self_intersections;

  require_distinct({options.in, options.out, options.hierarchy, options.report});
  for (const auto& path : {options.out, options.hierarchy, options.report}) require_writable(path);
  const Input input = read_closed_mesh(options.in);
  const ClosedMesh& original = input.closed;
  fmt::print("{}: {} faces, {} component{}\n", options.in.string(), grouped(original.report.faces),
             grouped(original.report.components), original.report.components == 1 ? "" : "s");
  for (const std::string& repair : describe(original.repairs)) fmt::print("  {}\n", repair);

  Stopwatch building;
  const HullResult result = build(original, options);
  TriangleMesh hull = result.hull.base();
  std::size_t rounded = 0;
  if (float32) {
    Float32Hull moved = with_float32_coordinates(hull, options.hull.side);
    hull = std::move(moved.mesh);
    rounded = moved.moved_vertices;
  }
  const double build_seconds = building.seconds();

  Stopwatch writing;
  Candidate candidate(options.out);
  write_mesh(candidate.path(), hull);
  const double write_seconds = writing.seconds();

  Stopwatch verifying;
  const bool certified = certify(result, candidate.path(), original.mesh);
  const double verify_seconds = verifying.seconds();
  if (certified) {
    candidate.accept();
    if (!options.hierarchy.empty()) save_hull(options.hierarchy, result.hull);
  }

  const double volume = signed_volume(hull), void_ratio = volume / original.report.volume - 1;
  const bool reached = result.stopped == Stopped::TargetReached;
  const bool outer = options.hull.side == HullSide::Outer;
  fmt::print("{}: {} hull of {} faces, void {:.3f} %\n", options.out.string(), outer ? "outer" : "inner",
             grouped(hull.face_count()), 100 * void_ratio);
  if (rounded > 0) fmt::print("  moved {} vertices to coordinates that the file keeps\n", grouped(rounded));
  if (!reached)
    fmt::print("  no legal collapse is left above the {} faces asked for; what refused the {} edges left: {}\n",
               grouped(options.hull.target_faces), grouped(3 * hull.face_count() / 2), listed(result.blocked));
  if (certified && !options.hierarchy.empty())
    fmt::print("{}: all levels from {} to {} faces\n", options.hierarchy.string(), grouped(hull.face_count()),
               grouped(original.report.faces));
  fmt::print("  certified: {}\n",
             certified ? fmt::format("yes, the file as written {} the original", outer ? "encloses" : "is enclosed by")
                       : "NO: nothing was written; please report this mesh");
  fmt::print("  read {:.2f} s, build {:.2f} s, write {:.2f} s, verify {:.2f} s\n",
             input.read_seconds + input.repair_seconds, build_seconds, write_seconds, verify_seconds);

  nlohmann::json in = facts(original.report);
  in["path"] = options.in.string();
  in["repairs"] = describe(original.repairs);
  write_report(options.report, {{"input", in},
                                {"hull",
                                 {{"path", options.out.string()},
                                  {"faces", hull.face_count()},
                                  {"vertices", hull.vertex_count()},
                                  {"volume", volume},
                                  {"void_ratio", void_ratio},
                                  {"rounded_vertices", rounded}}},
                                {"certified", certified},
                                {"stopped", reached ? "target_reached" : "no_legal_collapse"},
                                {"refusals", facts_of(result.refused)},
                                {"blocked", facts_of(result.blocked)},
                                {"seconds",
                                 {{"read", input.read_seconds},
                                  {"repair", input.repair_seconds},
                                  {"build", build_seconds},
                                  {"write", write_seconds},
                                  {"verify", verify_seconds}}},
                                {"options",
                                 {{"faces", options.hull.target_faces},
                                  {"side", name_of(side_names(), options.hull.side)},
                                  {"strategy", name_of(strategy_names(), options.hull.strategy)},
                                  {"max_valence", options.hull.max_valence},
                                  {"min_compactness_ratio", options.hull.min_compactness_ratio},
                                  {"sufficient_compactness", options.hull.sufficient_compactness},
                                  {"max_normal_deviation_degrees", options.normal_deviation_degrees},
                                  {"allow_self_intersections", options.hull.allow_self_intersections},
                                  {"float32_coordinates", float32}}}});
  return !certified || (options.strict && !reached) ? kAnswerIsNo : kDone;
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
  add_choice(command, "--side", hull.side, side_names(), "outer: encloses the mesh; inner: is enclosed by it");
  add_choice(command, "--strategy", hull.strategy, strategy_names(),
             "lazy: tight and fast; paper1, paper2: the two of Platis and Theoharis (2003)");
  command.add_option("--hierarchy", options->hierarchy, "Also write all levels, for lod and verify")
      ->type_name("H.phull");
  command.add_flag("--no-self-intersections", options->no_self_intersections,
                   "Refuse collapses that would make the hull intersect itself (inner hulls always do)");
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
                         "prohull build rock.obj --side inner --faces 300 -o occluder.obj",
                         "prohull build horse.ply --faces 200 -o hull.ply --hierarchy horse.phull"});
  command.callback([options, &run] { run = [options] { return run_build(*options); }; });
}

}  // namespace prohull::cli
