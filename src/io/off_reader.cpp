#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/text_scanner.h"

namespace prohull {
namespace {

class OffReader {
 public:
  OffReader(std::string_view content, const std::string& file, const ReadOptions& options)
      : size_(content.size()), scanner_(content, file, {.comments = true}), builder_(file, 0, content, options) {}

  TriangleMesh read() {
    read_keyword();
    const std::size_t vertices = read_count("the number of vertices"), faces = read_count("the number of faces");
    builder_.reserve_vertices(std::min(vertices, size_ / kShortestRecord));
    builder_.reserve_triangles(std::min(faces, size_ / kShortestRecord));
    for (std::size_t i = 0; i < vertices; ++i) read_vertex(i, vertices);
    for (std::size_t i = 0; i < faces; ++i) read_face(i, faces);
    if (scanner_.next_line())
      scanner_.fail(fmt::format(
          "more follows the last face of {}; the number of vertices or faces is wrong, or this line is too much",
          faces));
    return builder_.finish();
  }

 private:
  static constexpr std::size_t kShortestRecord = 6;  // "0 0 0\n"

  void read_keyword() {
    scanner_.next_line();
    const std::string_view keyword = scanner_.word();
    if (!is_off_keyword(keyword))
      scanner_.fail(fmt::format("the file starts with {}; expected OFF", in_quotes(keyword)));
    if (keyword.find_first_of("4n") != std::string_view::npos)
      scanner_.fail(fmt::format("{} has other than three coordinates; only three are read", in_quotes(keyword)));
    if (scanner_.at_line_end()) scanner_.next_line();
  }

  std::size_t read_count(std::string_view what) {
    const std::int64_t count = scanner_.integer(what);
    if (count < 0) scanner_.fail(fmt::format("{} is negative", what));
    return static_cast<std::size_t>(count);
  }

  /// Colours and whatever else follows on the line are skipped.
  void read_vertex(std::size_t i, std::size_t count) {
    next_record("vertex", i, count);
    Vec3 position;
    for (int axis = 0; axis < 3; ++axis) position[axis] = scanner_.number("a coordinate");
    builder_.add_vertex(position, scanner_.place());
  }

  void read_face(std::size_t i, std::size_t count) {
    next_record("face", i, count);
    corners_.clear();
    for (std::int64_t left = scanner_.integer("the number of corners"); left > 0; --left)
      corners_.push_back(scanner_.integer("a vertex number"));
    builder_.add_polygon(corners_, scanner_.place());
  }

  void next_record(std::string_view kind, std::size_t i, std::size_t count) {
    if (!scanner_.next_line())
      scanner_.fail(
          fmt::format("the file ends before {} {} of {}; it is truncated or its count is wrong", kind, i + 1, count));
  }

  std::size_t size_;
  TextScanner scanner_;
  MeshBuilder builder_;
  std::vector<std::int64_t> corners_;
};

}  // namespace

bool is_off_keyword(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N", "4", "n"})
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  return word == "OFF";
}

TriangleMesh read_off(std::string_view content, const std::string& file, const ReadOptions& options) {
  return OffReader(content, file, options).read();
}

}  // namespace prohull
