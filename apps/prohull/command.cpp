#include "command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "prohull/error.h"
#include "prohull/file.h"
#include "prohull/hull_file.h"
#include "prohull/mesh_io.h"

namespace prohull::cli {
namespace {

volatile std::sig_atomic_t g_interrupted = 0;

// A pipe, as /dev/stdin may be, has no canonical name.
std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path canonical = weakly_canonical(path, error);
  return error ? path : canonical;
}

}  // namespace

void catch_interrupts() {
  const auto remember = [](int) { g_interrupted = 1; };
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

bool interrupted() { return g_interrupted != 0; }

ProgressLine::ProgressLine(std::string label) : label_(std::move(label)), shown_(false) {}

ProgressLine::~ProgressLine() {
  if (shown_) fmt::print(stderr, "\r\x1b[K");
}

bool ProgressLine::operator()(double fraction) {
  constexpr std::chrono::milliseconds kInterval(100);
  const auto now = std::chrono::steady_clock::now();
  if (isatty(STDERR_FILENO) && now - drawn_ >= kInterval) {
    constexpr int kWidth = 30;
    const int filled = static_cast<int>(kWidth * std::clamp(fraction, 0.0, 1.0));
    fmt::print(stderr, "\r{:<8} [{:=<{}}{: <{}}] {:3.0f} %", label_, "", filled, "", kWidth - filled, 100 * fraction);
    std::fflush(stderr);
    shown_ = true;
    drawn_ = now;
  }
  return !interrupted();
}

TriangleMesh read_input(const std::filesystem::path& path, NonFinite non_finite) {
  return read_mesh(path,
                   {.non_finite = non_finite, .progress = [](std::string_view, double) { return !interrupted(); }});
}

Input read_closed_mesh(const std::filesystem::path& path) {
  Stopwatch reading;
  TriangleMesh mesh = read_input(path);
  const double read_seconds = reading.seconds();
  if (interrupted()) throw Interrupted{};
  Stopwatch repairing;
  try {
    ClosedMesh closed = closed_mesh(std::move(mesh));
    return {std::move(closed), read_seconds, repairing.seconds()};
  } catch (const InputError& error) {
    throw InputError(error.defect(), path.string() + ": " + error.what());
  }
}

std::variant<TriangleMesh, ProgressiveHull> read_mesh_or_hull(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  if (is_hull_content(content)) return load_hull(content, path);
  return read_mesh(content, path, {.progress = [](std::string_view, double) { return !interrupted(); }});
}

nlohmann::json facts(const MeshReport& report) {
  nlohmann::json defects;
  for (const DefectCount& defect : defect_counts(report)) defects[std::string(defect.name)] = defect.count;
  return {{"faces", report.faces},           {"vertices", report.vertices},
          {"components", report.components}, {"euler_characteristic", report.euler_characteristic},
          {"volume", report.volume},         {"defects", defects}};
}

nlohmann::json facts(const MeshQuality& quality) {
  const auto percentiles = [](const Percentiles& p, double unit) -> nlohmann::json {
    return {{"worst", p.worst / unit}, {"p1", p.p1 / unit}, {"p10", p.p10 / unit}, {"median", p.median / unit}};
  };
  return {{"compactness", percentiles(quality.compactness, 1)},
          {"dihedral_degrees", percentiles(quality.dihedral_angle, kDegree)},
          {"edges", quality.edges},
          {"sharp_edges", quality.sharp_edges},
          {"sharp_below_degrees", kSharpDihedralAngle / kDegree}};
}

std::string described(const MeshQuality& quality) {
  return fmt::format(
      "median compactness {:.2f}, worst {:.2g}; {} of {} edges sharp, worst dihedral angle {:.3g} degrees",
      quality.compactness.median, quality.compactness.worst, grouped(quality.sharp_edges), grouped(quality.edges),
      quality.dihedral_angle.worst / kDegree);
}

void require_writable(const std::filesystem::path& path) {
  if (path.empty()) return;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!std::filesystem::is_directory(folder))
    throw InputError(Defect::CannotWrite, fmt::format("{}: cannot write: there is no folder {}; create it first",
                                                      path.string(), folder.string()));
  if (std::filesystem::is_directory(path))
    throw InputError(Defect::CannotWrite,
                     fmt::format("{}: cannot write: it is a folder; name a file in it", path.string()));
  if (access(folder.c_str(), W_OK) != 0)
    throw InputError(Defect::CannotWrite,
                     fmt::format("{}: cannot write: {} takes no files from you; choose another folder", path.string(),
                                 folder.string()));
}

void require_distinct(const std::vector<std::filesystem::path>& paths) {
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!paths[i].empty() && !paths[j].empty() && resolved(paths[i]) == resolved(paths[j]))
        throw InputError(
            Defect::InvalidOption,
            fmt::format("{} is named twice, and would be overwritten; choose another name", paths[i].string()));
}

void write_report(const std::filesystem::path& path, nlohmann::json report) {
  if (path.empty()) return;
  report["version"] = PROHULL_VERSION;
  write_file(path, report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void add_report_option(CLI::App& command, std::filesystem::path& path) {
  command.add_option("--report", path, "Also write the facts of the summary as JSON")->type_name("FILE.json");
}

void add_examples(CLI::App& command, const std::vector<std::string>& examples) {
  std::string text = "Examples:\n";
  for (const std::string& example : examples) text += "  " + example + "\n";
  command.footer(text);
}

}  // namespace prohull::cli
