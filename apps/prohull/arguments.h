#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace prohull::cli {

/// An option or a positional argument of a command, as --help describes it, for the manual page and for shells.
struct Argument {
  std::vector<std::string> names;       ///< "-o", "--out"; empty: positional
  std::string value;                    ///< "OUT", "outer|inner"; empty: a flag
  std::string description, group;       ///< group: the heading in --help
  std::string initial;                  ///< its value where it is not given; may be empty
  std::vector<std::string> excluded;    ///< names of options that may not be given with it, sorted
  std::vector<std::string> needed;      ///< names of options without which it may not be given, sorted
  std::vector<std::string> words;       ///< its value is one of these, if there are any,
  std::vector<std::string> extensions;  ///< or, if there are any, a file whose name ends in one: ".ply"
  bool required = false, repeats = false;

  bool is_positional() const { return names.empty(); }
  bool is_flag() const { return value.empty(); }
};

struct Command {
  std::string name, description;
  std::vector<Argument> arguments;
  std::vector<std::string> footer;  ///< lines
};

/// The names of all arguments that are not positional.
std::vector<std::string> option_names(const Command& command);

/// The description, and behind it what else there is to say: "Required." "The default is 4." "Not with --tight."
std::string explained(const Argument& argument);

/// The first sentence without its full stop, for lists.
std::string first_sentence(const std::string& description);

/// One of the commands, or the program itself without them.
Command command_of(const CLI::App& app);

/// In the order of --help.
std::vector<Command> commands_of(const CLI::App& app);

}  // namespace prohull::cli
