#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "prohull/detail/names.h"
#include "prohull/geometry.h"
#include "prohull/length.h"

namespace prohull::cli {

// Options that say in plain words what they take, where --help and errors tell it.

/// The numbers that an option takes.
struct Range {
  double least = 0, most = std::numeric_limits<double>::infinity();
  bool without_least = false;
  bool in_percent = false;  ///< a % may stand behind the number
};
constexpr Range kPositive{.without_least = true};
constexpr Range kPercent{.without_least = true, .in_percent = true};
constexpr Range kSeed{0, 0x1p64};

/// Refuses what is no number in the range, and writes the others as CLI11 reads them: 1e6 as 1000000.
/// `name` is that of the option, for the message.
CLI::Validator number_in(const std::string& name, const Range& range, bool whole);

/// The number that all of the text is; a plus may stand before it.
template <class Number>
std::optional<Number> parsed(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number number{};
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || rest != text.data() + text.size()) return std::nullopt;
  return number;
}

/// The `count` finite numbers of a text, with commas between them. Throws InputError(InvalidOption) that calls it
/// `what`.
std::vector<double> numbers_of(const std::string& text, std::size_t count, const char* what);

/// Three numbers, likewise.
Vec3 vector_of(const std::string& text, const char* what);

/// Refuses what is none of the words, and suggests the nearest.
CLI::Validator one_of(const std::string& name, const std::vector<std::string>& words);

/// "--out" of "-o,--out"; "SHELL" of "shell"
std::string main_name(const std::string& names);

/// An option or a positional argument, whose value --help calls `type`.
template <class Value>
CLI::Option* add_value(CLI::App& command, const std::string& names, Value& value, const std::string& type,
                       const std::string& description) {
  return command.add_option(names, value, description)->type_name(type);
}

/// Values of which each is a number, such as std::size_t or std::vector<double>; without a default.
template <class Values>
CLI::Option* add_optional_number(CLI::App& command, const std::string& names, Values& values, const Range& range,
                                 const std::string& description) {
  constexpr bool kWhole = [] {
    if constexpr (std::is_arithmetic_v<Values>)
      return std::is_integral_v<Values>;
    else
      return std::is_integral_v<typename Values::value_type>;
  }();
  CLI::Option* const option =
      command.add_option(names, values, description)->transform(number_in(main_name(names), range, kWhole));
  return kWhole ? option->type_name("N") : option;
}

/// add_optional_number() with the values as the default, which --help tells.
template <class Values>
CLI::Option* add_number(CLI::App& command, const std::string& names, Values& values, const Range& range,
                        const std::string& description) {
  return add_optional_number(command, names, values, range, description)->capture_default_str();
}

/// An option that takes one of the words, which `set` gets.
CLI::Option* add_words(CLI::App& command, const std::string& names, const std::vector<std::string>& words,
                       const std::string& description, const std::function<void(const std::string&)>& set);

template <class Value>
std::vector<std::string> words_of(Names<Value> choices) {
  std::vector<std::string> words;
  for (const auto& [name, choice] : choices) words.emplace_back(name);
  return words;
}

/// An option that takes one of the names.
template <class Value>
CLI::Option* add_choice(CLI::App& command, const std::string& names, std::optional<Value>& value,
                        std::type_identity_t<Names<Value>> choices, const std::string& description) {
  return add_words(command, names, words_of(choices), description,
                   [&value, choices](const std::string& word) { value = value_of(choices, word); });
}

/// A choice of which --help tells the one that `value` has as the default.
template <class Value>
CLI::Option* add_choice(CLI::App& command, const std::string& names, Value& value,
                        std::type_identity_t<Names<Value>> choices, const std::string& description) {
  return add_words(command, names, words_of(choices), description,
                   [&value, choices](const std::string& word) { value = *value_of(choices, word); })
      ->default_str(std::string(name_of(choices, value)));
}

/// An option that takes a length greater than 0, in the unit of `mesh` if it has none.
CLI::Option* add_length(CLI::App& command, const std::string& names, Length& length, const std::string& description,
                        const std::string& mesh = "the mesh");

/// The options of a command that are added until the end of the scope stand under a heading of their own.
class Heading {
 public:
  Heading(CLI::App& command, const char* name) : defaults_(*command.option_defaults()) { defaults_.group(name); }
  Heading(const Heading&) = delete;
  Heading& operator=(const Heading&) = delete;
  ~Heading() { defaults_.group("Options"); }

 private:
  CLI::OptionDefaults& defaults_;
};

/// `note` says what the threads do not change.
void add_threads_option(CLI::App& command, unsigned& threads, const std::string& note);
void add_report_option(CLI::App& command, std::filesystem::path& path);
void add_package_path_option(CLI::App& command, std::vector<std::filesystem::path>& folders);
void add_examples(CLI::App& command, const std::vector<std::string>& examples);

/// The word that someone most likely meant, or none if all are far from it.
std::string nearest(std::string_view word, const std::vector<std::string>& words);

/// "; did you mean 'build'?", or nothing
std::string suggestion(std::string_view word, const std::vector<std::string>& words);

/// "ply, obj or off"
std::string alternatives(const std::vector<std::string>& words);

}  // namespace prohull::cli
