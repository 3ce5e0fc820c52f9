#include "robot/files/merged_text.h"

#include <algorithm>

#include "robot/files/xml_lines.h"

namespace prohull::robot {

void MergedText::add(const XmlDocument& document, const Span& part) {
  const std::string_view before = document[{0, part.begin}];
  const auto lines = static_cast<std::size_t>(std::ranges::count(before, '\n'));
  sources_.push_back({text_.size(), document.file(), 1 + lines});
  text_ += document[part];
}

Span inside_of(const XmlDocument& document, const XmlElement& element) {
  if (element.is_empty_tag()) return {element.whole.end, element.whole.end};
  return {element.start_tag.end, end_tag_begin(document, element)};
}

bool has_encoding_of(const XmlDocument& a, const XmlDocument& b) {
  const auto is_plain = [](const XmlDocument& document) {
    return std::ranges::all_of(document.text(), [](unsigned char c) { return c < 0x80; });
  };
  return a.encoding() == b.encoding() || (is_plain(a) && is_plain(b)) || (is_utf8(a) && is_utf8(b));
}

}  // namespace prohull::robot
