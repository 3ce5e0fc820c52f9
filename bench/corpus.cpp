#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <future>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <string_view>

#include "command.h"
#include "defects/defects.h"
#include "io/file.h"
#include "machine.h"
#include "models.h"
#include "program.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "references.h"
#include "table.h"

namespace prohull::bench {
namespace {

// Does every mesh file come out as a certified hull or as one clear refusal? As a user would run it: the program, in a
// process and a folder of its own for each file.

constexpr std::size_t kAddressBytes = std::size_t{4} << 30;

struct CorpusOptions {
  std::vector<std::filesystem::path> folders;
  std::size_t hull_faces = 500;
  unsigned jobs = 1, limit_seconds = 60;
  std::filesystem::path out, references;
};

enum class Verdict { Ok, Repaired, Refused, Failed };
constexpr std::array<std::string_view, 4> kVerdicts{"ok", "repaired", "refused", "FAILED"};
constexpr std::string_view name(Verdict verdict) { return kVerdicts[static_cast<std::size_t>(verdict)]; }

struct MeshFile {
  std::string name;
  std::filesystem::path path;
};

struct CorpusRow {
  std::string name;
  Verdict verdict = Verdict::Ok;
  std::string why = {};  ///< how it was repaired, why it was refused, or what failed
  std::optional<std::size_t> faces_in = {}, faces_out = {};
  std::string candidate = {};           ///< what the hull was built from: "mesh", "convex-hull", "wrap 1/50"
  double by_convex = kUnknown;          ///< volume of the hull / that of the convex hull
  double by_sealed = kUnknown;          ///< volume of the hull / Reference::volume
  double distance = kUnknown;           ///< proven bound of how far the hull is from the triangles / diagonal
  double void_ratio = kUnknown;         ///< as EnclosingHull::void_ratio; where the hull with --repair none is known
  double direct_void_ratio = kUnknown;  ///< the same of that hull
  double build_seconds = kUnknown, verify_seconds = kUnknown;
  std::size_t peak_bytes = 0;  ///< of both programs
};

/// Vanishes with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_(std::filesystem::temp_directory_path() / "prohull-bench-XXXXXX") {
    std::string name = path_.string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder can be made");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::vector<MeshFile> mesh_files(const std::vector<std::filesystem::path>& folders) {
  std::vector<MeshFile> files;
  for (const auto& folder : folders) {
    const std::filesystem::path root = canonical(folder);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
      if (entry.is_regular_file() && is_named_like_a_mesh(entry.path()))
        files.push_back({entry.path().lexically_relative(root.parent_path()).string(), entry.path()});
  }
  std::ranges::sort(files, {}, &MeshFile::path);
  return files;
}

std::vector<MeshFile> write_defects(const std::filesystem::path& folder) {
  std::filesystem::create_directory(folder);
  std::vector<MeshFile> files;
  for (const auto& [name, content] : meshes::defective_files()) {
    write_file(folder / name, content);
    files.push_back({name, folder / name});
  }
  return files;
}

std::string replaced(std::string text, const std::string& what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

/// What the program says on stderr, without its name, that of the file and that of its folder.
std::string said(const ProgramEnd& end, const MeshFile& file) {
  if (end.err.empty()) return "nothing on stderr";
  const std::string named = replaced(end.err.front(), "prohull: ", "");
  return replaced(replaced(named, file.path.string() + ": ", ""), file.path.parent_path().string() + "/", "");
}

std::string files_of(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::ranges::sort(names);
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : " ") + name;
  return all;
}

/// Of a build that leaves its files in `folder`; empty if it behaved as documented.
std::string misbehaviour(const ProgramEnd& built, const MeshFile& file, const std::filesystem::path& folder) {
  if (!built.failure.empty()) return built.failure;
  const bool refused = built.exit_code == kBadInput;
  if (built.exit_code != kDone && !refused) return fmt::format("exit code {}: {}", built.exit_code, said(built, file));
  const std::string left = files_of(folder);
  if (left != (refused ? "" : "hull.stl report.json"))
    return fmt::format("exit code {} leaves {}", built.exit_code, left.empty() ? "nothing" : left);
  if (refused && built.err.size() != 1) return fmt::format("a refusal of {} lines", built.err.size());
  return "";
}

std::string candidate_of(const nlohmann::json& hull, double diagonal) {
  const auto source = hull.at("source").get<std::string>();
  const nlohmann::json& spacing = hull.at("wrap_spacing");
  return spacing.is_null() ? source : fmt::format("{} 1/{:.0f}", source, diagonal / spacing.get<double>());
}

/// The upper bound.
double distance_of(const nlohmann::json& verdict) {
  const nlohmann::json& solid = verdict.at("distance_to_solid");
  return (solid.is_null() ? verdict.at("distance_to_triangles") : solid).at("upper").get<double>();
}

/// Says what the report of a build tells.
void add_report(const nlohmann::json& report, const TriangleMesh& mesh, CorpusRow& row) {
  const nlohmann::json &input = report.at("input"), &hull = report.at("hull");
  row.faces_in = input.at("faces").get<std::size_t>();
  row.faces_out = hull.at("faces").get<std::size_t>();
  const double diagonal = bounding_box(mesh).diagonal();
  row.candidate = candidate_of(hull, diagonal);
  row.by_convex = hull.at("volume").get<double>() / convex_volume(mesh);
  row.distance = distance_of(hull.at("verdict")) / diagonal;
  const std::string repair = input.value("repair", "none");
  if (repair == "wrap") row.why = repair;
  for (const auto& phrase : input.at("repairs").get<std::vector<std::string>>())
    row.why += (row.why.empty() ? "" : " + ") + phrase;
  row.verdict = repair == "none" && row.why.empty() ? Verdict::Ok : Verdict::Repaired;
}

/// Of a closed mesh with a few self-intersections, the direct hull is what all others are compared with.
void add_direct(const nlohmann::json& report, std::vector<std::string> build, const std::filesystem::path& report_file,
                const ProgramLimits& limits, CorpusRow& row) {
  constexpr std::size_t kMostPairs = 100;
  const auto pairs = report.at("input").at("self_intersections").get<std::size_t>();
  if (pairs == 0 || pairs > kMostPairs) return;
  build.insert(build.end(), {"--repair", "none"});
  const ProgramEnd built = run_program(std::move(build), limits);
  if (!built.failure.empty() || built.exit_code != kDone) return;  // as of meshes that are not closed
  const nlohmann::json direct = nlohmann::json::parse(read_file(report_file)).at("hull");
  row.direct_void_ratio = direct.at("void_ratio").get<double>();
  const double volume = direct.at("volume").get<double>() / (1 + row.direct_void_ratio);
  row.void_ratio = report.at("hull").at("volume").get<double>() / volume - 1;
}

CorpusRow swept(const MeshFile& file, const CorpusOptions& options, References* references,
                const std::filesystem::path& folder) {
  std::filesystem::create_directory(folder);
  const std::string hull = folder / "hull.stl", report = folder / "report.json";
  const ProgramLimits limits{options.limit_seconds, kAddressBytes};
  CorpusRow row{.name = file.name};
  const auto failed = [&row](const char* step, const std::string& why) {
    row.verdict = Verdict::Failed;
    row.why = fmt::format("{}: {}", step, why);
    return row;
  };

  const std::vector<std::string> build{
      PROHULL_PROGRAM, "build", file.path, "--faces", fmt::to_string(options.hull_faces), "-o", hull,
      "--report",      report};
  const ProgramEnd built = run_program(build, limits);
  row.build_seconds = built.seconds;
  row.peak_bytes = built.peak_bytes;
  if (const std::string wrong = misbehaviour(built, file, folder); !wrong.empty()) return failed("build", wrong);
  if (built.exit_code == kBadInput) {
    row.verdict = Verdict::Refused;
    row.why = said(built, file);
    return row;
  }
  nlohmann::json told;
  try {
    told = nlohmann::json::parse(read_file(report));
    const TriangleMesh mesh = finite_part(read_mesh(file.path, {.non_finite = NonFinite::Keep}));
    add_report(told, mesh, row);
    if (references) row.by_sealed = told.at("hull").at("volume").get<double>() / references->of(file.name, mesh).volume;
  } catch (const nlohmann::json::exception& error) {
    return failed("report", error.what());
  }

  const ProgramEnd verified = run_program({PROHULL_PROGRAM, "verify", hull, file.path, "--finite-only"}, limits);
  row.verify_seconds = verified.seconds;
  row.peak_bytes = std::max(row.peak_bytes, verified.peak_bytes);
  if (!verified.failure.empty()) return failed("verify", verified.failure);
  if (verified.exit_code == kAnswerIsNo) return failed("verify", "no");
  if (verified.exit_code != kDone)
    return failed("verify", fmt::format("exit code {}: {}", verified.exit_code, said(verified, file)));
  add_direct(told, build, report, limits, row);
  return row;
}

std::vector<CorpusRow> sweep(const std::vector<MeshFile>& files, const CorpusOptions& options,
                             const std::filesystem::path& folder) {
  std::optional<References> references;
  if (!options.references.empty()) references.emplace(options.references);
  std::vector<CorpusRow> rows(files.size());
  std::atomic<std::size_t> next = 0;
  std::vector<std::future<void>> workers;
  for (unsigned job = 0; job < options.jobs; ++job)
    workers.push_back(std::async(std::launch::async, [&] {
      for (std::size_t i = next++; i < files.size(); i = next++) {
        const std::filesystem::path own = folder / fmt::to_string(i);
        rows[i] = swept(files[i], options, references ? &*references : nullptr, own);
        std::filesystem::remove_all(own);
        fmt::print(stderr, "{}: {} {}\n", rows[i].name, name(rows[i].verdict), rows[i].why);
      }
    }));
  for (auto& worker : workers) worker.get();
  return rows;
}

std::size_t count(const std::vector<CorpusRow>& rows, Verdict verdict) {
  return static_cast<std::size_t>(std::ranges::count(rows, verdict, &CorpusRow::verdict));
}

/// Median and worst of what is known of a column, over the files of which it is known.
class Figures {
 public:
  template <class Value>
  void add(const std::string& what, int digits, const std::vector<CorpusRow>& rows, Value value) {
    std::vector<std::pair<double, const CorpusRow*>> known;
    for (const CorpusRow& row : rows)
      if (const double v = value(row); std::isfinite(v)) known.push_back({v, &row});
    if (known.empty()) return;
    std::ranges::sort(known, {}, [](const auto& entry) { return entry.first; });
    table_.add({what, fmt::to_string(known.size()), number(known[known.size() / 2].first, digits),
                number(known.back().first, digits), as_cell(known.back().second->name)});
  }
  std::string markdown() const { return table_.empty() ? "" : table_.markdown() + "\n"; }

 private:
  Table table_{{"of a hull", "files", "median", "worst", "worst file"}};
};

std::string figures(const std::vector<CorpusRow>& rows) {
  Figures figures;
  figures.add("volume / sealed reference", 3, rows, [](const CorpusRow& row) { return row.by_sealed; });
  figures.add("volume / convex hull", 3, rows, [](const CorpusRow& row) { return row.by_convex; });
  figures.add("distance / diagonal", 4, rows, [](const CorpusRow& row) { return row.distance; });
  // Below that, as of boxes, the ratio is one of rounding errors.
  constexpr double kLeastVoid = 1e-4;
  figures.add("void / void of the direct hull (of at least 0.01 %)", 2, rows, [](const CorpusRow& row) {
    return row.direct_void_ratio >= kLeastVoid ? row.void_ratio / row.direct_void_ratio : kUnknown;
  });
  figures.add("seconds of a build, reading and certifying included", 2, rows,
              [](const CorpusRow& row) { return row.faces_out ? row.build_seconds : kUnknown; });
  return figures.markdown();
}

/// A hull that has less than half of the volume of the sealed reference is a sheet around the surface.
std::string hollow_hulls(const std::vector<CorpusRow>& rows) {
  constexpr double kHollow = 0.5;
  if (std::ranges::none_of(rows, [](const CorpusRow& row) { return std::isfinite(row.by_sealed); })) return "";
  const auto hollow = std::ranges::count_if(rows, [](const CorpusRow& row) { return row.by_sealed < kHollow; });
  return fmt::format("Hollow hulls, of less than half of the volume of the sealed reference: {}\n\n", hollow);
}

/// Without numbers, what is in parentheses, and the advice after a semicolon.
std::string kind_of(const std::string& why) {
  static const std::regex detail(" ?\\([^)]*\\)|;.*"), number("[0-9]+([.,][0-9]+)*");
  return std::regex_replace(std::regex_replace(why, detail, ""), number, "#");
}

/// Why files have the verdict, by kind, the most frequent first.
std::string reasons(const std::vector<CorpusRow>& rows, Verdict verdict) {
  struct Group {
    std::string why, example;
    std::size_t files = 0;
  };
  std::map<std::string, Group> by_reason;
  for (const CorpusRow& row : rows)
    if (row.verdict == verdict) {
      const std::string why = kind_of(row.why);
      Group& group = by_reason.try_emplace(why, Group{why, row.name}).first->second;
      ++group.files;
    }
  if (by_reason.empty()) return "";
  std::vector<Group> groups;
  for (const auto& [why, group] : by_reason) groups.push_back(group);
  std::ranges::stable_sort(groups, std::greater(), &Group::files);
  Table table({fmt::format("{}: why", name(verdict)), "files", "such as"});
  for (const Group& group : groups)
    table.add({as_cell(group.why), fmt::to_string(group.files), as_cell(group.example)});
  return table.markdown() + "\n";
}

std::string faces(const std::optional<std::size_t>& count) { return count ? fmt::to_string(*count) : ""; }

std::string listed(const std::vector<CorpusRow>& rows) {
  Table table({"file", "verdict", "why", "candidate", "faces", "hull", "volume / convex", "volume / sealed",
               "distance / diagonal", "void", "direct void", "build", "verify", "memory"});
  constexpr double kMegabyte = 1e6;
  for (const CorpusRow& row : rows)
    table.add({as_cell(row.name), std::string(name(row.verdict)), as_cell(row.why), as_cell(row.candidate),
               faces(row.faces_in), faces(row.faces_out), number(row.by_convex, 3), number(row.by_sealed, 3),
               number(row.distance, 4), number(100 * row.void_ratio, 2, " %"),
               number(100 * row.direct_void_ratio, 2, " %"), number(row.build_seconds, 2, " s"),
               number(row.verify_seconds, 2, " s"), number(static_cast<double>(row.peak_bytes) / kMegabyte, 1, " MB")});
  return table.markdown();
}

std::string csv(const std::vector<CorpusRow>& rows) {
  Table table({"file", "verdict", "why", "candidate", "faces", "hull_faces", "volume_by_convex", "volume_by_sealed",
               "distance_by_diagonal", "void_percent", "direct_void_percent", "build_seconds", "verify_seconds",
               "peak_bytes"});
  for (const CorpusRow& row : rows)
    table.add({as_cell(row.name), std::string(name(row.verdict)), as_cell(row.why), as_cell(row.candidate),
               faces(row.faces_in), faces(row.faces_out), number(row.by_convex, 4), number(row.by_sealed, 4),
               number(row.distance, 5), number(100 * row.void_ratio, 3), number(100 * row.direct_void_ratio, 3),
               number(row.build_seconds, 3), number(row.verify_seconds, 3), fmt::to_string(row.peak_bytes)});
  return table.csv();
}

int run_corpus(const CorpusOptions& options) {
  const TemporaryFolder folder;
  const std::vector<MeshFile> files =
      options.folders.empty() ? write_defects(folder.path() / "defects") : mesh_files(options.folders);
  if (files.empty()) throw InputError(Defect::CannotRead, "no file of these folders is a mesh by its name");
  const std::vector<CorpusRow> rows = sweep(files, options, folder.path());

  std::string text = fmt::format("# Corpus: certified hulls of {} faces, or one clear refusal\n\n{}\n\n{} files",
                                 options.hull_faces, machine(), rows.size());
  for (const Verdict verdict : {Verdict::Ok, Verdict::Repaired, Verdict::Refused, Verdict::Failed})
    text += fmt::format(", {} {}", count(rows, verdict), name(verdict));
  text += ".\n\n" + figures(rows) + hollow_hulls(rows);
  for (const Verdict verdict : {Verdict::Failed, Verdict::Repaired, Verdict::Refused}) text += reasons(rows, verdict);
  publish(options.out, "corpus", text + listed(rows), csv(rows));
  return count(rows, Verdict::Failed) == 0 ? kDone : kAnswerIsNo;
}

}  // namespace

void add_corpus(CLI::App& app, Run& run) {
  const auto options = std::make_shared<CorpusOptions>();
  CLI::App& command = *app.add_subcommand(
      "corpus",
      "Builds and verifies every mesh file of folders, each in a process of its own; exits with 1 if one fails");
  command
      .add_option("--dir", options->folders,
                  "With all folders in it; repeatable. Without, small files with one defect each are made")
      ->check(CLI::ExistingDirectory)
      ->type_name("DIR");
  add_faces_option(command, options->hull_faces);
  command.add_option("--jobs", options->jobs, "Files at a time")->check(CLI::Range(1, 1024))->capture_default_str();
  command.add_option("--timeout", options->limit_seconds, "For building a hull, and for verifying it")
      ->check(CLI::Range(1, 1000000))
      ->type_name("SECONDS")
      ->capture_default_str();
  command
      .add_option("--references", options->references,
                  "Also compare volumes with sealed references. They take long, and are kept in this CSV file")
      ->type_name("FILE");
  add_out_option(command, options->out, "corpus.md and corpus.csv");
  command.callback([options, &run] { run = [options] { return run_corpus(*options); }; });
}

}  // namespace prohull::bench
