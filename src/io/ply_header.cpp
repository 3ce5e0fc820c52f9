#include "io/ply_header.h"

#include <fmt/format.h>

#include "io/text_scanner.h"
#include "prohull/detail/names.h"

namespace prohull {
namespace {

constexpr std::pair<std::string_view, NumberType> kTypeNames[]{
    {"char", NumberType::Int8},      {"int8", NumberType::Int8},       {"uchar", NumberType::UInt8},
    {"uint8", NumberType::UInt8},    {"short", NumberType::Int16},     {"int16", NumberType::Int16},
    {"ushort", NumberType::UInt16},  {"uint16", NumberType::UInt16},   {"int", NumberType::Int32},
    {"int32", NumberType::Int32},    {"uint", NumberType::UInt32},     {"uint32", NumberType::UInt32},
    {"float", NumberType::Float32},  {"float32", NumberType::Float32}, {"double", NumberType::Float64},
    {"float64", NumberType::Float64}};

class HeaderReader {
 public:
  HeaderReader(std::string_view content, const std::string& file) : scanner_(content, file) {}

  PlyHeader read() {
    scanner_.next_line();
    if (scanner_.word() != "ply") scanner_.fail("the file does not start with ply");
    while (read_line()) continue;
    if (!encoding_) scanner_.fail("the header has no format");
    return {*encoding_, std::move(elements_), scanner_.rest_after_line(), scanner_.place().number + 1};
  }

 private:
  /// False for end_header.
  bool read_line() {
    if (!scanner_.next_line()) scanner_.fail("the file ends within the header; expected end_header");
    const std::string_view keyword = scanner_.word();
    if (keyword == "end_header") return false;
    if (keyword == "format")
      read_format();
    else if (keyword == "element")
      read_element();
    else if (keyword == "property")
      read_property();
    else if (keyword != "comment" && keyword != "obj_info")
      scanner_.fail(fmt::format("{} is not a line of a PLY header", in_quotes(keyword)));
    return true;
  }

  void read_format() {
    const std::string_view word = scanner_.word();
    if (word == "ascii")
      encoding_ = PlyEncoding::Ascii;
    else if (word == "binary_little_endian")
      encoding_ = PlyEncoding::LittleEndian;
    else if (word == "binary_big_endian")
      encoding_ = PlyEncoding::BigEndian;
    else
      scanner_.fail(
          fmt::format("unknown format {}; expected ascii, binary_little_endian or binary_big_endian", in_quotes(word)));
  }

  void read_element() {
    PlyElement element;
    element.name = word("the name of the element");
    element.line = scanner_.place().number;
    const std::int64_t count = scanner_.integer("the number of records of the element");
    if (count < 0) scanner_.fail(fmt::format("element {} has a negative count", in_quotes(element.name)));
    element.count = static_cast<std::size_t>(count);
    elements_.push_back(std::move(element));
  }

  void read_property() {
    if (elements_.empty()) scanner_.fail("a property before any element");
    PlyProperty property;
    std::string_view type = word("the type of the property");
    if (type == "list") {
      property.count_type = type_of(word("the type of the list's length"));
      if (!is_integer(*property.count_type)) scanner_.fail("the type of a list's length must be an integer type");
      type = word("the type of the list's items");
    }
    property.type = type_of(type);
    property.name = word("the name of the property");
    elements_.back().properties.push_back(std::move(property));
  }

  std::string_view word(std::string_view what) {
    const std::string_view found = scanner_.word();
    if (found.empty()) scanner_.fail(fmt::format("the line ends where {} was expected", what));
    return found;
  }

  NumberType type_of(std::string_view name) {
    const auto type = value_of<NumberType>(kTypeNames, name);
    if (!type) scanner_.fail(fmt::format("unknown type {}", in_quotes(name)));
    return *type;
  }

  TextScanner scanner_;
  std::optional<PlyEncoding> encoding_;
  std::vector<PlyElement> elements_;
};

}  // namespace

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property) return i;
  return {};
}

std::size_t PlyElement::min_record_size() const {
  std::size_t size = 0;
  for (const PlyProperty& p : properties) size += size_of(p.count_type.value_or(p.type));
  return size;
}

PlyHeader read_ply_header(std::string_view content, const std::string& file) {
  return HeaderReader(content, file).read();
}

}  // namespace prohull
