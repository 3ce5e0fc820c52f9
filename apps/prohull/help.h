#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "command.h"

namespace prohull::cli {

/// What --help prints: wrapped at the width of the terminal, without the types that options have in C++.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

/// What main prints where the command line is wrong: what is wrong, what was probably meant, and where to read on.
std::string usage_error(const CLI::App* app, const CLI::Error& error);

void add_help(CLI::App& app, Run& run);

}  // namespace prohull::cli
