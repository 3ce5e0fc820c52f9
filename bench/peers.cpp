#include "peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string_view>
#include <type_traits>

#include "apart.h"
#include "command.h"
#include "figure.h"
#include "machine.h"
#include "models.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "prohull/tight_hull.h"
#include "strategies.h"
#include "table.h"

namespace prohull::bench {
namespace {

// Every method and every judgement has a process of its own: some peers hang or crash on some models. What a process
// that does nothing has is subtracted from the peak of its resident memory; the mesh and the result count.

struct PeersOptions {
  ModelOptions models{.folder = {}, .samples = {"asteroid", "bracket", "pony"}, .sample_faces = 20000};
  std::vector<std::size_t> hull_faces{2000, 500, 200};  ///< descending
  bool only_ours = false;
  unsigned limit_seconds = 120;  ///< of processor time, of each process
  std::filesystem::path out;
};

std::optional<PeerRun> run_tight(const TriangleMesh& mesh, std::size_t faces) {
  PeerRun run{};
  run.seconds = seconds_of([&] { run.mesh = build_tight_hull(mesh, hull_options(Strategy::Lazy, faces)).mesh; });
  return run;
}

std::optional<PeerRun> run_progressive(const TriangleMesh& mesh, std::size_t faces) {
  PeerRun run{};
  run.seconds = seconds_of([&] { run.mesh = build_hull(mesh, hull_options(Strategy::Lazy, faces)).hull.base(); });
  return run;
}

struct Method {
  std::string_view name;
  std::optional<PeerRun> (*run)(const TriangleMesh&, std::size_t faces);
  bool ours = false;
};

constexpr std::array kMethods{
    Method{"prohull tight", run_tight, true},          Method{"prohull progressive", run_progressive, true},
    Method{"CGAL alpha wrap", run_alpha_wrap},         Method{"CGAL Garland-Heckbert", run_garland_heckbert},
    Method{"CGAL Lindstrom-Turk", run_lindstrom_turk}, Method{"OpenMesh quadrics", run_openmesh},
    Method{"meshoptimizer", run_meshoptimizer},
};
constexpr Method kConvexHull{"CGAL convex hull",
                             [](const TriangleMesh& mesh, std::size_t) { return run_convex_hull(mesh); }};

/// Of a hull against its original.
struct Judgement {
  double void_percent = kUnknown;
  bool encloses = false;
  std::size_t faces_outside = 0;  ///< of the original, in part
  std::optional<ExactFacts> facts;
};

Judgement judge(const TriangleMesh& original, const TriangleMesh& hull) {
  const EnclosureReport report = verify_enclosure(original, hull, {.max_offenders = 0});
  return {void_percent(hull, signed_volume(original)), report.encloses, report.faces_outside,
          exact_facts(original, hull)};
}

struct PeerRow {
  std::string_view method;
  bool ours = false;
  std::size_t asked_faces = 0;  ///< 0: could not be asked for
  std::size_t faces = 0;
  double seconds = kUnknown, peak_bytes = kUnknown;
  std::string failure = {};                 ///< why there is no mesh
  std::optional<Judgement> judgement = {};  ///< nothing if there is no mesh, or if it could not be judged
  std::string not_judged = {};              ///< why
};

struct PeerFacts {
  std::string name;
  std::size_t vertices = 0, faces = 0, self_intersections = 0;
  std::vector<PeerRow> rows;
};

class PeerBench {
 public:
  explicit PeerBench(const PeersOptions& options) : options_(options), nothing_(run_apart([] {}).peak_bytes) {}

  PeerFacts measure(const ModelSource& source) const {
    const File original = temporary_file(), count = temporary_file();
    const Ended loaded = run_apart([&] {
      const TriangleMesh mesh = load(source);
      put_mesh(original.get(), mesh);
      put_value(count.get(), count_self_intersections(mesh));
    });
    if (!loaded.failure.empty()) throw std::runtime_error(loaded.failure);
    const MeshSize size = get_mesh_size(original.get());
    fmt::print(stderr, "{}: {} faces", source.name, size.faces);
    PeerFacts facts{source.name, size.vertices, size.faces, get_value<std::size_t>(count.get()), {}};
    for (const std::size_t faces : options_.hull_faces)
      for (const Method& method : kMethods)
        if (method.ours || !options_.only_ours) facts.rows.push_back(measure(original.get(), method, faces));
    if (!options_.only_ours) facts.rows.push_back(measure(original.get(), kConvexHull, 0));
    fmt::print(stderr, "\n");
    return facts;
  }

 private:
  template <class T>
  static void put_value(std::FILE* file, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::rewind(file);
    put_bytes(file, &value, sizeof value);
  }

  template <class T>
  static T get_value(std::FILE* file) {
    T value;
    std::rewind(file);
    get_bytes(file, &value, sizeof value);
    return value;
  }

  PeerRow measure(std::FILE* original, const Method& method, std::size_t faces) const {
    PeerRow row{.method = method.name, .ours = method.ours, .asked_faces = faces};
    const File seconds = temporary_file(), hull = temporary_file();
    const Ended made = run_apart(
        [&] {
          const auto run = method.run(get_mesh(original), faces);
          if (!run) throw std::runtime_error("not built");
          put_value(seconds.get(), run->seconds);
          put_mesh(hull.get(), run->mesh);
        },
        options_.limit_seconds);
    row.failure = made.failure;
    if (row.failure.empty()) {
      row.faces = get_mesh_size(hull.get()).faces;
      row.seconds = get_value<double>(seconds.get());
      row.peak_bytes = static_cast<double>(made.peak_bytes - nothing_);
      judge_apart(original, hull.get(), row);
    }
    fmt::print(stderr, "\n  {}{}: {}", row.method, faces > 0 ? fmt::format(" {}", faces) : "", progress(row));
    return row;
  }

  void judge_apart(std::FILE* original, std::FILE* hull, PeerRow& row) const {
    const File verdict = temporary_file();
    const Ended judged =
        run_apart([&] { put_value(verdict.get(), judge(get_mesh(original), get_mesh(hull))); }, options_.limit_seconds);
    row.not_judged = judged.failure;
    if (row.not_judged.empty()) row.judgement = get_value<Judgement>(verdict.get());
  }

  static std::string progress(const PeerRow& row) {
    if (!row.failure.empty()) return row.failure;
    return fmt::format("{} faces, {:.3f} s, {}", row.faces, row.seconds,
                       !row.judgement            ? row.not_judged
                       : row.judgement->encloses ? "encloses"
                                                 : "does not enclose");
  }

  const PeersOptions& options_;
  std::size_t nothing_;
};

std::string verdict(const PeerRow& row) {
  if (!row.failure.empty()) return as_cell(row.failure);
  if (!row.judgement) return as_cell("not decided: " + row.not_judged);
  return row.judgement->encloses ? "yes" : fmt::format("no: {} faces stick out", row.judgement->faces_outside);
}

std::string asked(const PeerRow& row) { return row.asked_faces > 0 ? fmt::to_string(row.asked_faces) : ""; }

/// What `value` makes of the facts of CGAL; empty if there are none.
template <class Value>
std::string fact(const PeerRow& row, Value&& value) {
  return row.judgement && row.judgement->facts ? fmt::format("{}", value(*row.judgement->facts)) : "";
}

std::string vertices_outside(const PeerRow& row) {
  return fact(row, [](const ExactFacts& f) { return f.vertices_outside; });
}

std::string self_intersections(const PeerRow& row) {
  return fact(row, [](const ExactFacts& f) { return f.self_intersections; });
}

std::string surfaces_meet(const PeerRow& row) {
  return fact(row, [](const ExactFacts& f) { return f.surfaces_meet ? "yes" : "no"; });
}

std::string section(const PeerFacts& m) {
  Table table({"method", "asked", "faces", "void", "time", "memory", "vertices outside", "self-intersections",
               "surfaces meet", "encloses"});
  constexpr double kMegabyte = 1e6;
  for (const PeerRow& row : m.rows)
    table.add({std::string(row.method), asked(row), row.failure.empty() ? fmt::to_string(row.faces) : "",
               number(row.judgement ? row.judgement->void_percent : kUnknown, 2, " %"), number(row.seconds, 3, " s"),
               number(row.peak_bytes / kMegabyte, 1, " MB"), vertices_outside(row), self_intersections(row),
               surfaces_meet(row), verdict(row)});
  return fmt::format("## {}: {} faces, {} vertices, {} self-intersections\n\n{}\n", m.name, m.faces, m.vertices,
                     m.self_intersections, table.markdown());
}

std::string csv(const std::vector<PeerFacts>& models) {
  Table table({"mesh", "mesh_faces", "mesh_vertices", "mesh_self_intersections", "method", "asked_faces", "hull_faces",
               "void_percent", "seconds", "peak_bytes", "vertices_outside", "self_intersections", "surfaces_meet",
               "encloses"});
  for (const PeerFacts& m : models)
    for (const PeerRow& row : m.rows)
      table.add({m.name, fmt::to_string(m.faces), fmt::to_string(m.vertices), fmt::to_string(m.self_intersections),
                 std::string(row.method), asked(row), row.failure.empty() ? fmt::to_string(row.faces) : "",
                 number(row.judgement ? row.judgement->void_percent : kUnknown, 4), number(row.seconds, 4),
                 number(row.peak_bytes, 0), vertices_outside(row), self_intersections(row), surfaces_meet(row),
                 verdict(row)});
  return table.csv();
}

/// Enclosing, with no more self-intersections than the original.
bool keeps_its_word(const PeerRow& row, const PeerFacts& m) {
  if (!row.judgement || !row.judgement->encloses) return false;
  return !row.judgement->facts || row.judgement->facts->self_intersections <= m.self_intersections;
}

int run_peers(PeersOptions options) {
  std::ranges::sort(options.hull_faces, std::greater());
  const PeerBench bench(options);
  std::vector<PeerFacts> models;
  const std::vector<Refused> refused =
      measure_each(options.models, [&](const ModelSource& source) { models.push_back(bench.measure(source)); });
  std::string text = fmt::format("# Peers\n\n{}\n\n", machine());
  for (const PeerFacts& m : models) text += section(m);
  text += listed(refused);
  publish(options.out, "peers", text, csv(models));
  if (!options.out.empty()) draw_figure(options.out / "peers.csv");
  const bool all_kept = std::ranges::all_of(models, [](const PeerFacts& m) {
    return std::ranges::all_of(m.rows, [&](const PeerRow& row) { return !row.ours || keeps_its_word(row, m); });
  });
  return all_kept ? kDone : kAnswerIsNo;
}

}  // namespace

void add_peers(CLI::App& app, Run& run) {
  const auto options = std::make_shared<PeersOptions>();
  CLI::App& command =
      *app.add_subcommand("peers", "Hulls and simplifications of others beside ours: void, time, memory, enclosure");
  add_model_options(command, options->models);
  add_faces_option(command, options->hull_faces);
  command.add_flag("--ours", options->only_ours, "Measure only our methods");
  command.add_option("--time-limit", options->limit_seconds, "Processor time for one row, and for judging it")
      ->check(CLI::Range(1, 1000000))
      ->type_name("SECONDS")
      ->capture_default_str();
  add_out_option(command, options->out, "peers.md, peers.csv and a figure of void by faces");
  command.callback([options, &run] { run = [options] { return run_peers(*options); }; });
}

}  // namespace prohull::bench
