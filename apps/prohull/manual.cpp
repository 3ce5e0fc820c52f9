#include <fmt/format.h>

#include <cstdio>
#include <string_view>

#include "arguments.h"
#include "command.h"

namespace prohull::cli {
namespace {

// The manual page, of what --help says, for man and groff: groff_man(7).

/// Text that the formatter takes as it is: hyphens stay as they are typed, and no line begins with a request.
std::string literal(std::string_view text) {
  std::string result;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
    line_begins = c == '\n';
  }
  return result;
}

std::string bold(std::string_view text) { return "\\fB" + literal(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + literal(text) + "\\fR"; }

/// Words are typed as they stand, other values are not; lines may break between words.
std::string value(const Argument& argument) {
  if (argument.words.empty())
    return italic(argument.value) + (argument.is_positional() && argument.repeats ? " ..." : "");
  std::string words;
  for (const std::string& word : argument.words) words += (words.empty() ? "" : "|\\:") + bold(word);
  return words;
}

/// "-o, --out OUT"
std::string tag(const Argument& argument) {
  std::string names;
  for (const std::string& name : argument.names) names += (names.empty() ? "" : ", ") + bold(name);
  if (argument.is_flag()) return names;
  return names + (names.empty() ? "" : " ") + value(argument);
}

/// Lines that begin with blanks, as in a list, stay lines.
std::string paragraph(const std::string& text) {
  const std::size_t list = text.find("\n ");
  if (list == std::string::npos) return literal(text) + "\n";
  return literal(text.substr(0, list)) + "\n.nf" + literal(text.substr(list)) + "\n.fi\n";
}

std::string described(const Argument& argument) {
  return ".TP\n" + tag(argument) + "\n" + paragraph(explained(argument));
}

/// "prohull build [OPTIONS] -o OUT IN"
std::string synopsis(const Command& command) {
  std::string line = bold("prohull " + command.name) + " [" + italic("OPTIONS") + "]";
  for (const Argument& argument : command.arguments)
    if (argument.required && !argument.is_positional())
      line += " " + bold(argument.names.front()) + " " + value(argument);
  for (const Argument& argument : command.arguments)
    if (argument.is_positional()) line += " " + value(argument);
  return line;
}

std::string footer(const Command& command) {
  std::string text;
  bool filled = true;
  for (const std::string& line : command.footer) {
    const bool is_example = line.starts_with(' ');
    if (is_example && filled) text += ".PP\n.nf\n";
    text += (is_example ? "" : ".PP\n") + literal(line) + "\n";
    filled = !is_example;
  }
  return text + (filled ? "" : ".fi\n");
}

std::string arguments(const Command& command) {
  std::string text, group;
  for (const Argument& argument : command.arguments) {
    if (argument.names.size() == 2 && argument.names[1] == "--help") continue;  // of each command
    if (!argument.is_positional() && argument.group != group && argument.group != "Options")
      text += ".PP\n" + literal(argument.group) + ":\n";
    if (!argument.is_positional()) group = argument.group;
    text += described(argument);
  }
  return text;
}

std::string manual_page(const Command& app, const std::vector<Command>& all) {
  std::string page = fmt::format(".TH PROHULL 1 \"\" \"prohull {}\" \"User Commands\"\n.ad l\n.nh\n", PROHULL_VERSION);
  page += ".SH NAME\nprohull \\- " + literal(kWhatItIs) + "\n.SH SYNOPSIS\n.nf\n";
  for (const Command& command : all) page += synopsis(command) + "\n";
  page += bold("prohull") + " " + bold("--version") + " | " + bold("--help") + "\n";
  page += ".fi\n.SH DESCRIPTION\n" + literal(app.description) + "\n" + footer(app) + ".SH COMMANDS\n";
  for (const Command& command : all)
    page += ".SS " + literal(command.name) + "\n" + literal(command.description) + "\n" + arguments(command) +
            footer(command);
  return page;
}

}  // namespace

void add_manual(CLI::App& app, Run& run) {
  CLI::App& command =
      *app.add_subcommand("manual", "Prints the manual page, for man and groff: the help of all commands in one.");
  add_examples(command, {"prohull manual | man -l -"});
  command.callback([&app, &run] {
    run = [&app] {
      std::fputs(manual_page(command_of(app), commands_of(app)).c_str(), stdout);
      return kDone;
    };
  });
}

}  // namespace prohull::cli
