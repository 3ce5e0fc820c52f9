#include "options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "console.h"
#include "prohull/error.h"

namespace prohull::cli {
namespace {

std::string shown(double number) {
  constexpr double kTooLongToGroup = 1e15;
  const bool is_grouped = number >= 1000 && number < kTooLongToGroup && number == std::floor(number);
  return is_grouped ? grouped(static_cast<std::size_t>(number)) : fmt::format("{:g}", number);
}

/// "at least 4"; a limit that only keeps numbers sane is told to those alone who meet it.
std::string told(const Range& range, double number) {
  constexpr double kSane = 1e6;
  if (range.without_least) return "greater than " + shown(range.least);
  if (range.most < kSane) return fmt::format("between {} and {}", shown(range.least), shown(range.most));
  return number < range.least ? "at least " + shown(range.least) : "at most " + shown(range.most);
}

/// How many characters are inserted, left out, replaced or exchanged with the next one between the two words.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = std::exchange(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

}  // namespace

CLI::Validator number_in(const std::string& name, const Range& range, bool whole) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        const std::string given = text;
        if (range.in_percent && text.size() > 1 && text.ends_with('%')) text.pop_back();
        const auto number = parsed<double>(text);
        if (!number || !std::isfinite(*number))
          return fmt::format("{} must be a {}number, not '{}'", name, whole ? "whole " : "", given);
        if (*number < range.least || *number > range.most || (range.without_least && *number == range.least))
          return fmt::format("{} must be {}, not {}", name, told(range, *number), text);
        if (!whole) return "";
        if (*number != std::floor(*number)) return fmt::format("{} must be a whole number, not {}", name, text);
        const auto exact = parsed<std::uint64_t>(text);  // with all of its digits
        if (!exact && *number >= 0x1p64) return fmt::format("{} must be {}, not {}", name, told(range, *number), text);
        text = std::to_string(exact ? *exact : static_cast<std::uint64_t>(*number));
        return "";
      },
      "");
}

CLI::Option* add_length(CLI::App& command, const std::string& names, Length& length, const std::string& description,
                        const std::string& mesh) {
  const auto check = [name = main_name(names)](const std::string& text) -> std::string {
    const bool is_negative = text.starts_with('-');
    const auto given = length_of(std::string_view(text).substr(is_negative ? 1 : 0));
    if (!given)
      return fmt::format("{} must be a number, or one with {} or % behind it, not '{}'", name, joined(length_units()),
                         text);
    return is_negative || given->number == 0 ? fmt::format("{} must be greater than 0, not {}", name, text) : "";
  };
  return command
      .add_option_function<std::string>(
          names, [&length](const std::string& text) { length = length_of(text).value_or(Length{}); },
          fmt::format("{} Say it in the unit of {}, with a unit (2mm), or in per cent of the diagonal of its bounding "
                      "box (0.5%).",
                      description, mesh))
      ->check(CLI::Validator(check, ""))
      ->type_name("LENGTH");
}

std::vector<double> numbers_of(const std::string& text, std::size_t count, const char* what) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(Defect::InvalidOption, fmt::format("'{}' is no {}; {}", text, what, why));
  };
  std::vector<double> numbers;
  for (const std::string& word : CLI::detail::split(text, ',')) {
    const auto number = parsed<double>(word);
    if (numbers.size() == count || !number || !std::isfinite(*number))
      refuse(fmt::format("say {} numbers with commas between them", count));
    numbers.push_back(*number);
  }
  if (numbers.size() < count) refuse(fmt::format("it has {} numbers, not {}", numbers.size(), count));
  return numbers;
}

Vec3 vector_of(const std::string& text, const char* what) {
  const std::vector<double> numbers = numbers_of(text, 3, what);
  return {numbers[0], numbers[1], numbers[2]};
}

CLI::Validator one_of(const std::string& name, const std::vector<std::string>& words) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        if (std::ranges::find(words, text) != words.end()) return "";
        return fmt::format("{} must be {}, not '{}'{}", name, alternatives(words), text, suggestion(text, words));
      },
      "");
}

CLI::Option* add_words(CLI::App& command, const std::string& names, const std::vector<std::string>& words,
                       const std::string& description, const std::function<void(const std::string&)>& set) {
  return command.add_option_function<std::string>(names, set, description)
      ->transform(one_of(main_name(names), words))
      ->type_name(CLI::detail::join(words, "|"));
}

std::string main_name(const std::string& names) {
  const std::vector<std::string> all = CLI::detail::split(names, ',');
  for (const std::string& name : all)
    if (name.starts_with("--")) return name;
  std::string name = all.front();
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
  return name;
}

void add_threads_option(CLI::App& command, unsigned& threads, const std::string& note) {
  add_number(
      command, "--threads", threads, {0, 1024},
      "Use at most this many threads, and no more than one for each core; 0 stands for one for each core. " + note);
}

void add_report_option(CLI::App& command, std::filesystem::path& path) {
  add_value(command, "--report", path, "FILE.json",
            "Also write the facts of the summary to this file, as JSON. With - they go to standard output.");
}

void add_package_path_option(CLI::App& command, std::vector<std::filesystem::path>& folders) {
  add_value(command, "--package-path", folders, "DIR",
            "Folder in which packages of package:// are looked for. May be given several times.")
      ->allow_extra_args(false);
}

void add_examples(CLI::App& command, const std::vector<std::string>& examples) {
  std::string text = "Examples:\n";
  for (const std::string& example : examples) text += "  " + example + "\n";
  command.footer(text);
}

std::string nearest(std::string_view word, const std::vector<std::string>& words) {
  std::string best;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : words)
    if (const std::size_t far = distance(word, candidate); far < least) least = far, best = candidate;
  if (best.empty() && word.find_first_not_of('-') != std::string_view::npos)  // the beginning of only one
    if (std::ranges::count_if(words, [&](const std::string& w) { return w.starts_with(word); }) == 1)
      best = *std::ranges::find_if(words, [&](const std::string& w) { return w.starts_with(word); });
  return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& words) {
  const std::string meant = nearest(word, words);
  return meant.empty() ? "" : fmt::format("; did you mean '{}'?", meant);
}

std::string alternatives(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  return text;
}

}  // namespace prohull::cli
