#include <fmt/format.h>

#include <thread>

#include "command.h"
#include "kdop/kdop_index.h"
#include "prohull/error.h"
#include "prohull/mesh_query.h"
#include "prohull/query_io.h"
#include "prohull/random_segments.h"

namespace prohull::cli {
namespace {

/// An engine of the library, or trees of k-DOPs, the paper's peer, by their name.
using EngineChoice = std::variant<Engine, std::string_view>;

struct Options {
  std::filesystem::path in, segments, rays, triangles, out, write_segments, report;
  std::size_t random = 0;
  std::uint64_t seed = 1;
  HitMode mode = HitMode::First;
  EngineChoice engine = Engine::Auto;
  unsigned threads = 0;
};

using NamedEngine = std::pair<std::string_view, EngineChoice>;

Names<EngineChoice> engine_choices() {
  static const std::vector<NamedEngine> choices = [] {
    std::vector<NamedEngine> all(engine_names().begin(), engine_names().end());
    for (const std::string_view name : kdop_names()) all.emplace_back(name, name);
    return all;
  }();
  return choices;
}

// What differs between the kinds of queries.
std::string_view noun(const std::vector<Segment>&) { return "segment"; }
std::string_view noun(const std::vector<Ray>&) { return "ray"; }
std::string_view noun(const std::vector<Triangle>&) { return "triangle"; }

HitBatch ask(const QueryIndex& index, const std::vector<Segment>& segments, HitMode mode, const BatchOptions& batch) {
  return find_hits(index, segments, mode, batch);
}
HitBatch ask(const QueryIndex& index, const std::vector<Ray>& rays, HitMode mode, const BatchOptions& batch) {
  return find_hits(index, rays, mode, batch);
}
FaceBatch ask(const QueryIndex& index, const std::vector<Triangle>& triangles, HitMode, const BatchOptions& batch) {
  return find_faces_met(index, triangles, batch);
}

void write(const std::filesystem::path& path, const HitBatch& batch, const std::vector<Segment>&) {
  write_hits(path, batch, HitsOf::Segments);
}
void write(const std::filesystem::path& path, const HitBatch& batch, const std::vector<Ray>&) {
  write_hits(path, batch, HitsOf::Rays);
}
void write(const std::filesystem::path& path, const FaceBatch& batch, const std::vector<Triangle>&) {
  write_faces_met(path, batch);
}

using Queries = std::variant<std::vector<Segment>, std::vector<Ray>, std::vector<Triangle>>;

struct Seconds {
  double read = 0, index = 0, query = 0, write = 0;
};

void check_outputs(const Options& options) {
  if (!options.out.empty()) hits_format(options.out);
  if (!options.write_segments.empty()) segments_format(options.write_segments);
  require_distinct({options.in, options.segments, options.rays, options.triangles, options.out, options.write_segments,
                    options.report});
  for (const auto& path : {options.out, options.write_segments, options.report}) require_writable(path);
}

using MeshOrHull = std::variant<TriangleMesh, ProgressiveHull>;

std::size_t face_count(const MeshOrHull& target) {
  const auto* const hull = std::get_if<ProgressiveHull>(&target);
  return hull ? hull->original_face_count() : std::get<TriangleMesh>(target).face_count();
}

TriangleMesh mesh_of(MeshOrHull target) {
  const auto* const hull = std::get_if<ProgressiveHull>(&target);
  return hull ? hull->original() : std::get<TriangleMesh>(std::move(target));
}

Box box_of(const MeshOrHull& target) {
  const auto* const mesh = std::get_if<TriangleMesh>(&target);
  return bounding_box(mesh ? *mesh : mesh_of(target));
}

Queries make_queries(const Options& options, const MeshOrHull& target) {
  if (!options.segments.empty()) return read_segments(options.segments);
  if (!options.rays.empty()) return read_rays(options.rays);
  if (!options.triangles.empty()) return read_triangles(options.triangles);
  return random_segments(box_of(target), options.random, options.seed);
}

QueryIndex make_index(MeshOrHull target, const Options& options) {
  try {
    if (const auto* const kdops = std::get_if<std::string_view>(&options.engine))
      return kdop_index(mesh_of(std::move(target)), *kdops);
    return std::visit(
        [&](auto& mesh_or_hull) { return QueryIndex(std::move(mesh_or_hull), std::get<Engine>(options.engine)); },
        target);
  } catch (const InputError& error) {
    throw InputError(error.defect(), options.in.string() + ": " + error.what());
  }
}

unsigned threads_used(const Options& options) {
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  return options.threads == 0 ? cores : std::min(options.threads, cores);
}

bool counts_tests(const EngineChoice& engine) {
  return engine == EngineChoice(Engine::Refinement) || engine == EngineChoice(Engine::PaperRefinement);
}

/// What has come of the queries, whatever their kind.
struct Outcome {
  std::string_view noun;
  std::size_t queries, answers, answered;  ///< hits or faces met; queries that have any
  QueryCounts counts;
  std::string_view engine;  ///< the name of the one that answered
  Seconds seconds;

  double per_second() const { return seconds.query > 0 ? static_cast<double>(queries) / seconds.query : 0; }
  double per_query(std::size_t count) const {
    return queries > 0 ? static_cast<double>(count) / static_cast<double>(queries) : 0;
  }
};

std::size_t count_answered(const std::vector<std::size_t>& offsets) {
  std::size_t answered = 0;
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i) answered += offsets[i] < offsets[i + 1];
  return answered;
}

void print_summary(const Options& options, const Outcome& outcome) {
  const bool faces = outcome.noun == "triangle";
  const std::string out = options.out.empty() ? "" : options.out.string() + ": ";
  const bool one = outcome.answers == 1;
  fmt::print("{}{} {}; {} of {} {}s {} ({:.2f} %)\n", out, grouped(outcome.answers),
             faces ? (one ? "face met" : "faces met") : (one ? "hit" : "hits"), grouped(outcome.answered),
             grouped(outcome.queries), outcome.noun, faces ? "meet some" : "hit",
             100 * outcome.per_query(outcome.answered));
  const unsigned threads = threads_used(options);
  fmt::print("  engine {}, {} thread{}: {} {}s per second\n", outcome.engine, threads, threads == 1 ? "" : "s",
             grouped(static_cast<std::size_t>(outcome.per_second())), outcome.noun);
  if (counts_tests(options.engine))
    fmt::print("  {:.1f} faces tested and {:.1f} vertices split per {}\n", outcome.per_query(outcome.counts.tests),
               outcome.per_query(outcome.counts.splits), outcome.noun);
  const Seconds& s = outcome.seconds;
  fmt::print("  read {:.2f} s, index {:.2f} s, query {:.2f} s, write {:.2f} s\n", s.read, s.index, s.query, s.write);
}

nlohmann::json report_of(const Options& options, const Outcome& outcome) {
  nlohmann::json json = {{"queries", outcome.queries},
                         {"kind", std::string(outcome.noun) + "s"},
                         {outcome.noun == "triangle" ? "faces_met" : "hits", outcome.answers},
                         {"queries_hit", outcome.answered},
                         {"queries_per_second", outcome.per_second()},
                         {"engine", outcome.engine},
                         {"threads", threads_used(options)},
                         {"seconds",
                          {{"read", outcome.seconds.read},
                           {"index", outcome.seconds.index},
                           {"query", outcome.seconds.query},
                           {"write", outcome.seconds.write}}}};
  if (outcome.noun != "triangle") json["mode"] = name_of(hit_mode_names(), options.mode);
  if (options.random > 0) json["seed"] = options.seed;
  if (counts_tests(options.engine)) json["tests"] = outcome.counts.tests, json["splits"] = outcome.counts.splits;
  return json;
}

template <class Query>
Outcome answer(const Options& options, const QueryIndex& index, const std::vector<Query>& queries, Seconds seconds) {
  Stopwatch asking;
  const auto batch = [&] {
    ProgressLine line("query");
    const BatchOptions how{.threads = options.threads, .progress = line.as_progress()};
    try {
      return ask(index, queries, options.mode, how);
    } catch (const Cancelled&) {
      throw Interrupted{};
    }
  }();
  seconds.query = asking.seconds();
  if (interrupted()) throw Interrupted{};
  Stopwatch writing;
  if (!options.out.empty()) write(options.out, batch, queries);
  seconds.write = writing.seconds();
  return {noun(queries),       queries.size(), batch.offsets.back(), count_answered(batch.offsets), batch.counts,
          index.engine_name(), seconds};
}

int run_query(const Options& options) {
  check_outputs(options);
  Seconds seconds;
  Stopwatch reading;
  MeshOrHull target = read_mesh_or_hull(options.in);
  const std::size_t faces = face_count(target);
  if (faces == 0)
    throw InputError(Defect::EmptyMesh, options.in.string() + ": it has no faces, so that nothing can hit it");
  const Queries queries = make_queries(options, target);
  seconds.read = reading.seconds();
  if (interrupted()) throw Interrupted{};

  Stopwatch indexing;
  const QueryIndex index = make_index(std::move(target), options);
  seconds.index = indexing.seconds();
  if (interrupted()) throw Interrupted{};
  const Outcome outcome = std::visit([&](const auto& q) { return answer(options, index, q, seconds); }, queries);
  if (!options.write_segments.empty()) write_segments(options.write_segments, std::get<std::vector<Segment>>(queries));
  fmt::print("{}: {} faces\n", options.in.string(), grouped(faces));
  if (options.random > 0) fmt::print("{} random segments, seed {}\n", grouped(options.random), options.seed);
  print_summary(options, outcome);
  nlohmann::json json = report_of(options, outcome);
  json["input"] = {{"path", options.in.string()}, {"faces", faces}};
  write_report(options.report, json);
  return kDone;
}

void add_queries(CLI::App& command, Options& options) {
  CLI::App& queries = *command.add_option_group("Queries", "One of these; files are .npy, .npz or .csv");
  queries.add_option("--segments", options.segments, "Each row x0,y0,z0,x1,y1,z1")->type_name("FILE");
  queries.add_option("--rays", options.rays, "Each row an origin and a direction")->type_name("FILE");
  CLI::Option* const triangles =
      queries.add_option("--triangles", options.triangles, "Each row three corners; answered by the faces they meet")
          ->type_name("FILE");
  CLI::Option* const random =
      queries
          .add_option("--random", options.random,
                      "So many segments from one side to another of a box twice as large as the mesh's")
          ->check(CLI::Range(1.0, 1e9))
          ->type_name("N");
  queries.require_option(1);
  command.add_option("--seed", options.seed, "Of the random segments")->capture_default_str()->needs(random);
  command.add_option("--write-segments", options.write_segments, "Where the random segments go: .npy or .csv")
      ->needs(random)
      ->type_name("FILE");
  add_choice(command, "--mode", options.mode, hit_mode_names(), "Which hits of a segment or ray")->excludes(triangles);
}

}  // namespace

void add_query(CLI::App& app, Run& run) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(
      "query", "Find where segments, rays or triangles meet a mesh, exactly; it need not be closed");
  command
      .add_option("in", options->in, "Mesh (PLY, OBJ, OFF, STL, GLB, DAE, 3MF, ...; also .gz or .zip) or .phull file")
      ->required()
      ->type_name("IN");
  command.add_option("-o,--out", options->out, "Where the hits go: .npz or .csv; without, only the summary")
      ->type_name("HITS");
  add_queries(command, *options);
  add_choice(command, "--engine", options->engine, engine_choices(),
             "auto: the fastest that is exact; others, see docs/queries.md");
  command
      .add_option("--threads", options->threads, "At most so many, and no more than there are cores; 0: all of them")
      ->capture_default_str();
  add_report_option(command, options->report);
  add_examples(command,
               {"prohull query horse.ply --random 10000", "prohull query horse.ply --segments segments.npy -o hits.npz",
                "prohull query scan.stl --rays rays.csv --mode all -o hits.csv --threads 4",
                "prohull query arm.obj --triangles tool.npy -o contacts.csv",
                "prohull query horse.phull --random 10000 --engine paper-refinement --report counts.json"});
  command.callback([options, &run] { run = [options] { return run_query(*options); }; });
}

}  // namespace prohull::cli
