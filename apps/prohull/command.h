#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "prohull/hull_builder.h"
#include "prohull/mesh_io.h"
#include "prohull/mesh_quality.h"
#include "prohull/mesh_report.h"
#include "prohull/names.h"
#include "prohull/progress.h"
#include "prohull/repair.h"
#include "prohull/text.h"

namespace prohull::cli {

// What every subcommand shares: exit codes, progress, reports, and how facts are written down.

constexpr int kDone = 0;
constexpr int kAnswerIsNo = 1;  // verify failed, or a budget was not reached and --strict
constexpr int kWrongUsage = 2;
constexpr int kBadInput = 3;
constexpr int kInterrupted = 130;

constexpr const char* kWhatItIs = "progressive hulls of triangle meshes";

constexpr double kDegree = std::numbers::pi / 180;

/// Thrown where Ctrl-C is noticed; main turns it into kInterrupted.
struct Interrupted {};

/// Turns Ctrl-C and SIGTERM into a flag, so that commands end without a partial file.
void catch_interrupts();
bool interrupted();

/// A line on stderr that is drawn again and again, if that is a terminal; ends when the object does.
class ProgressLine {
 public:
  explicit ProgressLine(std::string label);
  ~ProgressLine();
  /// False once the user has interrupted, as the library's progress callbacks want it.
  bool operator()(double fraction);
  Progress as_progress() {
    return [this](std::string_view, double fraction) { return (*this)(fraction); };
  }

 private:
  std::string label_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point drawn_;
};

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// read_mesh, ended by Ctrl-C also while another program reads the file.
TriangleMesh read_input(const std::filesystem::path& path, NonFinite non_finite = NonFinite::Refuse);

/// A mesh file read and made closed; errors name the file.
struct Input {
  ClosedMesh closed;
  double read_seconds, repair_seconds;
};
Input read_closed_mesh(const std::filesystem::path& path);

/// What a mesh or .phull file holds; it is read once, so that it may be a pipe.
std::variant<TriangleMesh, ProgressiveHull> read_mesh_or_hull(const std::filesystem::path& path);

nlohmann::json facts(const MeshReport& report);
nlohmann::json facts(const MeshQuality& quality);

/// In a line: "compactness median 0.72, worst 0.08; ..."
std::string described(const MeshQuality& quality);

/// Throws InputError(CannotWrite) if the folder of `path` does not take files: before the work, not after it.
void require_writable(const std::filesystem::path& path);

/// Throws InputError(InvalidOption) if two of the files are the same: one would overwrite the other. Empty paths are
/// none.
void require_distinct(const std::vector<std::filesystem::path>& paths);

/// Writes the report if a path was given.
void write_report(const std::filesystem::path& path, nlohmann::json report);

void add_report_option(CLI::App& command, std::filesystem::path& path);
void add_examples(CLI::App& command, const std::vector<std::string>& examples);

/// An option that takes one of the names, of which --help tells the one that `value` has as the default.
template <class Value>
CLI::Option* add_choice(CLI::App& command, const std::string& flag, Value& value, Names<Value> names,
                        const std::string& description) {
  std::vector<std::string> words;
  for (const auto& [name, v] : names) words.emplace_back(name);
  const auto set = [&value, names](const std::string& word) { value = value_of(names, word).value_or(value); };
  return command.add_option_function<std::string>(flag, set, description)
      ->check(CLI::IsMember(words).description(""))
      ->type_name(CLI::detail::join(words, "|"))
      ->default_str(std::string(name_of(names, value)));
}

// Each adds its subcommand to the program and leaves in `run` what to do when it is chosen; run returns the exit code.
using Run = std::function<int()>;
void add_build(CLI::App& app, Run& run);
void add_completion(CLI::App& app, Run& run);
void add_info(CLI::App& app, Run& run);
void add_lod(CLI::App& app, Run& run);
void add_manual(CLI::App& app, Run& run);
void add_query(CLI::App& app, Run& run);
void add_render(CLI::App& app, Run& run);
void add_sample(CLI::App& app, Run& run);
void add_verify(CLI::App& app, Run& run);

}  // namespace prohull::cli
