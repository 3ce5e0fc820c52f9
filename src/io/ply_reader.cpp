#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "geometry/float32.h"
#include "io/byte_cursor.h"
#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/ply_header.h"
#include "io/text_scanner.h"

namespace prohull {
namespace {

/// The record that a body is at, for messages.
struct PlyRecord {
  const PlyElement* element = nullptr;
  std::size_t number = 0;

  std::string name() const { return fmt::format("{} {} of {}", printable(element->name), number + 1, element->count); }
  std::string truncated(std::string_view where) const {
    return fmt::format("the file ends {} {}; it is truncated or its count is wrong", where, name());
  }
};

// A body hands out the values of one record after the other, in order: begin(record), then for each property
// number(type), or list_length(...) and as many integer(type), or skip(...), then end(); and last finish(). fits(...)
// bounds what is reserved.

/// Each record stands on a line of its own.
class AsciiBody {
 public:
  AsciiBody(const PlyHeader& header, const std::string& file)
      : size_(header.body.size()), scanner_(header.body, file, {}, header.first_body_line) {}

  void begin(const PlyRecord& record) {
    if (!scanner_.next_line()) scanner_.fail(record.truncated("before"));
    record_ = record;
  }
  void end() {
    if (!scanner_.at_line_end())
      scanner_.fail(
          fmt::format("{} has more values than properties; or a count in the header is wrong", record_.name()));
  }

  // What other readers store for a property of type float, and so what a hull must enclose.
  double number(NumberType type) {
    if (type != NumberType::Float32) return checked(scanner_.number("a number"), type);
    return nearest_float32(checked(scanner_.float32("a number"), type));
  }
  std::int64_t integer(NumberType type) { return checked(scanner_.integer("an integer"), type); }
  std::size_t list_length(NumberType type, NumberType) {
    const std::int64_t length = scanner_.integer("the length of a list");
    if (length < 0) scanner_.fail(fmt::format("a list has the length {}", length));
    return static_cast<std::size_t>(checked(length, type));
  }
  void skip(std::size_t count, NumberType) {
    for (; count > 0; --count)
      if (scanner_.word().empty()) scanner_.fail("the line ends before the end of the record");
  }

  /// How many records with `items` items in a list can be left, whatever the header claims.
  std::size_t fits(const PlyElement& element, std::size_t items, NumberType) const {
    return size_ / (2 * (element.properties.size() + items));
  }
  Place place() const { return scanner_.place(); }

  void finish() {
    while (scanner_.next_line()) {
      const std::string_view word = scanner_.word();
      if (word != "comment" && !word.starts_with('#'))
        scanner_.fail(
            "more follows the last record that the header tells of; a count in the header is wrong, or this line is "
            "too much");
    }
  }

 private:
  template <class Number>
  Number checked(Number value, NumberType type) const {
    if (!holds(type, static_cast<double>(value)))
      scanner_.fail(
          fmt::format("{} is beyond the range of its type; give the property a larger type in the header", value));
    return value;
  }

  std::size_t size_;
  TextScanner scanner_;
  PlyRecord record_;
};

class BinaryBody {
 public:
  BinaryBody(std::string_view content, const PlyHeader& header, const std::string& file)
      : file_(file),
        size_(content.size()),
        cursor_(content, content.size() - header.body.size(),
                header.encoding == PlyEncoding::BigEndian ? std::endian::big : std::endian::little) {}

  void begin(const PlyRecord& record) { record_ = record; }
  void end() {}
  void finish() {}

  double number(NumberType type) {
    require(1, size_of(type));
    return read_number(cursor_, type);
  }
  std::int64_t integer(NumberType type) { return static_cast<std::int64_t>(number(type)); }
  std::size_t list_length(NumberType type, NumberType item) {
    const Place place = cursor_.place();
    const std::int64_t length = integer(type);
    if (length < 0) fail(file_, place, fmt::format("a list has the length {}", length));
    require(static_cast<std::size_t>(length), size_of(item));
    return static_cast<std::size_t>(length);
  }
  void skip(std::size_t count, NumberType type) {
    require(count, size_of(type));
    cursor_.skip(count * size_of(type));
  }

  std::size_t fits(const PlyElement& element, std::size_t items, NumberType item) const {
    return cursor_.remaining() / (element.min_record_size() + items * size_of(item));
  }
  Place place() const { return cursor_.place(); }

 private:
  void require(std::size_t count, std::size_t size) const {
    if (!cursor_.has(count, size)) fail(file_, {Place::Unit::Byte, size_}, record_.truncated("within"));
  }

  const std::string& file_;
  std::size_t size_;
  ByteCursor cursor_;
  PlyRecord record_;
};

template <class Body>
class PlyReader {
 public:
  PlyReader(const PlyHeader& header, Body body, std::string_view content, const std::string& file,
            const ReadOptions& options)
      : header_(header),
        body_(std::move(body)),
        file_(file),
        builder_(file, 0, content, options),
        marks_(options.marks) {}

  TriangleMesh read() {
    for (const PlyElement& element : header_.elements) {
      if (element.count == 0 || element.properties.empty()) continue;
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_lists(element, [&](auto corners, Place place) {
          builder_.add_polygon(corners, place);
          if (has_face_colors_) marks_->face_colors.resize(builder_.triangle_count(), color_);
        });
      else if (element.name == "tristrips")
        read_lists(element, [&](auto corners, Place place) { builder_.add_triangle_strips(corners, place); });
      else
        for_each_record(
            element, [&](const PlyProperty& property, std::size_t) { skip(property); }, [](Place) {});
    }
    body_.finish();
    // Other elements may follow those with colours.
    if (has_face_colors_) marks_->face_colors.resize(builder_.triangle_count());
    if (has_vertex_colors_) marks_->vertex_colors.resize(builder_.vertex_count());
    return builder_.finish();
  }

 private:
  /// Which of its properties are red, green and blue, if they are asked for: 0 to 255, or 0 to 1 in floats.
  class ColorProperties {
   public:
    ColorProperties(const PlyElement& element, bool is_asked) {
      constexpr std::array kNames{"red", "green", "blue"};
      for (std::size_t channel = 0; is_asked && channel < 3; ++channel)
        if (const auto found = element.find(kNames[channel]); found && !element.properties[*found].count_type)
          places_[channel] = *found, ++found_;
    }
    bool all() const { return found_ == 3; }
    std::optional<std::size_t> channel_at(std::size_t i) const {
      const auto at = std::ranges::find(places_, i);
      return all() && at != places_.end() ? std::optional(static_cast<std::size_t>(at - places_.begin()))
                                          : std::nullopt;
    }

   private:
    std::array<std::size_t, 3> places_{};
    std::size_t found_ = 0;
  };

  void read_channel(std::size_t channel, NumberType type) {
    const double value = body_.number(type) * (is_integer(type) ? 1 : 255);
    const auto byte = static_cast<std::uint8_t>(std::lround(value >= 0 && value <= 255 ? value
                                                            : value > 255              ? 255
                                                                                       : 0));
    (channel == 0 ? color_.red : channel == 1 ? color_.green : color_.blue) = byte;
  }

  void read_vertices(const PlyElement& element) {
    constexpr std::size_t kNoAxis = 3;
    std::vector<std::size_t> axis_of(element.properties.size(), kNoAxis);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string_view name = std::string_view("xyz").substr(axis, 1);
      const auto found = element.find(name);
      if (!found || element.properties[*found].count_type)
        fail_on_header(element, fmt::format("element vertex has no number named {}", name));
      axis_of[*found] = axis;
    }
    builder_.reserve_vertices(std::min(element.count, body_.fits(element, 0, NumberType::Int8)));
    Vec3 position;
    const ColorProperties colors(element, marks_ != nullptr);
    has_vertex_colors_ |= colors.all();
    if (colors.all()) marks_->vertex_colors.resize(builder_.vertex_count());
    const auto read_property = [&](const PlyProperty& property, std::size_t i) {
      if (const auto channel = colors.channel_at(i))
        read_channel(*channel, property.type);
      else if (axis_of[i] == kNoAxis)
        skip(property);
      else
        position[static_cast<int>(axis_of[i])] = body_.number(property.type);
    };
    for_each_record(element, read_property, [&](Place place) {
      builder_.add_vertex(position, place);
      if (colors.all()) marks_->vertex_colors.push_back(color_);
    });
  }

  template <class Add>
  void read_lists(const PlyElement& element, Add add) {
    const auto wanted = element.find("vertex_indices") ? element.find("vertex_indices") : element.find("vertex_index");
    if (!wanted || !element.properties[*wanted].count_type || !is_integer(element.properties[*wanted].type))
      fail_on_header(element, fmt::format("element {} has no list of integers named vertex_indices", element.name));
    builder_.reserve_triangles(std::min(element.count, body_.fits(element, 3, element.properties[*wanted].type)));
    std::vector<std::int64_t> corners;
    const ColorProperties colors(element, marks_ != nullptr);
    has_face_colors_ |= colors.all();
    color_ = {};
    if (has_face_colors_) marks_->face_colors.resize(builder_.triangle_count());
    const auto read_property = [&](const PlyProperty& property, std::size_t i) {
      if (const auto channel = colors.channel_at(i)) return read_channel(*channel, property.type);
      if (i != *wanted) return skip(property);
      corners.clear();
      for (std::size_t left = body_.list_length(*property.count_type, property.type); left > 0; --left)
        corners.push_back(body_.integer(property.type));
    };
    for_each_record(element, read_property, [&](Place place) { add(corners, place); });
  }

  template <class ReadProperty, class Finish>
  void for_each_record(const PlyElement& element, ReadProperty read_property, Finish finish) {
    for (std::size_t record = 0; record < element.count; ++record) {
      body_.begin({&element, record});
      const Place place = body_.place();
      for (std::size_t i = 0; i < element.properties.size(); ++i) read_property(element.properties[i], i);
      body_.end();
      finish(place);
    }
  }

  void skip(const PlyProperty& property) {
    body_.skip(property.count_type ? body_.list_length(*property.count_type, property.type) : 1, property.type);
  }

  [[noreturn]] void fail_on_header(const PlyElement& element, std::string_view message) const {
    fail(file_, {Place::Unit::Line, element.line}, message);
  }

  const PlyHeader& header_;
  Body body_;
  const std::string& file_;
  MeshBuilder builder_;
  MeshMarks* const marks_;
  Color color_;  ///< of the record that is read
  bool has_face_colors_ = false, has_vertex_colors_ = false;
};

}  // namespace

TriangleMesh read_ply(std::string_view content, const std::string& file, const ReadOptions& options) {
  const PlyHeader header = read_ply_header(content, file);
  if (header.encoding == PlyEncoding::Ascii)
    return PlyReader(header, AsciiBody(header, file), content, file, options).read();
  return PlyReader(header, BinaryBody(content, header, file), content, file, options).read();
}

}  // namespace prohull
