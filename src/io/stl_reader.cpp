#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/byte_cursor.h"
#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/text_scanner.h"
#include "io/vertex_welder.h"
#include "prohull/detail/text.h"

namespace prohull {
namespace {

constexpr std::size_t kHeaderSize = 84, kTriangleSize = 50;

bool starts_with_word(std::string_view text, std::string_view lower_case) {
  const auto equal = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; };
  return text.size() >= lower_case.size() &&
         std::equal(lower_case.begin(), lower_case.end(), text.begin(), [&](char b, char a) { return equal(a, b); });
}

bool is_word(std::string_view word, std::string_view lower_case) {
  return word.size() == lower_case.size() && starts_with_word(word, lower_case);
}

std::size_t claimed_triangles(std::string_view content) {
  return ByteCursor(content, kHeaderSize - 4).read<std::uint32_t>();
}

/// Makes triangles of loose corners.
class StlSoup {
 public:
  StlSoup(std::string_view content, const std::string& file, const ReadOptions& options)
      : builder_(file, 1, content, options), welder_(builder_.positions()) {}

  void reserve(std::size_t triangles) { builder_.reserve_triangles(triangles); }

  void add_triangle(const std::array<Vec3, 3>& corners, Place place) {
    std::array<std::int64_t, 3> numbers;
    ++count_;
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3 corner = corners[i];
      if (!is_finite(corner)) {
        builder_.refuse_non_finite(corner, fmt::format("corner {} of triangle {}", i + 1, count_), place);
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        corner = {kInfinity, kInfinity, kInfinity};  // one vertex: NaN is not equal to itself
      }
      numbers[i] = welder_.number_of(corner);
      if (static_cast<std::size_t>(numbers[i]) == builder_.vertex_count()) builder_.add_vertex(corner, place);
    }
    builder_.add_polygon(numbers, place);
  }

  TriangleMesh finish() { return builder_.finish(); }

 private:
  MeshBuilder builder_;
  VertexWelder welder_;
  std::size_t count_ = 0;
};

TriangleMesh read_binary(std::string_view content, const std::string& file, const ReadOptions& options) {
  ByteCursor cursor(content, kHeaderSize);
  const std::size_t count = claimed_triangles(content);
  StlSoup soup(content, file, options);
  soup.reserve(std::min(count, content.size() / kTriangleSize));
  for (std::size_t i = 0; i < count; ++i) {
    const Place place = cursor.place();
    if (!cursor.has(1, kTriangleSize))
      fail(file, {Place::Unit::Byte, content.size()},
           fmt::format("the file ends within triangle {} of {}; it is truncated or its count is wrong", i + 1, count));
    cursor.skip(3 * sizeof(float));  // the normal
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners)
      for (int axis = 0; axis < 3; ++axis) corner[axis] = cursor.read<float>();
    cursor.skip(sizeof(std::uint16_t));
    soup.add_triangle(corners, place);
  }
  if (const std::size_t more = cursor.remaining() / kTriangleSize; more > 0)
    fail(file, {Place::Unit::Byte, kHeaderSize - 4},
         fmt::format("the count says {}, but the file holds {}; correct it, or export the mesh again",
                     counted(count, "triangle"), count + more));
  return soup.finish();
}

class AsciiStlReader {
 public:
  AsciiStlReader(std::string_view content, const std::string& file, const ReadOptions& options)
      : scanner_(content, file), soup_(content, file, options) {}

  TriangleMesh read() {
    scanner_.next_line();
    expect("solid");
    do {
      const bool is_on_one_line = name_precedes_facet();
      if (is_on_one_line) read_facet();
      read_solid();
      skip_name(is_on_one_line);
    } while (is_word(scanner_.word_of_any_line(), "solid"));
    return soup_.finish();
  }

 private:
  /// Goes on to the end of the line, or behind the word "facet" if a facet begins on it.
  bool name_precedes_facet() {
    for (std::string_view word = scanner_.word(); !word.empty(); word = scanner_.word()) {
      if (!is_word(word, "facet")) continue;
      TextScanner next = scanner_;
      if (is_word(next.word(), "normal")) return true;
    }
    return false;
  }

  /// Skips the name behind "endsolid". Another solid may follow on its line.
  void skip_name(bool is_on_one_line) {
    if (!is_on_one_line) return scanner_.skip_rest_of_line();
    for (TextScanner next = scanner_; !scanner_.at_line_end() && !is_word(next.word(), "solid");) scanner_ = next;
  }

  void read_solid() {
    while (true) {
      const std::string_view word = scanner_.word_of_any_line();
      if (is_word(word, "endsolid")) return;
      if (!is_word(word, "facet")) fail_expecting("facet or endsolid", word);
      read_facet();
    }
  }

  void read_facet() {
    const Place place = scanner_.place();
    expect("normal");
    for (int axis = 0; axis < 3; ++axis) scanner_.word_of_any_line();
    expect("outer");
    expect("loop");
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners) {
      expect("vertex");
      for (int axis = 0; axis < 3; ++axis) corner[axis] = scanner_.number("a coordinate");
    }
    expect("endloop");
    expect("endfacet");
    soup_.add_triangle(corners, place);
  }

  void expect(std::string_view keyword) {
    const std::string_view word = scanner_.word_of_any_line();
    if (!is_word(word, keyword)) fail_expecting(keyword, word);
  }

  [[noreturn]] void fail_expecting(std::string_view keyword, std::string_view word) {
    if (word.empty()) scanner_.fail(fmt::format("the file ends where {} was expected; it is truncated", keyword));
    scanner_.fail(fmt::format("{} where {} was expected", in_quotes(word), keyword));
  }

  TextScanner scanner_;
  StlSoup soup_;
};

}  // namespace

bool is_binary_stl(std::string_view content) {
  return content.size() >= kHeaderSize && content.size() - kHeaderSize == claimed_triangles(content) * kTriangleSize;
}

bool is_ascii_stl(std::string_view content) {
  constexpr std::size_t kLookedAt = 1024;
  const std::string_view start =
      content.substr(std::min(content.size(), content.find_first_not_of(" \t\r\n\xEF\xBB\xBF")));
  return starts_with_word(start, "solid") && !is_binary_stl(content) &&
         content.substr(0, kLookedAt).find('\0') == std::string_view::npos;
}

TriangleMesh read_stl(std::string_view content, const std::string& file, const ReadOptions& options) {
  if (is_ascii_stl(content)) return AsciiStlReader(content, file, options).read();
  if (content.size() < kHeaderSize)
    fail(file, {Place::Unit::Byte, content.size()},
         "the file ends within the header; a binary STL has 84 bytes of it, and an ascii STL starts with solid");
  return read_binary(content, file, options);
}

}  // namespace prohull
