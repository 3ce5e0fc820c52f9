#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "console.h"
#include "inputs.h"
#include "options.h"
#include "outputs.h"
#include "prohull/detail/mesh_quality.h"
#include "prohull/mesh_report.h"

namespace prohull::cli {

// What every subcommand shares: exit codes, and how facts are written down.

constexpr int kDone = 0;
constexpr int kAnswerIsNo = 1;  // verify failed, or a budget was not reached and --strict
constexpr int kWrongUsage = 2;
constexpr int kBadInput = 3;
constexpr int kUndecided = 4;  // neither yes nor no was found within --steps or --cells
constexpr int kInterrupted = 130;

constexpr const char* kWhatItIs = "progressive hulls of triangle meshes";

constexpr double kDegree = std::numbers::pi / 180;

/// Throws InputError if the program makes no pages, or if `out` is no name of a page.
void require_page(const std::filesystem::path& out);

nlohmann::json facts(const MeshReport& report);
nlohmann::json facts(const MeshQuality& quality);
nlohmann::json finite_or_null(double value);

// Each adds its subcommand to the program and leaves in `run` what to do when it is chosen; run returns the exit code.
using Run = std::function<int()>;

template <class Options>
struct CommandOf {
  CLI::App& command;
  Options& options;
};

/// Adds a subcommand that calls work(options) when it is chosen. The options are to be added to it.
template <class Options, class Work>
CommandOf<Options> add_command(CLI::App& app, Run& run, const std::string& name, const std::string& description,
                               Work work) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(name, description);
  command.callback([options, work, &run] { run = [options, work] { return work(*options); }; });
  return {command, *options};
}

void add_build(CLI::App& app, Run& run);
void add_cage(CLI::App& app, Run& run);
void add_collide(CLI::App& app, Run& run);
void add_completion(CLI::App& app, Run& run);
void add_contains(CLI::App& app, Run& run);
void add_convex(CLI::App& app, Run& run);
void add_distance(CLI::App& app, Run& run);
void add_info(CLI::App& app, Run& run);
void add_lod(CLI::App& app, Run& run);
void add_manual(CLI::App& app, Run& run);
void add_motion(CLI::App& app, Run& run);
void add_query(CLI::App& app, Run& run);
void add_render(CLI::App& app, Run& run);
void add_repair(CLI::App& app, Run& run);
void add_sample(CLI::App& app, Run& run);
void add_spheres(CLI::App& app, Run& run);
void add_sweep(CLI::App& app, Run& run);
void add_urdf(CLI::App& app, Run& run);
void add_verify(CLI::App& app, Run& run);
void add_view(CLI::App& app, Run& run);

}  // namespace prohull::cli
