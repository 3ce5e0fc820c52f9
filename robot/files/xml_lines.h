#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "robot/files/xml.h"

namespace prohull::robot {

/// Whether only blanks stand before the element on its line.
bool begins_line(const XmlDocument& document, const XmlElement& element);

/// What to remove so that an element leaves no blank line: the element with its line, and with the blank line above if
/// another one, or the end of the parent, follows. The element alone, if something else stands on its line.
Span lines_of(const XmlDocument& document, const XmlElement& element);

/// How the first line of the text ends: "\r\n" or "\n".
std::string line_end(const XmlDocument& document);

/// Where the end tag of an element begins. The element must have one.
std::size_t end_tag_begin(const XmlDocument& document, const XmlElement& element);

/// The value of an attribute in the text, without its quotes. The element has the attribute.
Span value_span(const XmlDocument& document, const XmlElement& element, std::string_view attribute);

/// An attribute in the text, with the blanks before it. The element has the attribute.
Span attribute_span(const XmlDocument& document, const XmlElement& element, std::string_view attribute);

/// The bytes of a part of the text with those edits made that lie within it. The edits are in the order of the text.
std::string edited_part(const XmlDocument& document, const Span& part, const std::vector<XmlEdit>& edits);

/// The edits without those that lie within what other edits replace.
std::vector<XmlEdit> outside_of(std::vector<XmlEdit> edits, const std::vector<XmlEdit>& others);

/// A document that is put together from parts of others. Its elements have the lines of their own files.
class MergedText {
 public:
  void add(const XmlDocument& document, const Span& part);
  void add(std::string_view text) { text_ += text; }
  std::size_t size() const { return text_.size(); }
  XmlDocument document(const std::string& file) && { return {std::move(text_), file, std::move(sources_)}; }

 private:
  std::string text_;
  std::vector<TextSource> sources_;
};

/// What stands between the tags of an element.
Span inside_of(const XmlDocument& document, const XmlElement& element);

/// Whether bytes of one document may stand in the other.
bool has_encoding_of(const XmlDocument& a, const XmlDocument& b);

}  // namespace prohull::robot
