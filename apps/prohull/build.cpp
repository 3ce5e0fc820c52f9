#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "build_summary.h"
#include "command.h"
#include "prohull/distance.h"
#include "prohull/enclosing_hull.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/hull_file.h"
#include "prohull/mesh_io.h"

namespace prohull::cli {
namespace {

constexpr std::string_view kFacesInName = "{faces}";

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

std::filesystem::path path_for(const std::filesystem::path& pattern, std::size_t faces) {
  std::string name = pattern.string();
  if (const auto at = name.find(kFacesInName); at != std::string::npos)
    name.replace(at, kFacesInName.size(), std::to_string(faces));
  return name;
}

void check_outputs(const BuildOptions& options) {
  mesh_format(options.out);
  if (options.out.extension() == ".gz")
    throw InputError(Defect::InvalidOption,
                     options.out.string() + ": meshes are read from .gz, but not written; leave it out");
  if (options.faces.size() > 1 && options.out.string().find(kFacesInName) == std::string::npos)
    throw InputError(Defect::InvalidOption,
                     fmt::format("{}: several hulls need several names; put {{faces}} where the number of faces goes, "
                                 "as in hull_{{faces}}.stl",
                                 options.out.string()));
  if (options.faces.size() > 1 && !options.hierarchy.empty())
    throw InputError(Defect::InvalidOption, "--hierarchy: of one hull only; its file holds all finer levels anyway");
  std::vector<std::filesystem::path> files{options.in, options.hierarchy, options.report};
  for (const std::size_t faces : options.faces) files.push_back(path_for(options.out, faces));
  require_distinct(files);
  for (std::size_t i = 1; i < files.size(); ++i) require_writable(files[i]);
}

/// One line after another: for each stage its own.
class Progress {
 public:
  bool operator()(std::string_view stage, double fraction) {
    if (!line_ || stage != stage_) {
      line_.reset();
      stage_ = stage;
      line_.emplace(stage_);
    }
    return (*line_)(fraction);
  }

 private:
  std::string stage_;
  std::optional<ProgressLine> line_;
};

EnclosingHulls build(const TriangleMesh& mesh, const BuildOptions& options) {
  Progress progress;
  EnclosingOptions enclosing = options.enclosing;
  enclosing.progress = std::ref(progress);
  try {
    EnclosingHulls made = enclosing_hulls(mesh, options.faces, enclosing);
    if (interrupted()) throw Interrupted{};
    return made;
  } catch (const Cancelled&) {
    throw Interrupted{};
  } catch (const InputError& error) {
    throw InputError(error.defect(), fmt::format("{}: {}", options.in.string(), error.what()));
  }
}

/// The triangles of a file, bit for bit: STL does not keep how vertices are numbered.
bool has_triangles_of(const TriangleMesh& file, const TriangleMesh& mesh) {
  if (file.face_count() != mesh.face_count()) return false;
  for (const FaceId f : mesh.triangles.ids()) {
    const Triangle s = file.triangle(f), t = mesh.triangle(f);
    if (!(s.a == t.a && s.b == t.b && s.c == t.c)) return false;
  }
  return true;
}

Written write_certified(EnclosingHull hull, const BuildOptions& options) {
  Written written;
  written.hull = std::move(hull);
  written.path = path_for(options.out, written.hull.target_faces);
  if (!written.hull.certified) return written;
  Stopwatch writing;
  Candidate candidate(written.path);
  write_mesh(candidate.path(), written.hull.mesh);
  written.certified = has_triangles_of(read_mesh(candidate.path()), written.hull.mesh);
  if (written.certified) {
    candidate.accept();
    if (!options.hierarchy.empty()) save_hull(options.hierarchy, *written.hull.levels);
  }
  written.write_seconds = writing.seconds();
  return written;
}

void measure(BuildOutcome& outcome) {
  const EnclosingHulls& made = outcome.made;
  const Solid& first = made.solids.front();
  outcome.input_self_intersections =
      first.wrap_alpha > 0 ? count_self_intersections(made.input.original) : first.self_intersections;
  for (Written& written : outcome.written) {
    const bool wrapped = written.hull.wrap_alpha > 0;
    try {
      written.distance = distance_bounds(written.hull.mesh, wrapped ? made.input.original : made.input.closed->mesh,
                                         {.progress = [](std::string_view, double) { return !interrupted(); }});
    } catch (const Cancelled&) {
      throw Interrupted{};
    }
    written.quality = mesh_quality(written.hull.mesh);
  }
}

void check_sides(const BuildOptions& options) {
  if (options.allow_self_intersections && !options.is_outer())
    throw InputError(Defect::InvalidOption,
                     "--allow-self-intersections: not of an inner hull, it could stick out of the mesh");
}

int run_build(BuildOptions options) {
  check_outputs(options);
  check_sides(options);
  HullOptions& hull = options.enclosing.hull;
  hull.float32_coordinates = stores_float32(mesh_format(options.out));
  hull.guards.max_normal_deviation = options.normal_deviation_degrees * kDegree;
  if (options.max_void_percent > 0) options.enclosing.bounds.max_void_ratio = options.max_void_percent / 100;
  if (options.allow_self_intersections) hull.self_intersections = SelfIntersections::Allowed;
  if (options.no_self_intersections) hull.self_intersections = SelfIntersections::Refused;
  options.enclosing.levels = !options.hierarchy.empty();
#ifdef PROHULL_HAS_WRAP
  options.enclosing.wrap = alpha_wrap;
#endif

  BuildOutcome outcome;
  Stopwatch reading;
  const TriangleMesh mesh = read_input(options.in, NonFinite::Keep);
  outcome.read_seconds = reading.seconds();
  outcome.made = build(mesh, options);
  for (EnclosingHull& made : outcome.made.hulls) outcome.written.push_back(write_certified(std::move(made), options));
  measure(outcome);
  print_summary(options, outcome);
  write_report(options.report, report_of(options, outcome));
  const bool all_certified = std::ranges::all_of(outcome.written, &Written::certified);
  const bool all_as_asked = std::ranges::all_of(outcome.written, &Written::is_as_asked);
  return !all_certified || (options.strict && !all_as_asked) ? kAnswerIsNo : kDone;
}

}  // namespace

void add_build(CLI::App& app, Run& run) {
  const auto options = std::make_shared<BuildOptions>();
  EnclosingOptions& enclosing = options->enclosing;
  HullOptions& hull = enclosing.hull;
  hull.relax_guards = true;
  CLI::App& command = *app.add_subcommand("build", "Build a hull of any mesh, certified");
  command
      .add_option("in", options->in,
                  "Mesh: PLY, OBJ, OFF, STL, GLB, DAE, 3MF and others (docs/formats.md), also .gz or .zip")
      ->required()
      ->type_name("IN");
  command
      .add_option("-o,--out", options->out,
                  "Where the hull goes: .ply, .obj, .off, .stl or .glb; {faces} in it becomes the number asked for")
      ->required()
      ->type_name("OUT");
  command
      .add_option("--faces", options->faces, "Stop at this many faces, at least 4; several, as 1000,100: a hull each")
      ->delimiter(',')
      ->capture_default_str()
      ->type_name("N[,N...]")
      ->check(CLI::Range(4.0, 1e9));
  command
      .add_option("--max-distance", enclosing.bounds.max_distance,
                  "The coarsest level, of at least --faces, with no point farther from the mesh, in its unit; proven. "
                  "With --tight: the coarsest of some ten hulls built to find it")
      ->check(CLI::PositiveNumber)
      ->type_name("D");
  command
      .add_option(
          "--max-void", options->max_void_percent,
          "The same with a volume at most so much greater (of inner hulls smaller) than that of the mesh, or of "
          "its wrap, in per cent")
      ->check(CLI::PositiveNumber)
      ->type_name("PCT");
  command.add_option("--max-added-volume", enclosing.bounds.max_added_volume, "The same in the mesh's unit, cubed")
      ->check(CLI::PositiveNumber)
      ->type_name("V");
  add_choice(command, "--side", hull.side, hull_side_names(), "outer: encloses the mesh; inner: is enclosed by it");
  CLI::Option* tight = command.add_flag("--tight", enclosing.tight,
                                        "Move vertices towards the mesh between collapses: the least void, never "
                                        "self-intersecting, some twenty to seventy times slower");
  add_choice(
      command, "--repair", enclosing.repair, repair_names(),
      "auto: repairs what is not closed, and wraps where that is not enough; none: refuses; wrap: wraps at once");
  command.add_flag("--keep-cavities", enclosing.keep_cavities,
                   "Keep components that lie inside of others; inner hulls always do");
  command
      .add_option("--seal-holes", enclosing.seal_holes,
                  "Where it wraps, close openings up to D across, in the mesh's unit")
      ->check(CLI::PositiveNumber)
      ->type_name("D");
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
  command.add_flag("--strict", options->strict, "Exit with 1 if the face count or a bound is not reached");
  add_report_option(command, options->report);
  constexpr const char* kGuards = "Guards";
  command
      .add_flag("!--keep-guards", hull.relax_guards,
                "Do not relax them in the end, in three steps, where the number of faces is not reached otherwise")
      ->group(kGuards);
  command.add_option("--max-valence", hull.guards.max_valence, "Most faces around a new vertex")
      ->capture_default_str()
      ->check(CLI::Range(3.0, 1e6))
      ->group(kGuards);
  command
      .add_option("--compactness-ratio", hull.guards.min_compactness_ratio,
                  "Least compactness of a star after a collapse, relative to before, 0 to 1")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0))
      ->group(kGuards);
  command
      .add_option("--sufficient-compactness", hull.guards.sufficient_compactness,
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
                         "prohull build arm.dae --faces 1000,300,100 -o arm_{faces}.stl",
                         "prohull build open_scan.obj --faces 500 --seal-holes 0.02 -o scan.glb",
                         "prohull build rock.obj --side inner --faces 300 -o occluder.obj",
                         "prohull build horse.ply --faces 200 -o hull.ply --hierarchy horse.phull"});
  command.callback([options, &run] { run = [options] { return run_build(*options); }; });
}

}  // namespace prohull::cli
