#include "robot/files/xml_lines.h"

#include <algorithm>

namespace prohull::robot {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::size_t kNone = std::string::npos;

/// The lines of a text, by the places where they begin.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}

  std::size_t blanks_before(std::size_t at) const {
    while (at > 0 && (text_[at - 1] == ' ' || text_[at - 1] == '\t')) --at;
    return at;
  }
  std::size_t blanks_after(std::size_t at) const { return std::min(text_.find_first_not_of(" \t", at), text_.size()); }

  bool begin_with(std::size_t at) const {
    const std::size_t begin = blanks_before(at);
    return begin == 0 || text_[begin - 1] == '\n';
  }

  /// Where the next line begins, if only blanks are between here and the end of the line.
  std::size_t next(std::size_t at) const {
    at = blanks_after(at);
    if (text_.substr(at).starts_with("\r\n")) return at + 2;
    return text_.substr(at).starts_with('\n') ? at + 1 : kNone;
  }

  /// Where the line above begins, if it is blank; `at` is the begin of a line.
  std::size_t blank_above(std::size_t at) const {
    if (at == 0) return kNone;
    std::size_t end = at - 1;
    if (end > 0 && text_[end - 1] == '\r') --end;
    const std::size_t begin = blanks_before(end);
    return begin == 0 || text_[begin - 1] == '\n' ? begin : kNone;
  }

 private:
  std::string_view text_;
};

}  // namespace

bool begins_line(const XmlDocument& document, const XmlElement& element) {
  return Lines(document.text()).begin_with(element.whole.begin);
}

Span lines_of(const XmlDocument& document, const XmlElement& element) {
  const Lines lines(document.text());
  Span span = element.whole;
  const std::size_t next = lines.next(span.end);
  if (!lines.begin_with(span.begin) || next == kNone) return span;
  span = {lines.blanks_before(span.begin), next};
  const std::string_view below = std::string_view(document.text()).substr(lines.blanks_after(next));
  const bool is_last = lines.next(next) != kNone || below.starts_with("</");
  const std::size_t above = lines.blank_above(span.begin);
  if (is_last && above != kNone) span.begin = above;
  return span;
}

std::string line_end(const XmlDocument& document) {
  const std::size_t at = document.text().find('\n');
  return at != std::string::npos && at > 0 && document.text()[at - 1] == '\r' ? "\r\n" : "\n";
}

std::size_t end_tag_begin(const XmlDocument& document, const XmlElement& element) {
  return document.text().rfind("</", element.whole.end - 1);
}

Span value_span(const XmlDocument& document, const XmlElement& element, std::string_view attribute) {
  const std::string_view tag = document[element.start_tag];
  for (std::size_t at = 1 + element.name.size(); at < tag.size();) {
    const std::size_t name = tag.find_first_not_of(kBlanks, at);
    const std::size_t name_end = tag.find_first_of(" \t\r\n=", name);
    const std::size_t quote = tag.find_first_of("\"'", name_end);
    const std::size_t end = tag.find(tag[quote], quote + 1);
    if (tag.substr(name, name_end - name) == attribute)
      return {element.start_tag.begin + quote + 1, element.start_tag.begin + end};
    at = end + 1;
  }
  return {};
}

Span attribute_span(const XmlDocument& document, const XmlElement& element, std::string_view attribute) {
  const Span value = value_span(document, element, attribute);
  const std::string_view text = document.text();
  const std::size_t name = text.rfind(attribute, value.begin - 1);
  return {text.find_last_not_of(kBlanks, name - 1) + 1, value.end + 1};
}

std::string edited_part(const XmlDocument& document, const Span& part, const std::vector<XmlEdit>& edits) {
  std::vector<XmlEdit> inside;
  auto edit = std::ranges::lower_bound(edits, part.begin, {}, [](const XmlEdit& e) { return e.replaced.begin; });
  for (; edit != edits.end() && edit->replaced.end <= part.end; ++edit)
    inside.push_back({{edit->replaced.begin - part.begin, edit->replaced.end - part.begin}, edit->text});
  return with_edits(document[part], std::move(inside));
}

std::vector<XmlEdit> outside_of(std::vector<XmlEdit> edits, const std::vector<XmlEdit>& others) {
  std::vector<Span> removed;
  for (const XmlEdit& other : others)
    if (other.replaced.begin < other.replaced.end) removed.push_back(other.replaced);
  std::ranges::sort(removed, {}, &Span::begin);
  std::erase_if(edits, [&](const XmlEdit& edit) {
    const auto after = std::ranges::upper_bound(removed, edit.replaced.begin, {}, &Span::begin);
    return after != removed.begin() && edit.replaced.end <= std::prev(after)->end;
  });
  return edits;
}

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
