#include "robot/files/xml.h"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>

#include "prohull/detail/extension.h"
#include "prohull/error.h"

namespace prohull::robot {
namespace {

constexpr std::size_t kMostDepth = 200;
constexpr std::string_view kBlanks = " \t\r\n";

[[noreturn]] void refuse_line(const std::string& file, std::size_t line, const std::string& what) {
  throw InputError(Defect::Malformed, fmt::format("{}: line {}: {}", file, line, what));
}

bool is_ascii(std::string_view text) {
  return std::ranges::all_of(text, [](unsigned char c) { return c < 0x80; });
}

/// Fills the elements of a document while expat reads its text. Errors wait until expat, which is C, has returned.
class Reader {
 public:
  Reader(const std::string& text, const std::string& file, std::string& encoding, std::deque<XmlElement>& elements)
      : text_(text),
        file_(file),
        encoding_(encoding),
        elements_(elements),
        skipped_(blanks_before_declaration(text)),
        skipped_lines_(std::ranges::count(std::string_view(text).substr(0, skipped_), '\n')),
        parser_(XML_ParserCreate(nullptr), XML_ParserFree) {
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), on_start, on_end);
    XML_SetCharacterDataHandler(parser_.get(), on_text);
    XML_SetEntityDeclHandler(parser_.get(), on_entity);
    XML_SetXmlDeclHandler(parser_.get(), on_declaration);
  }

  void read() {
    if (text_.size() > std::size_t(std::numeric_limits<int>::max()))
      throw InputError(Defect::Malformed, fmt::format("{}: too large for a robot: more than 2 GiB", file_));
    const char* const begin = text_.data() + skipped_;
    const XML_Status status = XML_Parse(parser_.get(), begin, static_cast<int>(text_.size() - skipped_), XML_TRUE);
    if (!problem_.empty()) refuse_line(file_, problem_line_, problem_);
    if (status != XML_STATUS_OK) refuse_line(file_, line(), fmt::format("no XML: {}", what_is_wrong()));
  }

 private:
  static Reader& self(void* data) { return *static_cast<Reader*>(data); }
  static void XMLCALL on_start(void* data, const XML_Char* name, const XML_Char** attributes) {
    self(data).start(name, attributes);
  }
  static void XMLCALL on_end(void* data, const XML_Char*) { self(data).end(); }
  static void XMLCALL on_text(void* data, const XML_Char* text, int length) {
    Reader& reader = self(data);
    if (!reader.open_.empty()) reader.open_.back()->content.append(text, static_cast<std::size_t>(length));
  }
  static void XMLCALL on_declaration(void* data, const XML_Char*, const XML_Char* encoding, int) {
    if (encoding) self(data).encoding_ = encoding;
  }
  static void XMLCALL on_entity(void* data, const XML_Char* name, int, const XML_Char*, int, const XML_Char*,
                                const XML_Char*, const XML_Char*, const XML_Char*) {
    self(data).stop(fmt::format("the document declares an entity of its own, {}, which is not read", name));
  }

  void stop(std::string problem) {
    problem_ = std::move(problem), problem_line_ = line();
    XML_StopParser(parser_.get(), XML_FALSE);
  }

  /// Blanks before the declaration, which hand-written files have.
  static std::size_t blanks_before_declaration(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlanks);
    return first != text.npos && text.substr(first).starts_with("<?xml") ? first : 0;
  }

  /// For a file that was cut off, the parser says "no element found", of whatever elements it has.
  std::string what_is_wrong() const {
    const XML_Error error = XML_GetErrorCode(parser_.get());
    const bool is_at_end = error == XML_ERROR_NO_ELEMENTS || error == XML_ERROR_UNCLOSED_TOKEN;
    if (!is_at_end || open_.empty()) return XML_ErrorString(error);
    return fmt::format("the file ends before </{}>: it was cut off", open_.back()->name);
  }

  std::size_t line() const { return skipped_lines_ + XML_GetCurrentLineNumber(parser_.get()); }

  Span event() const {
    const auto begin = skipped_ + static_cast<std::size_t>(XML_GetCurrentByteIndex(parser_.get()));
    return {begin, begin + static_cast<std::size_t>(XML_GetCurrentByteCount(parser_.get()))};
  }

  void start(const XML_Char* name, const XML_Char** attributes) {
    if (open_.size() >= kMostDepth) return stop(fmt::format("elements are nested more than {} deep", kMostDepth));
    XmlElement& element = elements_.emplace_back();
    element.name = name;
    // Attributes that a DTD adds are left out: they do not stand in the text.
    for (const XML_Char** end = attributes + XML_GetSpecifiedAttributeCount(parser_.get()); attributes != end;
         attributes += 2)
      element.attributes.emplace_back(attributes[0], attributes[1]);
    element.start_tag = element.whole = event();
    element.line = line();
    if (!open_.empty()) open_.back()->children.push_back(&element);
    open_.push_back(&element);
  }

  void end() {
    // The event for the end of <name/> has no bytes of its own.
    open_.back()->whole.end = std::max(open_.back()->whole.end, event().end);
    open_.pop_back();
  }

  const std::string& text_;
  const std::string& file_;
  std::string& encoding_;
  std::deque<XmlElement>& elements_;
  const std::size_t skipped_, skipped_lines_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
  std::vector<XmlElement*> open_;
  std::string problem_;
  std::size_t problem_line_ = 0;
};

}  // namespace

const std::string* XmlElement::attribute(std::string_view key) const {
  for (const auto& [known, value] : attributes)
    if (known == key) return &value;
  return nullptr;
}

const XmlElement* XmlElement::child(std::string_view tag) const {
  for (const XmlElement* element : children)
    if (element->name == tag) return element;
  return nullptr;
}

std::string XmlElement::text() const {
  const std::size_t begin = content.find_first_not_of(kBlanks);
  return begin == content.npos ? "" : content.substr(begin, content.find_last_not_of(kBlanks) + 1 - begin);
}

std::vector<const XmlElement*> XmlElement::children_called(std::string_view tag) const {
  std::vector<const XmlElement*> called;
  std::ranges::copy_if(children, std::back_inserter(called), [&](const XmlElement* each) { return each->name == tag; });
  return called;
}

XmlDocument::XmlDocument(std::string text, std::string file, std::vector<TextSource> sources)
    : text_(std::move(text)), file_(std::move(file)), sources_(std::move(sources)) {
  if (text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff"))
    throw InputError(Defect::Malformed, file_ + ": its text is UTF-16, which is not read; save it as UTF-8");
  Reader(text_, file_, encoding_, elements_).read();
  if (sources_.empty()) return;
  std::size_t at = 0, line = 1;
  auto source = sources_.begin();
  for (XmlElement& element : elements_) {
    for (; source != sources_.end() && source->begin <= element.whole.begin; ++source)
      at = source->begin, line = source->line;
    const std::string_view between = (*this)[{at, element.whole.begin}];
    line += static_cast<std::size_t>(std::ranges::count(between, '\n'));
    element.line = line, at = element.whole.begin;
  }
}

std::string_view XmlDocument::operator[](const Span& span) const {
  return std::string_view(text_).substr(span.begin, span.end - span.begin);
}

std::string_view XmlDocument::indentation(const XmlElement& element) const {
  const std::string_view before = std::string_view(text_).substr(0, element.whole.begin);
  const std::size_t last = before.find_last_not_of(" \t");
  const std::size_t begin = last == before.npos ? 0 : last + 1;
  if (begin > 0 && before[begin - 1] != '\n') return "";
  return before.substr(begin);
}

const std::string& XmlDocument::file_of(const XmlElement& element) const {
  if (sources_.empty()) return file_;
  return std::prev(std::ranges::upper_bound(sources_, element.whole.begin, {}, &TextSource::begin))->file;
}

std::string XmlDocument::place_of(const XmlElement& element) const {
  return fmt::format("{}: line {}", file_of(element), element.line);
}

std::string XmlDocument::short_place_of(const XmlElement& element) const {
  return file_of(element) == file_ ? fmt::format("line {}", element.line) : place_of(element);
}

void XmlDocument::refuse(const XmlElement& element, const std::string& what) const {
  refuse_line(file_of(element), element.line, what);
}

const std::string& XmlDocument::required(const XmlElement& element, std::string_view attribute) const {
  if (const std::string* value = element.attribute(attribute)) return *value;
  refuse(element, fmt::format("<{}> has no {}", element.name, attribute));
}

std::vector<double> XmlDocument::numbers(const XmlElement& element, std::string_view text) const {
  std::vector<double> values;
  for (std::size_t at = 0; (at = text.find_first_not_of(kBlanks, at)) != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    std::string_view word = text.substr(at, end - at);
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || rest != word.data() + word.size() || !std::isfinite(value))
      refuse(element,
             fmt::format("<{}> has '{}' where a number was expected", element.name, text.substr(at, end - at)));
    values.push_back(value);
    at = end;
  }
  return values;
}

double XmlDocument::number(const XmlElement& element, std::string_view attribute, double fallback) const {
  const std::string* const text = element.attribute(attribute);
  if (!text) return fallback;
  const std::vector<double> values = numbers(element, *text);
  if (values.size() != 1)
    refuse(element, fmt::format("{}='{}' of <{}>: expected one number", attribute, *text, element.name));
  return values[0];
}

Vec3 XmlDocument::vector(const XmlElement& element, std::string_view attribute, const Vec3& fallback) const {
  const std::string* const text = element.attribute(attribute);
  if (!text) return fallback;
  const std::vector<double> values = numbers(element, *text);
  if (values.size() != 3)
    refuse(element, fmt::format("{}='{}' of <{}>: expected three numbers", attribute, *text, element.name));
  return {values[0], values[1], values[2]};
}

std::string with_edits(std::string_view text, std::vector<XmlEdit> edits) {
  std::ranges::stable_sort(edits, {}, [](const XmlEdit& edit) { return edit.replaced.begin; });
  std::string result;
  std::size_t at = 0;
  for (const XmlEdit& edit : edits) {
    result.append(text.substr(at, edit.replaced.begin - at)).append(edit.text);
    at = edit.replaced.end;
  }
  return result.append(text.substr(at));
}

std::string edited_text(const XmlDocument& document, std::vector<XmlEdit> edits) {
  for (const XmlEdit& edit : edits)
    if (!is_utf8(document) && !is_ascii(edit.text))
      throw InputError(Defect::Malformed,
                       fmt::format("{}: its text is {}, and what is written has letters beyond ASCII; save it as UTF-8",
                                   document.file(), document.encoding()));
  return with_edits(document.text(), std::move(edits));
}

bool is_utf8(const XmlDocument& document) {
  return document.encoding().empty() || lower_case(document.encoding()) == "utf-8";
}

std::string xml_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else if (c == '\'')
      escaped += "&apos;";
    else
      escaped += c;
  }
  return escaped;
}

}  // namespace prohull::robot
