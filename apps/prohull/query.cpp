#include <fmt/format.h>

#include <optional>

#include "asked_mesh.h"
#include "command.h"
#include "paper/engines.h"
#include "prohull/detail/memory.h"
#include "prohull/detail/query_io.h"
#include "prohull/detail/random_segments.h"
#include "prohull/error.h"
#include "prohull/mesh_query.h"

namespace prohull::cli {
namespace {

struct QueryOptions {
  std::filesystem::path in, inner, segments, rays, triangles, out, report;
  std::string out_format;
  InputOptions input;
  RandomQueries random;
  HitMode mode = HitMode::First;
  std::string engine = "auto";
  unsigned threads = 0;
  bool conservative = false;
};

const OutputKind kHits{"hits", {".npz", ".csv"}};

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

/// What the names of the outputs end in.
struct Suffixes {
  std::string out, segments;
};

Suffixes check_outputs(const QueryOptions& options) {
  Suffixes suffixes;
  if (!options.out.empty()) suffixes.out = output_suffix(options.out, kHits, options.out_format);
  suffixes.segments = options.random.suffix("segments");
  check_files({options.in, options.inner, options.segments, options.rays, options.triangles},
              {options.out, options.random.file, options.report});
  return suffixes;
}

Queries make_queries(const QueryOptions& options, const AskedMesh& asked) {
  const auto read = [](auto reader, std::string_view what, const std::filesystem::path& path) {
    return require_some(reader(read_bytes(path), input_name(path)), what, path);
  };
  if (!options.segments.empty()) return read(read_segments, "segments", options.segments);
  if (!options.rays.empty()) return read(read_rays, "rays", options.rays);
  if (!options.triangles.empty()) return read(read_triangles, "triangles", options.triangles);
  constexpr double kBytesPerSegment = 90;  // measured, with few hits
  require_available(options.random.count, "random segments", kBytesPerSegment);
  return random_segments(asked.box(), options.random.count, options.random.seed);
}

/// The hull of a .phull file that an option needs.
const ProgressiveHull& hull_for(std::string_view option, const MeshOrHull& asked) {
  const auto* const hull = std::get_if<ProgressiveHull>(&asked);
  if (!hull) refuse(fmt::format("{} needs a .phull file to ask", option));
  return *hull;
}

/// Sets `conservative` to the side of the hull that is asked in place of the mesh.
QueryIndex make_index(AskedMesh& asked, const QueryOptions& options, std::optional<HullSide>& conservative) {
  if (!options.inner.empty()) {
    const ProgressiveHull inner = read_hull(options.inner);
    return asked.index([&](const MeshOrHull& mesh_or_hull) {
      return index_called(options.engine, hull_for("--inner", mesh_or_hull), inner);
    });
  }
  if (options.conservative)
    return asked.index([&](const MeshOrHull& mesh_or_hull) {
      const ProgressiveHull& hull = hull_for("--conservative", mesh_or_hull);
      conservative = hull.side();
      return index_called(options.engine, hull.base());
    });
  return asked.index(options.engine);
}

void say_conservative(HullSide side, const QueryIndex& index) {
  say("  asked of the {} hull alone, {}: of rays, and of segments with an end outside, {}\n",
      name_of(hull_side_names(), side), counted(index.face_count(), "face"),
      side == HullSide::Outer ? "none that hits the mesh is missed, but some may only come near it"
                              : "all that are hits hit the mesh too, but others may be missed");
}

bool counts_tests(std::string_view engine) { return engine.ends_with("refinement"); }

/// Triangles are decided by the walk's tree over the mesh.
bool may_miss(const QueryOptions& options) {
  return may_miss_hits(options.engine, !options.inner.empty()) &&
         (options.triangles.empty() || counts_tests(options.engine));
}

/// What has come of the queries, whatever their kind.
struct Outcome {
  std::string_view noun;
  std::size_t queries, answers, answered;  ///< hits or faces met; queries that have any
  QueryCounts counts;
  std::string_view engine;  ///< the name of the one that answered
  QuerySeconds seconds;

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

void print_summary(const QueryOptions& options, const Outcome& outcome) {
  const bool faces = outcome.noun == "triangle";
  const std::string out = options.out.empty() ? "" : output_name(options.out) + ": ";
  const bool one = outcome.answers == 1;
  say("{}{} {}; {} of {} {}s {} ({:.2f} %)\n", out, grouped(outcome.answers),
      faces ? (one ? "face met" : "faces met") : (one ? "hit" : "hits"), grouped(outcome.answered),
      grouped(outcome.queries), outcome.noun, faces ? "meet some" : "hit", 100 * outcome.per_query(outcome.answered));
  const unsigned threads = threads_used(options.threads);
  say("  engine {}, {} thread{}: {} {}s per second\n", outcome.engine, threads, threads == 1 ? "" : "s",
      grouped(static_cast<std::size_t>(outcome.per_second())), outcome.noun);
  if (counts_tests(options.engine))
    say("  {:.1f} faces tested and {:.1f} vertices split per {}\n", outcome.per_query(outcome.counts.tests),
        outcome.per_query(outcome.counts.splits), outcome.noun);
  if (may_miss(options))
    say("  {} may be missing: the engine {} does not find all of them; auto does\n", faces ? "faces met" : "hits",
        outcome.engine);
  outcome.seconds.say_them();
}

nlohmann::json report_of(const QueryOptions& options, const Outcome& outcome) {
  nlohmann::json json = {{"queries", outcome.queries},
                         {"kind", std::string(outcome.noun) + "s"},
                         {outcome.noun == "triangle" ? "faces_met" : "hits", outcome.answers},
                         {"queries_hit", outcome.answered},
                         {"queries_per_second", outcome.per_second()},
                         {"engine", outcome.engine},
                         {"threads", threads_used(options.threads)},
                         {"seconds", outcome.seconds.facts()}};
  if (outcome.noun != "triangle") json["mode"] = name_of(hit_mode_names(), options.mode);
  if (options.random.count > 0) json["seed"] = options.random.seed;
  json["may_miss_hits"] = may_miss(options);
  if (counts_tests(options.engine)) json["tests"] = outcome.counts.tests, json["splits"] = outcome.counts.splits;
  return json;
}

template <class Query>
Outcome answer(const QueryOptions& options, const QueryIndex& index, const std::vector<Query>& queries,
               QuerySeconds seconds, const std::string& suffix, Outputs& outputs) {
  Stopwatch asking;
  const auto batch = [&] {
    ProgressLine line;
    return ask(index, queries, options.mode, {.threads = options.threads, .progress = std::ref(line)});
  }();
  seconds.query = asking.seconds();
  Stopwatch writing;
  outputs.add(options.out, suffix, [&](const auto& file) { return write(file, batch, queries), true; });
  seconds.write = writing.seconds();
  return {noun(queries),       queries.size(), batch.offsets.back(), count_answered(batch.offsets), batch.counts,
          index.engine_name(), seconds};
}

int run_query(const QueryOptions& options) {
  const Suffixes suffixes = check_outputs(options);
  QuerySeconds seconds;
  Stopwatch reading;
  AskedMesh asked(options.in, options.input);
  const Queries queries = make_queries(options, asked);
  seconds.read = reading.seconds();
  stop_if_interrupted();

  Stopwatch indexing;
  std::optional<HullSide> conservative;
  const QueryIndex index = make_index(asked, options, conservative);
  seconds.index = indexing.seconds();
  stop_if_interrupted();
  Outputs outputs;
  const Outcome outcome =
      std::visit([&](const auto& q) { return answer(options, index, q, seconds, suffixes.out, outputs); }, queries);
  outputs.add(options.random.file, suffixes.segments,
              [&](const auto& file) { return write_segments(file, std::get<std::vector<Segment>>(queries)), true; });
  nlohmann::json json = report_of(options, outcome);
  json["input"] = asked.facts();
  if (conservative)
    json["conservative"] = {{"side", name_of(hull_side_names(), *conservative)}, {"faces", index.face_count()}};
  outputs.add_report(options.report, json);
  outputs.commit();
  asked.say_what();
  if (conservative) say_conservative(*conservative, index);
  options.random.say_what("segments");
  print_summary(options, outcome);
  say_more("  the index takes {} bytes\n", grouped(index.memory_bytes()));
  return kDone;
}

void add_queries(CLI::App& command, QueryOptions& options) {
  CLI::App& queries = *command.add_option_group(
      "Queries", "One of these is required. Files are .npy, .npz or .csv, and - is standard input");
  add_value(queries, "--segments", options.segments, "FILE", "File of segments, one a row: x0,y0,z0,x1,y1,z1.");
  add_value(queries, "--rays", options.rays, "FILE",
            "File of rays, one a row: the origin and the direction, x,y,z,dx,dy,dz.");
  CLI::Option* const triangles =
      add_value(queries, "--triangles", options.triangles, "FILE",
                "File of triangles, one a row: the three corners. They are answered by the faces that they meet.");
  add_random_queries(command, queries, options.random, "segments",
                     "Each goes from one side to another of a box twice as large as that of the mesh.");
  queries.require_option(1);
  add_choice(command, "--mode", options.mode, hit_mode_names(),
             "Hits to find of each segment or ray: the first one, any one (which is faster), or all.")
      ->excludes(triangles);
}

}  // namespace

void add_query(CLI::App& app, Run& run) {
  const auto [command, options] =
      add_command<QueryOptions>(app, run, "query",
                                "Finds where segments, rays or triangles meet a mesh, exactly. The mesh need "
                                "not be closed, and nothing slips through at its edges and vertices.",
                                run_query);
  add_mesh_input(command, options.in, options.input, "Mesh or .phull file to ask.");
  add_value(command, "-o,--out", options.out, "HITS",
            "File for the hits, .npz or .csv. With - they go to standard output. Without this option only the summary "
            "is printed.");
  add_out_format_option(command, options.out_format, kHits);
  add_queries(command, options);
  add_engine_option(command, options.engine, all_engine_names());
  CLI::Option* const inner = add_value(command, "--inner", options.inner, "INNER.phull",
                                       "Hierarchy of inner hulls of the same mesh, where IN is one of outer hulls. The "
                                       "engines walk and filter use both.");
  command
      .add_flag("--conservative", options.conservative,
                "Ask the coarsest hull of a .phull file in place of the mesh. An outer hull misses no hit, but may "
                "report hits that are none; an inner hull reports no hit that is none, but may miss hits. This holds "
                "for rays, and for segments with an end outside. Hits are on faces of that hull.")
      ->excludes(inner);
  add_threads_option(command, options.threads, "The answers are the same for any number.");
  add_report_option(command, options.report);
  add_examples(command,
               {"prohull query horse.ply --random 1e4", "prohull query horse.ply --segments segments.npy -o hits.npz",
                "prohull query scan.stl --rays rays.csv --mode all -o hits.csv --threads 4",
                "prohull query arm.obj --triangles tool.npy -o contacts.csv",
                "prohull query part.stl --rays - -o - --out-format csv <rays.csv",
                "prohull query horse.phull --random 1e4 --engine paper-refinement --report counts.json",
                "prohull query horse.phull --inner inside.phull --random 1e4 --mode all --engine walk"});
}

}  // namespace prohull::cli
