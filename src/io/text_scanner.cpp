#include "io/text_scanner.h"

#include <fmt/format.h>

#include <charconv>
#include <cstring>
#include <system_error>
#include <utility>

namespace prohull {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

}  // namespace

TextScanner::TextScanner(std::string_view text, std::string file, TextSyntax syntax, std::size_t first_line)
    : file_(std::move(file)), syntax_(syntax), line_(first_line) {
  text = without_byte_order_mark(text);
  at_ = text.data();
  end_ = at_ + text.size();
}

const char* TextScanner::line_end() const {
  if (at_ == end_) return end_;
  const void* found = std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_));
  return found ? static_cast<const char*>(found) : end_;
}

bool TextScanner::next_line() {
  if (started_) {
    at_ = line_end();
    if (at_ != end_) ++at_, ++line_;
  }
  started_ = true;
  while (at_line_end()) {
    if (at_ == end_) return false;
    ++at_, ++line_;
  }
  return true;
}

/// Joins this line with the next if it ends here with a backslash.
bool TextScanner::skip_continuation() {
  if (!syntax_.continued_lines || at_ == end_ || *at_ != '\\') return false;
  const char* next = at_ + 1;
  while (next != end_ && is_blank(*next)) ++next;
  if (next == end_ || *next != '\n') return false;
  at_ = next + 1;
  ++line_;
  return true;
}

void TextScanner::skip_blanks() {
  do {
    while (at_ != end_ && is_blank(*at_)) ++at_;
  } while (skip_continuation());
  if (syntax_.comments && at_ != end_ && *at_ == '#') at_ = line_end();
}

bool TextScanner::at_line_end() {
  skip_blanks();
  return at_ == end_ || *at_ == '\n';
}

bool TextScanner::ends_word(const char* p) const {
  return p == end_ || *p == '\n' || is_blank(*p) || (syntax_.continued_lines && *p == '\\') || is_separator(*p);
}

std::string_view TextScanner::word() {
  if (at_line_end()) return {};
  const char* begin = at_++;
  if (!is_separator(*begin))
    while (!ends_word(at_)) ++at_;
  return {begin, static_cast<std::size_t>(at_ - begin)};
}

std::string_view TextScanner::word_of_any_line() {
  if (at_line_end()) next_line();
  return word();
}

bool TextScanner::skip_separator() {
  if (at_line_end() || !is_separator(*at_)) return false;
  ++at_;
  return true;
}

template <class Number>
Number TextScanner::parse(std::string_view what, std::string_view kind) {
  if (at_line_end()) fail(fmt::format("the line ends where {} was expected", what));
  const char* begin = at_;
  if (*begin == '+' && begin + 1 != end_ && begin[1] != '-') ++begin;
  Number value{};
  const auto [end, error] = std::from_chars(begin, end_, value);
  if (error == std::errc() && ends_word(end)) {
    at_ = end;
    return value;
  }
  const std::string text = in_quotes(word());
  if (error == std::errc::result_out_of_range) fail(fmt::format("{} is beyond the range of {} in 64 bits", text, kind));
  fail(fmt::format("{} is not {}; expected {}", text, kind, what));
}

double TextScanner::number(std::string_view what) { return parse<double>(what, "a number"); }

double TextScanner::float32(std::string_view what) {
  at_line_end();
  const char* const begin = at_;
  const double value = number(what);
  float nearest = 0;
  const bool is_in_range = std::from_chars(begin + (*begin == '+'), at_, nearest).ec == std::errc();
  return is_in_range ? nearest : value;
}

std::int64_t TextScanner::integer(std::string_view what) { return parse<std::int64_t>(what, "an integer"); }

}  // namespace prohull
