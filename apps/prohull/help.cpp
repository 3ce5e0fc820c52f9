#include "help.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>
#include <sstream>

#include "arguments.h"
#include "options.h"

namespace prohull::cli {
namespace {

constexpr std::size_t kNameColumn = 28;

/// COLUMNS, else that of the terminal, up to what reads well, else 80.
std::size_t text_width() {
  constexpr std::size_t kLeast = 40, kUsual = 80, kMost = 100;
  if (const char* const columns = std::getenv("COLUMNS")) {
    std::size_t width = 0;
    if (std::from_chars(columns, columns + std::strlen(columns), width).ec == std::errc() && width > 0)
      return std::max(width, kLeast);
  }
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsual;
  return std::clamp<std::size_t>(size.ws_col, kLeast, kMost);
}

/// The words in lines that are no longer than `width`, but for words that are longer, each behind `indent` blanks.
std::string filled(std::string_view words, std::size_t width, std::size_t indent) {
  std::istringstream in{std::string(words)};
  std::string text, line;
  for (std::string word; in >> word;) {
    if (!line.empty() && indent + line.size() + 1 + word.size() > width)
      text += std::string(indent, ' ') + line + "\n", line.clear();
    line += (line.empty() ? "" : " ") + word;
  }
  return text + std::string(indent, ' ') + line + "\n";
}

/// Fills each line of the text as filled() does. Lines that begin with blanks are a list, "  name   what it is", whose
/// columns stay.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent) {
  std::istringstream in(text);
  std::string result;
  for (std::string line; std::getline(in, line);) {
    const bool in_list = line.starts_with(' ');
    const std::size_t name_end = in_list ? line.find(' ', line.find_first_not_of(' ')) : 0;
    const std::size_t what = in_list ? std::min(line.find_first_not_of(' ', name_end), line.size()) : 0;
    const std::string lines = filled(line.substr(what), width, indent + what);
    result += std::string(indent, ' ') + line.substr(0, what) + lines.substr(indent + what);
  }
  return result;
}

/// A name, and beside it, or below it where it is long or the text is narrow, what it is.
std::string entry(const std::string& name, const std::string& what, std::size_t width) {
  constexpr std::size_t kNarrow = 60, kNarrowIndent = 6;
  const std::size_t indent = width < kNarrow ? kNarrowIndent : kNameColumn;
  const std::string text = wrapped(what, width, indent);
  if (2 + name.size() + 2 > indent) return "  " + name + "\n" + text;
  return "  " + name + text.substr(2 + name.size());
}

/// "-o, --out OUT"
std::string name_of(const Argument& argument) {
  const std::string several = argument.is_positional() && argument.repeats ? " ..." : "";
  const std::string names = fmt::format("{}", fmt::join(argument.names, ", "));
  return names + (names.empty() || argument.is_flag() ? "" : " ") + argument.value + several;
}

std::string usage(const Command& command, bool has_commands) {
  std::string line = "Usage: " + command.name + (has_commands ? " COMMAND" : "") + " [OPTIONS]";
  for (const Argument& argument : command.arguments)
    if (argument.required && !argument.is_positional())
      line += fmt::format(" {} {}", argument.names[0], argument.value);
  for (const Argument& argument : command.arguments)
    if (argument.is_positional())
      line += argument.required ? " " + name_of(argument) : fmt::format(" [{}]", name_of(argument));
  return line + "\n";
}

std::string arguments(const Command& command, std::size_t width) {
  std::string text, group;
  for (const bool positional : {true, false})
    for (const Argument& argument : command.arguments) {
      if (argument.is_positional() != positional) continue;
      const std::string heading = positional ? "Arguments" : argument.group;
      if (heading != group) text += "\n" + wrapped(heading + ":", width, 0);
      group = heading;
      text += entry(name_of(argument), explained(argument), width);
    }
  return text;
}

std::string command_list(const std::vector<Command>& commands, std::size_t width) {
  std::string text = "\nCommands:\n";
  for (const Command& command : commands) text += entry(command.name, first_sentence(command.description), width);
  return text;
}

/// Whether only --all shows it.
bool is_more(const Argument& argument) { return argument.group.starts_with("More "); }

/// Removes what only --all shows, and what is said of it. Returns how many options there were.
std::size_t remove_more(Command& command) {
  std::set<std::string> more;
  for (const Argument& argument : command.arguments)
    if (is_more(argument)) more.insert(argument.names.begin(), argument.names.end());
  const std::size_t count = std::erase_if(command.arguments, is_more);
  for (Argument& argument : command.arguments)
    std::erase_if(argument.excluded, [&](const std::string& name) { return more.contains(name); });
  std::erase_if(command.footer, [&](const std::string& example) {
    const std::vector<std::string> words = CLI::detail::split(example, ' ');
    return std::ranges::any_of(words, [&](const std::string& word) { return more.contains(word); });
  });
  return count;
}

std::string footer(const Command& command, std::size_t width) {
  std::string text;
  for (const std::string& line : command.footer)  // examples are to be copied, so they stay lines
    text += line.starts_with(' ') ? line + "\n" : wrapped(line, width, 0);
  return text.empty() ? text : "\n" + text;
}

}  // namespace

std::string HelpFormatter::make_help(const CLI::App* app, std::string, CLI::AppFormatMode mode) const {
  const std::size_t width = text_width();
  Command command = command_of(*app);
  const std::vector<Command> commands = commands_of(*app);
  command.name = (app->get_parent() ? app->get_parent()->get_name() + " " : "") + command.name;
  std::string text =
      wrapped(command.description, width, 0) + "\n" + wrapped(usage(command, !commands.empty()), width, 0);
  if (!commands.empty()) text += command_list(commands, width);
  std::string hint;
  if (const auto more = mode == CLI::AppFormatMode::All ? 0 : remove_more(command); more > 0)
    hint =
        "\n" + wrapped(fmt::format("`prohull help {} --all` shows {} more options.", app->get_name(), more), width, 0);
  return text + arguments(command, width) + hint + footer(command, width);
}

namespace {

std::vector<std::string> names_of(const std::vector<Command>& commands) {
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.name);
  return names;
}

bool is_option(const std::string& argument) { return argument.starts_with('-') && argument != "-"; }

/// What an argument that the command does not take was to be.
std::string unknown(const CLI::App& app, const std::string& argument) {
  const Command command = command_of(app);
  if (is_option(argument)) {
    const std::string option = argument.substr(0, argument.find('='));
    const std::string begin = option.size() == 2 ? "-" + option : option;  // -f is what --faces begins with
    return fmt::format("unknown option '{}' of {}{}", option, command.name, suggestion(begin, option_names(command)));
  }
  return fmt::format("'{}' is one argument too many for {}", argument, command.name);
}

/// What arguments that stand before any command were to be.
std::string unknown_before_command(const CLI::App& app, const std::vector<std::string>& arguments) {
  const auto word = std::ranges::find_if_not(arguments, is_option);
  if (word != arguments.end())
    return fmt::format("unknown command '{}'{}", *word, suggestion(*word, names_of(commands_of(app))));
  return fmt::format("unknown option '{}'{}", arguments.front(),
                     app.get_subcommands().empty() ? suggestion(arguments.front(), option_names(command_of(app)))
                                                   : "; options go behind the command");
}

/// The first thing that is missing.
std::string missing(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    if (option->get_required() && option->count() == 0) {
      const std::string value = option->get_type_name();
      return option->get_positional() ? fmt::format("{} is missing", value)
                                      : fmt::format("{} {} is missing", option->get_name(), value);
    }
  for (const CLI::App* group : app.get_subcommands([](const CLI::App* child) { return child->get_name().empty(); })) {
    const std::vector<std::string> names = option_names(command_of(*group));
    if (group->get_require_option_min() > 0) return "one of " + alternatives(names) + " is needed, and only one";
  }
  return "";
}

/// The first of the arguments that the command does not take, or what is missing if it takes all. Behind -- are files.
std::string unexpected(const CLI::App& app) {
  const std::vector<std::string> extras = app.remaining();
  const auto mark = std::ranges::find(extras, "--"), option = std::find_if(extras.begin(), mark, is_option);
  if (option != mark) return unknown(app, *option);
  if (mark != extras.begin()) return unknown(app, extras.front());
  if (extras.size() < 2) return missing(app);
  return fmt::format("'{}' is one argument too many for {}; options go before --", extras[1], app.get_name());
}

/// CLI11 says "--a excludes --b".
std::string replaced(std::string text, std::string_view from, std::string_view to) {
  if (const auto at = text.find(from); at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

std::string what_is_wrong(const CLI::App& app, const CLI::Error& error) {
  const std::string what = error.what();
  switch (static_cast<CLI::ExitCodes>(error.get_exit_code())) {
    case CLI::ExitCodes::RequiredError:
    case CLI::ExitCodes::ExtrasError:
      return unexpected(app);
    case CLI::ExitCodes::ValidationError:
      return what.substr(what.find(": ") + 2);  // ours, behind the name of the option
    case CLI::ExitCodes::ExcludesError:
      return replaced(what, " excludes ", " cannot be used together with ");
    case CLI::ExitCodes::RequiresError:
      return replaced(what, " requires ", " can only be used together with ");
    case CLI::ExitCodes::ArgumentMismatch:
      return what.substr(0, what.find(':')) +
             (what.find(" missing") != std::string::npos ? " needs a value behind it" : " is given more than once");
    default:
      return what;
  }
}

/// App::help gives that of the command that was chosen.
std::string help_of(const CLI::App& app, bool all = false) {
  return HelpFormatter().make_help(&app, "", all ? CLI::AppFormatMode::All : CLI::AppFormatMode::Normal);
}

}  // namespace

std::string usage_error(const CLI::App* app, const CLI::Error& error) {
  const auto chosen = app->get_subcommands();
  const auto before_command = app->remaining();
  if (chosen.empty() && before_command.empty()) return help_of(*app);
  const std::string what =
      before_command.empty() ? what_is_wrong(*chosen.front(), error) : unknown_before_command(*app, before_command);
  const bool is_about_all = chosen.empty() || chosen.front()->get_name() == "help";
  return fmt::format("prohull: {}\n`prohull help{}` shows {}.\n", one_line(what),
                     is_about_all ? "" : " " + chosen.front()->get_name(),
                     is_about_all ? "all commands" : "options, with examples");
}

void add_help(CLI::App& app, Run& run) {
  const auto name = std::make_shared<std::string>();
  const auto all = std::make_shared<bool>(false);
  CLI::App& command = *app.add_subcommand("help", "Shows the help of a command, or of the program.");
  CLI::Option* const option =
      command.add_option("command", *name, "The command. Without it, the help of prohull itself is shown.");
  option->type_name("COMMAND");
  command.add_flag("--all", *all, "Show all options, also those that are seldom needed.");
  add_examples(command, {"prohull help", "prohull help build", "prohull help build --all"});
  command.callback([&app, name, all, &run] {
    const auto words = names_of(commands_of(app));
    if (!name->empty() && std::ranges::find(words, *name) == words.end())
      throw CLI::ValidationError("command", fmt::format("unknown command '{}'{}", *name, suggestion(*name, words)));
    run = [&app, name, all] {
      std::fputs(help_of(name->empty() ? app : *app.get_subcommand(*name), *all).c_str(), stdout);
      return kDone;
    };
  });
}

}  // namespace prohull::cli
