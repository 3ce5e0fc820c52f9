#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "prohull/geometry.h"

namespace prohull::robot {

/// A part of the text of a document, in bytes.
struct Span {
  std::size_t begin = 0, end = 0;
  bool operator==(const Span&) const = default;
};

/// An element of an XML document, and where it stands in its text.
struct XmlElement {
  std::string name;                                             ///< with its prefix, as "gazebo:plugin"
  std::vector<std::pair<std::string, std::string>> attributes;  ///< in the order of the text, entities resolved
  std::vector<const XmlElement*> children;
  std::string content;  ///< the text directly inside of it, entities resolved
  Span whole;           ///< from "<" of the start tag to ">" of the end tag
  Span start_tag;       ///< from "<" to ">"
  std::size_t line = 0;

  bool is_empty_tag() const { return start_tag.end == whole.end; }  ///< <name/>
  const std::string* attribute(std::string_view key) const;         ///< nullptr if there is none
  const XmlElement* child(std::string_view tag) const;              ///< the first one, nullptr if there is none
  std::vector<const XmlElement*> children_called(std::string_view tag) const;
  std::string text() const;  ///< the content without the blanks around it
};

/// Where a part of a text comes from that was put together from several files.
struct TextSource {
  std::size_t begin = 0;  ///< of the part, in bytes
  std::string file;
  std::size_t line = 1;  ///< of the file, in which the part begins
};

/// An XML document that is not changed: edits are made to its text, see with_edits.
class XmlDocument {
 public:
  /// Throws InputError(Malformed) with `file` and the line: for text that is not well-formed, for entities that the
  /// document declares itself, which can grow without bound, for elements nested more than 200 deep, and for UTF-16.
  /// `sources`, by begin: the lines of elements are then those of their own files.
  XmlDocument(std::string text, std::string file, std::vector<TextSource> sources = {});
  XmlDocument(XmlDocument&&) = default;

  const XmlElement& root() const { return elements_.front(); }
  const std::string& text() const { return text_; }
  const std::string& file() const { return file_; }
  const std::string& encoding() const { return encoding_; }  ///< as the document declares it; empty if it does not

  /// The bytes of a part of the text.
  std::string_view operator[](const Span& span) const;
  /// The blanks that the line of an element begins with, if nothing else stands before it; else "".
  std::string_view indentation(const XmlElement& element) const;

  std::string place_of(const XmlElement& element) const;  ///< "arm.urdf: line 12"
  /// For notes about this file: "line 12"; for an element of another file as place_of.
  std::string short_place_of(const XmlElement& element) const;
  /// Throws InputError(Malformed): "arm.urdf: line 12: <what>".
  [[noreturn]] void refuse(const XmlElement& element, const std::string& what) const;

  // Values. `fallback` stands for an attribute, or a child, that is not there. All throw InputError(Malformed) for
  // text that is no number, or not as many.

  const std::string& required(const XmlElement& element, std::string_view attribute) const;
  std::vector<double> numbers(const XmlElement& element, std::string_view text) const;  ///< finite, any count
  double number(const XmlElement& element, std::string_view attribute, double fallback) const;
  Vec3 vector(const XmlElement& element, std::string_view attribute, const Vec3& fallback) const;

 private:
  const std::string& file_of(const XmlElement& element) const;

  std::string text_, file_, encoding_;
  std::vector<TextSource> sources_;
  std::deque<XmlElement> elements_;  // in document order; a deque does not move them
};

struct XmlEdit {
  Span replaced;  ///< empty: an insertion
  std::string text;
  bool operator==(const XmlEdit&) const = default;
};

/// The text with all edits made, none of which overlap. Insertions at one place are made in their order.
std::string with_edits(std::string_view text, std::vector<XmlEdit> edits);

/// The text of a document with edits whose text is UTF-8. Throws InputError(Malformed) if one of them has letters
/// beyond ASCII, and the document declares another encoding.
std::string edited_text(const XmlDocument& document, std::vector<XmlEdit> edits);

/// Whether the document is UTF-8, as it says or because it says nothing.
bool is_utf8(const XmlDocument& document);

/// &, <, > and quotes as entities.
std::string xml_escaped(std::string_view text);

}  // namespace prohull::robot
