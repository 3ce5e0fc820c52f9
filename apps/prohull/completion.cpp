#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include "arguments.h"
#include "command.h"

namespace prohull::cli {
namespace {

// A script for each shell, of what --help says: commands, options, the words a value may be, and files by their names.

std::string joined(const std::vector<std::string>& parts, std::string_view separator) {
  return fmt::format("{}", fmt::join(parts, separator));
}

/// The text with a backslash before each character of `special`.
std::string escaped(const std::string& text, std::string_view special) {
  std::string result;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

/// ".ply", ".obj" as "ply|obj"
std::string any_of_extensions(const std::vector<std::string>& extensions) {
  std::string result;
  for (const std::string& extension : extensions) result += (result.empty() ? "" : "|") + extension.substr(1);
  return result;
}

void add_missing(std::vector<std::string>& to, const std::vector<std::string>& from) {
  for (const std::string& text : from)
    if (std::ranges::find(to, text) == to.end()) to.push_back(text);
}

/// What may stand for any of them: for bash and fish, which do not count them.
Argument positional(const Command& command) {
  Argument any;
  for (const Argument& argument : command.arguments)
    if (argument.is_positional()) {
      add_missing(any.words, argument.words);
      add_missing(any.extensions, argument.extensions);
    }
  return any;
}

// --- bash ---

std::string bash_values(const Argument& argument) {
  if (!argument.words.empty()) return fmt::format("_prohull_words '{}'", joined(argument.words, " "));
  if (!argument.extensions.empty()) return fmt::format("_prohull_files '{}'", any_of_extensions(argument.extensions));
  return ":";
}

std::string bash_command(const Command& command) {
  std::string script = fmt::format("    {})\n      case $prev in\n", command.name);
  for (const Argument& argument : command.arguments)
    if (!argument.is_positional() && !argument.is_flag())
      script += fmt::format("        {}) {}; return ;;\n", joined(argument.names, "|"), bash_values(argument));
  script += "      esac\n";
  script +=
      fmt::format("      [[ $cur == -* ]] && _prohull_words '{}' && return\n", joined(option_names(command), " "));
  script += "      " + bash_values(positional(command)) + "\n";
  return script + "      ;;\n";
}

std::string bash_script(const Command& app, const std::vector<Command>& all) {
  std::string script = R"(# bash completion for prohull, written by: prohull completion bash

_prohull_words() {
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur")
}

# Folders, and files whose names end in one of "ply|obj|stl", in any case.
_prohull_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$cur"; compgen -f -- "$cur" | grep -iE "\.($1)$")
}

_prohull() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}
  COMPREPLY=()
  # bash splits --option=value into three words
  if [[ $cur == = ]]; then
    cur=
  elif [[ $prev == = ]]; then
    prev=${COMP_WORDS[COMP_CWORD-2]}
  fi
)";
  std::vector<std::string> first = option_names(app);
  for (const Command& command : all) first.push_back(command.name);
  script +=
      fmt::format("  if ((COMP_CWORD == 1)); then\n    _prohull_words '{}'\n    return\n  fi\n", joined(first, " "));
  script += "  case ${COMP_WORDS[1]} in\n";
  for (const Command& command : all) script += bash_command(command);
  return script + "  esac\n}\n\ncomplete -F _prohull prohull\n";
}

// --- zsh ---

std::string zsh_values(const Argument& argument) {
  const std::string label = escaped(argument.value, ":[]()|\\");
  if (!argument.words.empty()) return fmt::format(":value:({})", joined(argument.words, " "));
  if (!argument.extensions.empty())
    return fmt::format(":{}:_files -g \"(#i)*.({})\"", label, any_of_extensions(argument.extensions));
  return fmt::format(":{}: ", label);
}

std::string zsh_argument(const Argument& argument) {
  if (argument.is_positional()) return quoted((argument.repeats ? "*" : "") + zsh_values(argument));
  const std::string takes = argument.is_flag() ? "" : zsh_values(argument);
  const std::string description = "[" + escaped(first_sentence(argument.description), ":[]\\") + "]";
  std::string specs;
  for (const std::string& name : argument.names) {
    const bool joins = !argument.is_flag() && name.starts_with("--");  // --out=FILE as well as --out FILE
    const std::string others = argument.repeats ? "*" : "(" + joined(argument.names, " ") + ")";
    specs += (specs.empty() ? "" : " ") + quoted(others + name + (joins ? "=" : "") + description + takes);
  }
  return specs;
}

std::string zsh_arguments(const Command& command) {
  std::string script = "_arguments";
  for (const Argument& argument : command.arguments) script += " \\\n        " + zsh_argument(argument);
  return script;
}

std::string zsh_script(const Command& app, const std::vector<Command>& all) {
  std::string script = "#compdef prohull\n# zsh completion for prohull, written by: prohull completion zsh\n\n";
  script += "_prohull() {\n  local -a commands=(\n";
  for (const Command& command : all)
    script += "    " + quoted(command.name + ":" + escaped(first_sentence(command.description), ":\\")) + "\n";
  script += "  )\n  if ((CURRENT == 2)); then\n    _describe command commands\n    " + zsh_arguments(app);
  script += "\n    return\n  fi\n  shift words\n  ((CURRENT--))\n  case $words[1] in\n";
  for (const Command& command : all)
    script += fmt::format("    {})\n      {}\n      ;;\n", command.name, zsh_arguments(command));
  return script + R"(  esac
}

if [[ $zsh_eval_context[-1] == loadautofunc ]]; then
  _prohull "$@"
else
  compdef _prohull prohull
fi
)";
}

// --- fish ---

std::string fish_values(const Argument& argument) {
  if (!argument.words.empty()) return fmt::format(" -x -a {}", quoted(joined(argument.words, " ")));
  if (!argument.extensions.empty())
    return fmt::format(" -x -a {}", quoted("(__prohull_files " + quoted(any_of_extensions(argument.extensions)) + ")"));
  return " -x";
}

std::string fish_argument(const Argument& argument) {
  std::string line;
  for (const std::string& name : argument.names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!argument.is_flag()) line += fish_values(argument);
  return line + " -d " + quoted(first_sentence(argument.description));
}

std::string fish_script(const Command& app, const std::vector<Command>& all) {
  std::string script = R"(# fish completion for prohull, written by: prohull completion fish

# Folders, and files whose names end in one of "ply|obj|stl", in any case.
function __prohull_files
    __fish_complete_path (commandline -ct) | string match -ri -- '^[^\t]*(?:/|\.(?:'$argv[1]'))(?:\t.*)?$'
end

complete -c prohull -f
)";
  for (const Argument& argument : app.arguments)
    script += "complete -c prohull -n __fish_use_subcommand" + fish_argument(argument) + "\n";
  for (const Command& command : all)
    script += fmt::format("complete -c prohull -n __fish_use_subcommand -a {} -d {}\n", command.name,
                          quoted(first_sentence(command.description)));
  for (const Command& command : all) {
    const std::string in_command = fmt::format("complete -c prohull -n '__fish_seen_subcommand_from {}'", command.name);
    script += in_command + fish_values(positional(command)) + "\n";
    for (const Argument& argument : command.arguments)
      if (!argument.is_positional()) script += in_command + fish_argument(argument) + "\n";
  }
  return script;
}

using Writer = std::string (*)(const Command& app, const std::vector<Command>& all);

Names<Writer> shells() {
  static constexpr std::array<std::pair<std::string_view, Writer>, 3> kShells{
      {{"bash", bash_script}, {"zsh", zsh_script}, {"fish", fish_script}}};
  return kShells;
}

}  // namespace

void add_completion(CLI::App& app, Run& run) {
  const auto shell = std::make_shared<Writer>(bash_script);
  CLI::App& command = *app.add_subcommand(
      "completion", "Prints a script by which a shell completes the commands, options and files of prohull.");
  add_choice(command, "shell", *shell, shells(), "The shell.")->required();
  add_examples(command, {"source <(prohull completion bash)", "prohull completion fish | source"});
  command.callback([&app, shell, &run] {
    run = [&app, shell] {
      std::fputs((*shell)(command_of(app), commands_of(app)).c_str(), stdout);
      return kDone;
    };
  });
}

}  // namespace prohull::cli
