#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace prohull::bench {

constexpr int kDone = 0;
constexpr int kAnswerIsNo = 1;  // a hull is not certified, or an answer is wrong
constexpr int kWrongUsage = 2;
constexpr int kBadInput = 3;

// Each adds its subcommand to the program and leaves in `run` what to do when it is chosen; run returns the exit code.
using Run = std::function<int()>;
void add_construction(CLI::App& app, Run& run);
void add_intersections(CLI::App& app, Run& run);
void add_memory(CLI::App& app, Run& run);
void add_peers(CLI::App& app, Run& run);
void add_queries(CLI::App& app, Run& run);
void add_queues(CLI::App& app, Run& run);
void add_scale(CLI::App& app, Run& run);

}  // namespace prohull::bench
