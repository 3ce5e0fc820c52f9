#pragma once

#include <string>
#include <utility>
#include <vector>

#include "robot/files/xml.h"

namespace prohull::robot {

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
