#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

const char* end_of_digits(const char* at, const char* last) { return std::find_if_not(at, last, is_digit); }

/// What follows `at`, whatever the case; nullptr if it is not `word`.
const char* end_of_word(const char* at, const char* last, std::string_view word) {
  const bool is_there = last - at >= static_cast<std::ptrdiff_t>(word.size()) &&
                        std::equal(word.begin(), word.end(), at, [](char a, char b) { return a == (b | 0x20); });
  return is_there ? at + word.size() : nullptr;
}

/// Where the number ends that starts at `at`, behind its sign; `at` if there is none.
const char* end_of_number(const char* at, const char* last) {
  for (const std::string_view word : {"infinity", "inf", "nan"})
    if (const char* const end = end_of_word(at, last, word)) return end;
  const char* end = end_of_digits(at, last);
  std::ptrdiff_t digits = end - at;
  if (end != last && *end == '.') {
    const char* const rest = end_of_digits(end + 1, last);
    digits += rest - (end + 1), end = rest;
  }
  if (digits == 0) return at;
  if (end == last || (*end | 0x20) != 'e') return end;
  const char* const exponent = end + 1 != last && (end[1] == '+' || end[1] == '-') ? end + 2 : end + 1;
  return exponent != last && is_digit(*exponent) ? end_of_digits(exponent, last) : end;
}

/// "1.25e-07" from the digits "125" and the power of ten of the first one.
std::string scientific(std::string_view digits, int exponent) {
  std::string text(1, digits[0]);
  if (digits.size() > 1) text.append(1, '.').append(digits.substr(1));
  return text + fmt::format("e{}{:02}", exponent < 0 ? '-' : '+', std::abs(exponent));
}

/// "0.000000125"
std::string fixed(std::string_view digits, int exponent, double magnitude) {
  const int count = static_cast<int>(digits.size());
  if (exponent < 0) return "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0').append(digits);
  if (exponent >= count - 1) return fmt::format("{:.0f}", magnitude);
  const auto whole = static_cast<std::size_t>(exponent + 1);
  return std::string(digits.substr(0, whole)).append(1, '.').append(digits.substr(whole));
}

/// The shorter of the two; of two that are equally long the fixed one.
std::string shortest(double magnitude) {
  if (magnitude == 0) return "0";
  std::string digits;
  int exponent = 0;
  const std::string text = fmt::format("{}", magnitude);  // the fewest digits that read back as the same number
  const std::size_t e = std::min(text.find('e'), text.size()), point = std::min(text.find('.'), e);
  if (e < text.size()) exponent = std::atoi(text.c_str() + e + 1);
  for (std::size_t i = 0; i < e; ++i)
    if (text[i] != '.') digits += text[i];
  exponent += static_cast<int>(point) - 1;
  const std::size_t zeros = digits.find_first_not_of('0');
  digits.erase(0, zeros), exponent -= static_cast<int>(zeros);
  digits.erase(digits.find_last_not_of('0') + 1);
  const std::string one = fixed(digits, exponent, magnitude), other = scientific(digits, exponent);
  return one.size() <= other.size() ? one : other;
}

/// musl's `read`, which is strtod or strtof, rounds correctly.
template <class Number>
std::from_chars_result number_of(const char* first, const char* last, Number& value,
                                 Number (*read)(const char*, char**)) {
  const bool is_negative = first != last && *first == '-';
  const char* const begin = first + is_negative;
  const char* const end = end_of_number(begin, last);
  if (end == begin) return {first, std::errc::invalid_argument};
  const Number magnitude = read(std::string(begin, end).c_str(), nullptr);
  const bool has_digit = is_digit(*begin) || *begin == '.';
  const bool is_zero = std::all_of(begin, std::find_if(begin, end, [](char c) { return (c | 0x20) == 'e'; }),
                                   [](char c) { return c == '0' || c == '.'; });
  if (has_digit && (std::isinf(magnitude) || (magnitude == 0 && !is_zero)))
    return {end, std::errc::result_out_of_range};
  value = is_negative ? -magnitude : magnitude;
  return {end, std::errc()};
}

}  // namespace

std::from_chars_result std::from_chars(const char* first, const char* last, double& value) {
  return number_of(first, last, value, strtod);
}

std::from_chars_result std::from_chars(const char* first, const char* last, float& value) {
  return number_of(first, last, value, strtof);
}

std::to_chars_result std::to_chars(char* first, char* last, double value) {
  string text = isfinite(value) ? shortest(fabs(value)) : isnan(value) ? "nan" : "inf";
  if (signbit(value)) text.insert(0, 1, '-');
  if (last - first < static_cast<ptrdiff_t>(text.size())) return {last, errc::value_too_large};
  return {copy(text.begin(), text.end(), first), errc()};
}
