#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace prohull::bench {

constexpr int kDone = 0;
constexpr int kAnswerIsNo = 1;  // a hull is not certified, or an answer is wrong
constexpr int kWrongUsage = 2;
constexpr int kBadInput = 3;

// Each adds its subcommand to the program and leaves in `run` what to do when it is chosen; run returns the exit code.
using Run = std::function<int()>;
void add_aimed(CLI::App& app, Run& run);
void add_asked(CLI::App& app, Run& run);
void add_closest(CLI::App& app, Run& run);
void add_collide(CLI::App& app, Run& run);
void add_construction(CLI::App& app, Run& run);
void add_corpus(CLI::App& app, Run& run);
void add_covers(CLI::App& app, Run& run);
void add_filters(CLI::App& app, Run& run);
void add_gaps(CLI::App& app, Run& run);
void add_intersections(CLI::App& app, Run& run);
void add_joint_slice(CLI::App& app, Run& run);
void add_leaks(CLI::App& app, Run& run);
void add_link_covers(CLI::App& app, Run& run);
void add_looser(CLI::App& app, Run& run);
void add_memory(CLI::App& app, Run& run);
void add_motion(CLI::App& app, Run& run);
void add_peers(CLI::App& app, Run& run);
void add_queries(CLI::App& app, Run& run);
void add_queues(CLI::App& app, Run& run);
void add_rays(CLI::App& app, Run& run);
void add_robots(CLI::App& app, Run& run);
void add_scale(CLI::App& app, Run& run);
void add_sweeps(CLI::App& app, Run& run);
void add_tight(CLI::App& app, Run& run);

// Options that several commands have.
void add_faces_option(CLI::App& command, std::size_t& faces);
void add_faces_option(CLI::App& command, std::vector<std::size_t>& faces,
                      const std::string& description = "Sizes of hulls");
void add_rounds_option(CLI::App& command, std::size_t& rounds);
void add_out_option(CLI::App& command, std::filesystem::path& out, const std::string& files);

/// Prints `text`; with a folder `out`, which is made if it is not there, also writes it there as NAME.md.
void publish(const std::filesystem::path& out, const std::string& name, const std::string& text);
/// Also writes NAME.csv there.
void publish(const std::filesystem::path& out, const std::string& name, const std::string& text,
             const std::string& csv);

}  // namespace prohull::bench
