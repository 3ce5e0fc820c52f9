#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include "apart.h"
#include "command.h"
#include "cover_peers.h"
#include "machine.h"
#include "models.h"
#include "prohull/convex_cover.h"
#include "prohull/convex_hull.h"
#include "prohull/enclosing_hull.h"
#include "prohull/error.h"
#include "prohull/sphere_cover.h"
#include "prohull/union_verification.h"
#include "prohull/verification.h"
#include "table.h"

namespace prohull::bench {
namespace {

// How much more space than the mesh a few convex pieces take, or balls, and whether they cover it. As in peers.cpp,
// every row is measured and judged in a process of its own.

struct CoversOptions {
  ModelOptions models{.folder = {}, .samples = {"bracket", "knot", "pony"}, .sample_faces = 20000};
  std::vector<std::size_t> pieces{8, 16, 32, 64};
  std::size_t vertices = 64;
  std::size_t balls = 64;
  bool only_ours = false;
  unsigned limit_seconds = 600;  ///< of processor time, of each row
  std::filesystem::path out;
};

constexpr std::size_t kHullFaces = 2000;  ///< of our hull, which HACD takes in place of a mesh of more faces

/// What is known before the judgement.
struct Made {
  std::size_t count = 0;         ///< of pieces, or of balls
  std::size_t max_vertices = 0;  ///< of a piece
  double seconds = kUnknown;     ///< elapsed
};

struct CoverJudgement {
  double excess_percent = kUnknown;  ///< of the union's volume over that of the mesh
  bool covers = false;               ///< exact
  std::size_t faces_outside = 0;     ///< of the mesh, in part; exact
  std::size_t clearly_outside = 0;   ///< those of them that are outside by more than rounding explains
  double worst_percent = 0;          ///< how far a point of the mesh is outside, of the diagonal
  double reach_percent = kUnknown;   ///< how far the union reaches from the mesh, of the diagonal; an upper bound
};

struct CoverRow {
  std::string_view method;
  bool ours = false;
  std::size_t asked = 0;  ///< pieces, or balls; 0: could not be asked for
  std::optional<Made> made = {};
  std::optional<CoverJudgement> judgement = {};
  std::string failure = {};
};

double percent_of_diagonal(double length, const TriangleMesh& mesh) {
  return 100 * length / bounding_box(mesh).diagonal();
}

/// More than a millionth of the diagonal: HACD moves and scales what it is given, and back.
std::size_t clearly(const std::vector<Offender>& outside, const TriangleMesh& mesh) {
  constexpr double kPercent = 1e-4;
  return static_cast<std::size_t>(std::ranges::count_if(
      outside, [&](const Offender& o) { return percent_of_diagonal(o.distance, mesh) > kPercent; }));
}

/// Of what verify_hull or verify_union have found, with all offenders.
template <class Found>
CoverJudgement judgement_of(const Found& found, bool covers, double excess, double reach,
                            const TriangleMesh& original) {
  return {.excess_percent = 100 * excess,
          .covers = covers,
          .faces_outside = found.faces_outside,
          .clearly_outside = clearly(found.worst, original),
          .worst_percent = found.worst.empty() ? 0 : percent_of_diagonal(found.worst[0].distance, original),
          .reach_percent = percent_of_diagonal(reach, original)};
}

VerificationOptions all_offenders(const TriangleMesh& mesh) { return {.max_offenders = mesh.face_count()}; }

double excess(double volume, const TriangleMesh& original) { return volume / signed_volume(original) - 1; }

CoverJudgement judge(const std::vector<TriangleMesh>& pieces, const TriangleMesh& original) {
  const UnionVerification found = verify_union(pieces, original, all_offenders(original));
  return judgement_of(found, found.certified, excess(union_volume(pieces), original),
                      union_reach(pieces, original).upper, original);
}

CoverJudgement judge(const std::vector<Ball>& balls, const TriangleMesh& original, bool fill) {
  const UnionVerification found = verify_union(balls, original, fill, all_offenders(original));
  return judgement_of(found, found.certified, excess(union_volume(balls), original), union_reach(balls, original).upper,
                      original);
}

/// Of a hull, which is not convex.
CoverJudgement judge(const TriangleMesh& hull, const TriangleMesh& original) {
  const Verification found = verify_hull(hull, original, HullSide::Outer, all_offenders(original));
  return judgement_of(found, found.encloses, found.void_ratio, distance_bounds(hull, original).upper, original);
}

/// Where a process leaves what it has found. What has been told stays, whatever the process comes to.
class Result {
 public:
  void tell(const Made& made) const { put(made_.get(), made); }
  void tell(const CoverJudgement& judgement) const { put(judgement_.get(), judgement); }
  std::optional<Made> made() const { return get<Made>(made_.get()); }
  std::optional<CoverJudgement> judgement() const { return get<CoverJudgement>(judgement_.get()); }

 private:
  template <class T>
  static void put(std::FILE* file, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_bytes(file, &value, sizeof value);
  }
  template <class T>
  static std::optional<T> get(std::FILE* file) {
    T value;
    std::rewind(file);
    if (std::fread(&value, sizeof value, 1, file) != 1) return std::nullopt;
    return value;
  }

  File made_ = temporary_file(), judgement_ = temporary_file();
};

Made made_of(const std::vector<TriangleMesh>& pieces, double seconds) {
  Made made{.count = pieces.size(), .seconds = seconds};
  for (const TriangleMesh& piece : pieces) made.max_vertices = std::max(made.max_vertices, piece.vertex_count());
  return made;
}

void tell_pieces(const std::vector<TriangleMesh>& pieces, double seconds, const TriangleMesh& mesh,
                 const Result& result) {
  result.tell(made_of(pieces, seconds));
  result.tell(judge(pieces, mesh));
}

TriangleMesh coarse(const TriangleMesh& mesh) {
  return mesh.face_count() <= kHullFaces ? mesh : enclosing_hull(mesh, kHullFaces).mesh;
}

// Each makes a union of the mesh, and judges it.
using Method = std::function<void(const TriangleMesh& mesh, std::size_t asked, const Result& result)>;

void cover_by_pieces(const TriangleMesh& mesh, std::size_t pieces, std::size_t vertices, const Result& result) {
  ConvexCover cover;
  const double seconds =
      elapsed_seconds_of([&] { cover = convex_cover(mesh, {.max_pieces = pieces, .max_vertices = vertices}); });
  std::vector<TriangleMesh> meshes;
  for (ConvexPiece& piece : cover.pieces) meshes.push_back(std::move(piece.mesh));
  tell_pieces(meshes, seconds, mesh, result);
}

void decompose_by_hacd(const TriangleMesh& mesh, std::size_t pieces, std::size_t vertices, const Result& result) {
  const auto run = run_hacd(coarse(mesh), pieces, vertices);
  if (!run) throw std::runtime_error("not built");
  tell_pieces(run->pieces, run->seconds, mesh, result);
}

void cover_by_convex_hull(const TriangleMesh& mesh, const Result& result) {
  std::vector<TriangleMesh> pieces(1);
  const double seconds = elapsed_seconds_of([&] { pieces[0] = convex_hull(mesh); });
  tell_pieces(pieces, seconds, mesh, result);
}

void enclose_by_hull(const TriangleMesh& mesh, const Result& result) {
  TriangleMesh hull;
  const double seconds = elapsed_seconds_of([&] { hull = enclosing_hull(mesh, kHullFaces).mesh; });
  result.tell(made_of({hull}, seconds));
  result.tell(judge(hull, mesh));
}

void cover_by_balls(const TriangleMesh& mesh, std::size_t balls, bool fill, const Result& result) {
  SphereCover cover;
  const double seconds = elapsed_seconds_of([&] { cover = sphere_cover(mesh, {.max_balls = balls, .fill = fill}); });
  result.tell(Made{.count = cover.balls.size(), .max_vertices = 0, .seconds = seconds});
  result.tell(judge(cover.balls, mesh, fill));
}

struct CoverFacts {
  std::string name;
  std::size_t faces = 0;
  std::vector<CoverRow> pieces = {}, spheres = {};
};

class CoverBench {
 public:
  explicit CoverBench(const CoversOptions& options) : options_(options) {}

  CoverFacts measure(const ModelSource& source) {
    // Loaded in a process of its own, too: threads of this one would be missing in those that it starts.
    const File loaded = temporary_file();
    const Ended ended = run_apart([&] { put_mesh(loaded.get(), load(source)); });
    if (!ended.failure.empty()) throw std::runtime_error(ended.failure);
    const TriangleMesh mesh = get_mesh(loaded.get());
    fmt::print(stderr, "{}: {} faces\n", source.name, mesh.face_count());
    return {source.name, mesh.face_count(), pieces_rows(mesh), spheres_rows(mesh)};
  }

 private:
  std::vector<CoverRow> pieces_rows(const TriangleMesh& mesh) const {
    const std::size_t vertices = options_.vertices;
    const Method ours = [&](const TriangleMesh& m, std::size_t n, const Result& r) {
      cover_by_pieces(m, n, vertices, r);
    };
    const Method hacd = [&](const TriangleMesh& m, std::size_t n, const Result& r) {
      decompose_by_hacd(m, n, vertices, r);
    };
    std::vector<CoverRow> rows;
    for (const std::size_t pieces : options_.pieces) {
      rows.push_back(measured({.method = "prohull", .ours = true, .asked = pieces}, mesh, ours));
      if (!options_.only_ours) rows.push_back(measured({.method = "HACD", .asked = pieces}, mesh, hacd));
    }
    rows.push_back(measured({.method = "convex hull"}, mesh,
                            [](const TriangleMesh& m, std::size_t, const Result& r) { cover_by_convex_hull(m, r); }));
    rows.push_back(measured({.method = "prohull hull", .ours = true}, mesh,
                            [](const TriangleMesh& m, std::size_t, const Result& r) { enclose_by_hull(m, r); }));
    return rows;
  }

  std::vector<CoverRow> spheres_rows(const TriangleMesh& mesh) const {
    std::vector<CoverRow> rows;
    for (const bool fill : {false, true})
      rows.push_back(
          measured({.method = fill ? "solid" : "surface", .ours = true, .asked = options_.balls}, mesh,
                   [&](const TriangleMesh& m, std::size_t n, const Result& r) { cover_by_balls(m, n, fill, r); }));
    return rows;
  }

  CoverRow measured(CoverRow row, const TriangleMesh& mesh, const Method& method) const {
    const Result result;
    row.failure = run_apart([&] { method(mesh, row.asked, result); }, options_.limit_seconds).failure;
    row.made = result.made();
    row.judgement = result.judgement();
    fmt::print(stderr, "  {} {}: {}\n", row.method, row.asked, progress(row));
    return row;
  }

  static std::string progress(const CoverRow& row) {
    if (!row.judgement) return row.failure;
    return fmt::format("{} in {:.2f} s, excess {:.1f} %, {} faces outside", row.made->count, row.made->seconds,
                       row.judgement->excess_percent, row.judgement->faces_outside);
  }

  const CoversOptions& options_;
};

std::string asked(const CoverRow& row) { return row.asked > 0 ? fmt::to_string(row.asked) : ""; }
std::string verdict(const CoverRow& row) {
  if (!row.judgement) return as_cell(row.failure);
  return row.judgement->covers ? "yes" : "no";
}
std::string count(const CoverRow& row) { return row.made ? fmt::to_string(row.made->count) : ""; }
std::string vertices(const CoverRow& row) { return row.made ? fmt::to_string(row.made->max_vertices) : ""; }
std::string seconds(const CoverRow& row, int digits, std::string_view unit = "") {
  return row.made ? number(row.made->seconds, digits, unit) : "";
}
std::string outside(const CoverRow& row) { return row.judgement ? fmt::to_string(row.judgement->faces_outside) : ""; }
std::string clearly_outside_percent(const CoverRow& row, const CoverFacts& m, int digits, std::string_view unit = "") {
  if (!row.judgement) return "";
  return number(100 * static_cast<double>(row.judgement->clearly_outside) / static_cast<double>(m.faces), digits, unit);
}
std::string percent(const CoverRow& row, double CoverJudgement::*field, int digits, std::string_view unit = "") {
  return row.judgement ? number(*row.judgement.*field, digits, unit) : "";
}

std::string pieces_section(const CoverFacts& m) {
  Table table({"method", "asked", "pieces", "vertices", "excess", "faces clearly outside", "worst / diagonal",
               "reach / diagonal", "time", "covers"});
  for (const CoverRow& row : m.pieces)
    table.add({std::string(row.method), asked(row), count(row), vertices(row),
               percent(row, &CoverJudgement::excess_percent, 1, " %"), clearly_outside_percent(row, m, 2, " %"),
               percent(row, &CoverJudgement::worst_percent, 2, " %"),
               percent(row, &CoverJudgement::reach_percent, 1, " %"), seconds(row, 2, " s"), verdict(row)});
  return fmt::format("## {}: {} faces\n\n{}\n", m.name, m.faces, table.markdown());
}

std::string spheres_table(const std::vector<CoverFacts>& models) {
  Table table({"model", "covered", "asked", "spheres", "excess", "reach / diagonal", "time", "covers"});
  for (const CoverFacts& m : models)
    for (const CoverRow& row : m.spheres)
      table.add({m.name, std::string(row.method), asked(row), count(row),
                 percent(row, &CoverJudgement::excess_percent, 1, " %"),
                 percent(row, &CoverJudgement::reach_percent, 2, " %"), seconds(row, 2, " s"), verdict(row)});
  return "## Spheres\n\n" + table.markdown();
}

std::string pieces_csv(const std::vector<CoverFacts>& models) {
  Table table({"mesh", "faces", "method", "asked_pieces", "pieces", "max_vertices", "excess_percent", "faces_outside",
               "faces_clearly_outside_percent", "worst_percent", "reach_percent", "seconds", "covers"});
  for (const CoverFacts& m : models)
    for (const CoverRow& row : m.pieces)
      table.add({m.name, fmt::to_string(m.faces), std::string(row.method), asked(row), count(row), vertices(row),
                 percent(row, &CoverJudgement::excess_percent, 3), outside(row), clearly_outside_percent(row, m, 3),
                 percent(row, &CoverJudgement::worst_percent, 3), percent(row, &CoverJudgement::reach_percent, 3),
                 seconds(row, 3), verdict(row)});
  return table.csv();
}

std::string spheres_csv(const std::vector<CoverFacts>& models) {
  Table table(
      {"mesh", "faces", "covered", "asked_spheres", "spheres", "excess_percent", "reach_percent", "seconds", "covers"});
  for (const CoverFacts& m : models)
    for (const CoverRow& row : m.spheres)
      table.add({m.name, fmt::to_string(m.faces), std::string(row.method), asked(row), count(row),
                 percent(row, &CoverJudgement::excess_percent, 3), percent(row, &CoverJudgement::reach_percent, 3),
                 seconds(row, 3), verdict(row)});
  return table.csv();
}

bool keeps_its_word(const CoverRow& row) { return !row.ours || (row.judgement && row.judgement->covers); }

int run_covers(CoversOptions options) {
  std::ranges::sort(options.pieces);
  CoverBench bench(options);
  std::vector<CoverFacts> models;
  const std::vector<Refused> refused =
      measure_each(options.models, [&](const ModelSource& source) { models.push_back(bench.measure(source)); });
  std::string text = fmt::format("# Covers\n\n{}\n\n", machine());
  for (const CoverFacts& m : models) text += pieces_section(m);
  publish(options.out, "covers", text + listed(refused), pieces_csv(models));
  publish(options.out, "sphere_covers", spheres_table(models), spheres_csv(models));
  const bool all_kept = std::ranges::all_of(models, [](const CoverFacts& m) {
    return std::ranges::all_of(m.pieces, keeps_its_word) && std::ranges::all_of(m.spheres, keeps_its_word);
  });
  return all_kept ? kDone : kAnswerIsNo;
}

}  // namespace

void add_covers(CLI::App& app, Run& run) {
  const auto options = std::make_shared<CoversOptions>();
  CLI::App& command = *app.add_subcommand(
      "covers", "Convex pieces and spheres, beside HACD and hulls: excess, what is left outside, distance, time");
  add_model_options(command, options->models);
  command.add_option("--pieces", options->pieces, "Numbers of convex pieces")
      ->delimiter(',')
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command.add_option("--vertices", options->vertices, "Largest number of vertices of a piece")
      ->check(CLI::Range(4, 100000))
      ->capture_default_str();
  command.add_option("--spheres", options->balls, "Number of spheres")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command.add_flag("--ours", options->only_ours, "Leave HACD out");
  command.add_option("--time-limit", options->limit_seconds, "Processor time for one row")
      ->check(CLI::Range(1, 1000000))
      ->type_name("SECONDS")
      ->capture_default_str();
  add_out_option(command, options->out, "covers and sphere_covers");
  command.callback([options, &run] { run = [options] { return run_covers(*options); }; });
}

}  // namespace prohull::bench
