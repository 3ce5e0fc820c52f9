#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/place.h"

namespace prohull {

/// What a text format adds to words separated by blanks.
struct TextSyntax {
  bool comments = false;         ///< from a '#' that starts a word to the end of the line
  bool continued_lines = false;  ///< a backslash at the end of a line joins it with the next
  char separator = 0;            ///< also ends words, if it is not 0
  bool lines_count = true;       ///< whether messages say the line
};

/// Walks through a text in memory, word by word and line by line, and knows where it is. Lines end with LF or CR LF; a
/// byte order mark is skipped. Numbers do not depend on the locale, and doubles are the nearest to the decimals
/// written.
class TextScanner {
 public:
  /// `text` must outlive the scanner. `next_line` comes first.
  TextScanner(std::string_view text, std::string file, TextSyntax syntax = {}, std::size_t first_line = 1);

  /// Goes on to the next line that has a word; false at the end of the text.
  bool next_line();
  bool at_line_end();
  /// The next word of this line; empty at its end.
  std::string_view word();
  /// The next word of this or a later line; empty at the end of the text.
  std::string_view word_of_any_line();
  /// Whether the separator comes next on this line; goes on behind it.
  bool skip_separator();
  void skip_rest_of_line() { at_ = line_end(); }
  std::string_view rest_of_line() const { return {at_, static_cast<std::size_t>(line_end() - at_)}; }
  /// The text from the start of the next line on.
  std::string_view rest_after_line() const {
    const char* begin = line_end();
    if (begin != end_) ++begin;
    return {begin, static_cast<std::size_t>(end_ - begin)};
  }

  /// The next word of this line as a number; `what` says in the message what was expected: "a coordinate".
  double number(std::string_view what);
  /// The float32 nearest to the decimals, which is not always that nearest to their double; beyond its range, `number`.
  double float32(std::string_view what);
  std::int64_t integer(std::string_view what);

  Place place() const { return {syntax_.lines_count ? Place::Unit::Line : Place::Unit::None, line_}; }
  const std::string& file() const { return file_; }
  [[noreturn]] void fail(std::string_view message) const { prohull::fail(file_, place(), message); }

 private:
  void skip_blanks();
  bool skip_continuation();
  bool is_separator(char c) const { return syntax_.separator != 0 && c == syntax_.separator; }
  bool ends_word(const char* p) const;
  const char* line_end() const;
  template <class Number>
  Number parse(std::string_view what, std::string_view kind);

  const char* at_;
  const char* end_;
  std::string file_;
  TextSyntax syntax_;
  std::size_t line_;
  bool started_ = false;
};

}  // namespace prohull
