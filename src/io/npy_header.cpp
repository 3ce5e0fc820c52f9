#include "io/npy_header.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <optional>

#include "io/append.h"
#include "io/byte_cursor.h"
#include "io/place.h"

namespace prohull {
namespace {

/// Reads the text of a header, a Python dictionary: {'descr': '<f8', 'fortran_order': False, 'shape': (10, 6), }
class DictionaryParser {
 public:
  DictionaryParser(std::string_view content, std::size_t begin, std::size_t end, const std::string& file)
      : content_(content.substr(0, end)), file_(file), at_(begin) {}

  NpyHeader parse() {
    expect('{');
    while (!accept('}')) {
      read_entry();
      if (accept(',')) continue;
      expect('}');
      break;
    }
    if (!type_ || !fortran_order_ || !shape_) fail("the header lacks descr, fortran_order or shape");
    return {*type_, *fortran_order_, *shape_, content_.size()};
  }

 private:
  void read_entry() {
    const std::string_view key = text();
    expect(':');
    if (key == "descr")
      type_ = type();
    else if (key == "fortran_order")
      fortran_order_ = boolean();
    else if (key == "shape")
      shape_ = tuple();
    else
      fail(fmt::format("the header has an entry {}, which is not known", in_quotes(key)));
  }

  std::string type() {
    if (next() == '[') fail("its elements have several fields; save one array of plain numbers");
    return std::string(text());
  }

  std::string_view text() {
    const char quote = next();
    if (quote != '\'' && quote != '"') fail("the header is damaged: a text in quotes was expected");
    const std::size_t begin = at_ + 1, end = content_.find(quote, begin);
    if (end == std::string_view::npos) fail("the header is damaged: a quote is missing");
    at_ = end + 1;
    return content_.substr(begin, end - begin);
  }

  bool boolean() {
    skip_blanks();
    for (const auto& [word, value] : {std::pair{std::string_view("True"), true}, {std::string_view("False"), false}})
      if (content_.substr(at_).starts_with(word)) {
        at_ += word.size();
        return value;
      }
    fail("the header is damaged: True or False was expected");
  }

  std::vector<std::size_t> tuple() {
    std::vector<std::size_t> items;
    expect('(');
    while (!accept(')')) {
      items.push_back(integer());
      if (accept(',')) continue;
      expect(')');
      break;
    }
    return items;
  }

  std::size_t integer() {
    skip_blanks();
    std::size_t value = 0;
    const char* const begin = content_.data() + at_;
    const auto [end, error] = std::from_chars(begin, content_.data() + content_.size(), value);
    if (error != std::errc()) fail("the header is damaged: a count below 2^64 was expected");
    at_ += static_cast<std::size_t>(end - begin);
    accept('L');  // Python 2
    return value;
  }

  void skip_blanks() {
    constexpr std::string_view kBlanks = " \t\r\n";
    while (at_ < content_.size() && kBlanks.find(content_[at_]) != std::string_view::npos) ++at_;
  }

  char next() {
    skip_blanks();
    return at_ < content_.size() ? content_[at_] : '\0';
  }

  bool accept(char c) {
    if (next() != c || at_ == content_.size()) return false;
    ++at_;
    return true;
  }

  void expect(char c) {
    if (!accept(c)) fail(fmt::format("the header is damaged: '{}' was expected", c));
  }

  [[noreturn]] void fail(std::string_view message) const { prohull::fail(file_, {Place::Unit::Byte, at_}, message); }

  std::string_view content_;
  const std::string& file_;
  std::size_t at_;
  std::optional<std::string> type_;
  std::optional<bool> fortran_order_;
  std::optional<std::vector<std::size_t>> shape_;
};

}  // namespace

NpyHeader read_npy_header(std::string_view content, const std::string& file) {
  ByteCursor cursor(content, 0);
  const auto fail_here = [&](std::string_view message, Defect defect = Defect::Malformed) {
    fail(file, cursor.place(), message, defect);
  };
  if (!content.starts_with(kNpyMagic)) fail_here("this is no .npy file: it does not start with \\x93NUMPY");
  cursor.skip(kNpyMagic.size());
  constexpr std::size_t kVersionAndShortestLength = 4;
  if (!cursor.has(kVersionAndShortestLength, 1)) fail_here("the file ends within its header");
  const unsigned major = cursor.read<std::uint8_t>(), minor = cursor.read<std::uint8_t>();
  if (major < 1 || major > 3 || minor != 0)
    fail_here(
        fmt::format("version {}.{} of the format; versions 1 to 3 are read: save it with another numpy", major, minor),
        Defect::UnknownFormat);
  if (major > 1 && !cursor.has(1, sizeof(std::uint32_t))) fail_here("the file ends within its header");
  const std::size_t length = major == 1 ? cursor.read<std::uint16_t>() : cursor.read<std::uint32_t>();
  if (!cursor.has(length, 1)) fail_here("the file ends within its header; it is truncated");
  const std::size_t begin = cursor.place().number;
  return DictionaryParser(content, begin, begin + length, file).parse();
}

std::string shape_text(const std::vector<std::size_t>& shape) {
  return fmt::format("({}{})", fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
}

std::string npy_header(std::string_view type, const std::vector<std::size_t>& shape) {
  constexpr std::size_t kFixed = 10, kAlignment = 64;  // magic, version and length; of the numbers behind the header
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, shape_text(shape));
  const std::size_t unpadded = kFixed + text.size() + 1;
  text.append((kAlignment - unpadded % kAlignment) % kAlignment, ' ');
  text += '\n';
  std::string header = std::string(kNpyMagic) + '\x01' + '\0';
  append_bytes(header, static_cast<std::uint16_t>(text.size()));
  return header + text;
}

}  // namespace prohull
