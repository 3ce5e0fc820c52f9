#include <fmt/format.h>

#include <charconv>

#include "io/number_table.h"
#include "io/text_scanner.h"

namespace prohull {
namespace {

/// What stands between the numbers of the first line that has any text: a semicolon, a comma, or blanks only (0).
char separator_of(std::string_view content) {
  TextScanner scanner(content, "", {.comments = true});
  scanner.next_line();
  char separator = 0;
  for (std::string_view word = scanner.word(); !word.empty(); word = scanner.word()) {
    if (word.find(';') != std::string_view::npos) return ';';
    if (word.find(',') != std::string_view::npos) separator = ',';
  }
  return separator;
}

bool is_number(std::string_view word) {
  double value = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, value);
  return error != std::errc::invalid_argument && rest == end;
}

bool starts_like_number(std::string_view word) {
  return word.find_first_of("0123456789+-.") == 0 || is_number(word);  // "nan" is a number too
}

/// A line of words none of which starts as a number does: a row in which something is mistyped is none.
bool is_line_of_names(TextScanner line) {
  do {
    if (starts_like_number(line.word())) return false;
  } while (line.skip_separator() || !line.at_line_end());
  return true;
}

/// Goes on to the first line of numbers; false if there is none.
bool begin_numbers(TextScanner& scanner) {
  if (!scanner.next_line()) return false;
  if (!is_line_of_names(scanner)) return true;
  scanner.skip_rest_of_line();
  return scanner.next_line();
}

class CsvReader {
 public:
  CsvReader(std::string_view content, const std::string& file, const Columns& columns)
      : separator_(separator_of(content)),
        scanner_(content, file, {.comments = true, .separator = separator_, .lines_count = columns.lines_count}),
        columns_(columns),
        row_(columns.names.size()) {}

  void read(const RowSink& sink) {
    for (bool more = begin_numbers(scanner_); more; more = scanner_.next_line()) {
      read_row();
      sink(row_, scanner_.place());
    }
  }

 private:
  void read_row() {
    for (std::size_t i = 0; i < row_.size(); ++i) {
      if (i > 0 && separator_ != 0 && !scanner_.skip_separator())
        fail(fmt::format("there is no {} after {}", separator_ == ',' ? "comma" : "semicolon", columns_.names[i - 1]));
      row_[i] = scanner_.number(columns_.names[i]);
    }
    if (!scanner_.at_line_end()) fail("the line goes on after the last number");
  }

  [[noreturn]] void fail(std::string_view why) const {
    scanner_.fail(fmt::format("{}; each line has {} numbers: {}", why, row_.size(), joined(columns_.names)));
  }

  char separator_;
  TextScanner scanner_;
  const Columns& columns_;
  std::vector<double> row_;
};

}  // namespace

std::size_t numbers_per_line(std::string_view content, const std::string& file) {
  TextScanner scanner(content, file, {.comments = true, .separator = separator_of(content)});
  std::size_t numbers = 0;
  if (begin_numbers(scanner)) do {
      scanner.word(), ++numbers;
    } while (scanner.skip_separator() || !scanner.at_line_end());
  return numbers;
}

std::string joined(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text.append(text.empty() ? "" : ",").append(name);
  return text;
}

void read_csv(std::string_view content, const std::string& file, const Columns& columns, const RowSink& sink) {
  CsvReader(content, file, columns).read(sink);
}

}  // namespace prohull
