#include "arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>

#include "prohull/mesh_io.h"

namespace prohull::cli {
namespace {

using Extensions = std::vector<std::string>;

Extensions operator+(Extensions a, const Extensions& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// What --help calls a value that is a file, and what its name may end in.
const std::map<std::string_view, Extensions>& file_types() {
  static const Extensions phull{".phull"}, written = written_mesh_extensions(),
                                           read = read_mesh_extensions() + Extensions{".gz", ".zip"};
  static const std::map<std::string_view, Extensions> types{{"IN", read + phull},
                                                            {"HULL", read + phull},
                                                            {"MESH", read + phull},
                                                            {"ORIGINAL", read},
                                                            {"OUT", written},
                                                            {"FILE", {".npy", ".npz", ".csv"}},
                                                            {"HITS", {".npz", ".csv"}},
                                                            {"H.phull", phull},
                                                            {"FILE.json", {".json"}},
                                                            {"OUT.png", {".png"}},
                                                            {"PIECES", written + Extensions{".urdf", ".xml"}}};
  return types;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::string heading(const CLI::App& group, const CLI::Option& option) {
  if (!group.get_name().empty()) return option.get_group();
  return group.get_group() + ". " + group.get_description();
}

/// "2000" of "[2000]": of an option that takes several.
std::string without_brackets(const std::string& value) {
  return value.starts_with('[') && value.ends_with(']') ? value.substr(1, value.size() - 2) : value;
}

Argument argument(const CLI::App& group, const CLI::Option& option) {
  Argument result;
  result.names = names_of(option);
  result.description = option.get_description();
  result.group = heading(group, option);
  result.required = option.get_required();
  if (option.get_items_expected_max() > 0) {
    result.value = option.get_type_name();
    if (!result.required) result.initial = without_brackets(option.get_default_str());
    result.repeats = option.get_items_expected_max() > 1;
  }
  for (const CLI::Option* other : option.get_excludes()) result.excluded.push_back(other->get_name());
  for (const CLI::Option* other : option.get_needs()) result.needed.push_back(other->get_name());
  std::ranges::sort(result.excluded);  // CLI11 has them in the order of their addresses
  std::ranges::sort(result.needed);
  if (result.value.find('|') != std::string::npos) result.words = split(result.value, '|');
  if (const auto type = file_types().find(result.value); type != file_types().end()) result.extensions = type->second;
  return result;
}

/// One heading after the other, in the order in which they come first.
void gather_groups(std::vector<Argument>& arguments) {
  std::vector<std::string> groups;
  for (const Argument& argument : arguments)
    if (std::ranges::find(groups, argument.group) == groups.end()) groups.push_back(argument.group);
  std::ranges::stable_sort(arguments, {}, [&](const Argument& argument) {
    return std::ranges::find(groups, argument.group) - groups.begin();
  });
}

std::vector<const CLI::App*> children(const CLI::App& app, bool named) {
  return app.get_subcommands([named](const CLI::App* child) { return child->get_name().empty() != named; });
}

void append_arguments(const CLI::App& group, std::vector<Argument>& arguments) {
  const bool is_command = !group.get_name().empty();  // a group of options inherits --help
  for (const CLI::Option* option : group.get_options())
    if (is_command || option != group.get_help_ptr()) arguments.push_back(argument(group, *option));
  for (const CLI::App* option_group : children(group, false)) append_arguments(*option_group, arguments);
}

}  // namespace

std::string explained(const Argument& argument) {
  std::string text = argument.description;
  if (argument.required && !argument.is_positional()) text += " Required.";
  if (!argument.initial.empty()) text += fmt::format(" The default is {}.", argument.initial);
  if (!argument.excluded.empty()) text += fmt::format(" Not with {}.", fmt::join(argument.excluded, ", "));
  if (!argument.needed.empty()) text += fmt::format(" Only with {}.", fmt::join(argument.needed, ", "));
  return text;
}

std::string first_sentence(const std::string& description) {
  std::string sentence = description.substr(0, std::min(description.find(". "), description.find(":\n")));
  if (sentence.ends_with('.')) sentence.pop_back();
  return sentence;
}

Command command_of(const CLI::App& app) {
  Command result{app.get_name(), app.get_description(), {}, split(app.get_footer(), '\n')};
  append_arguments(app, result.arguments);
  gather_groups(result.arguments);
  return result;
}

std::vector<std::string> option_names(const Command& command) {
  std::vector<std::string> names;
  for (const Argument& argument : command.arguments)
    names.insert(names.end(), argument.names.begin(), argument.names.end());
  return names;
}

std::vector<Command> commands_of(const CLI::App& app) {
  std::vector<Command> result;
  for (const CLI::App* child : children(app, true)) result.push_back(command_of(*child));
  return result;
}

}  // namespace prohull::cli
