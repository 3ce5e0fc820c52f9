#include "robot/files/named_files.h"

#include <iterator>
#include <string_view>
#include <utility>

#include "robot/files/packages.h"
#include "robot/files/xml_lines.h"

namespace prohull::robot {
namespace {

bool names_file(const XmlElement& element, const std::string& key, const std::string& value) {
  if (!package_of(value).empty()) return true;
  return key == "filename" && (element.name == "mesh" || element.name == "texture") && !value.empty();
}

bool names_file(const XmlElement& element, std::string_view text) {
  if (!package_of(text).empty()) return true;
  return (element.name == "uri" || element.name.ends_with("_map")) && !text.empty();
}

NewUri found_from(const std::filesystem::path& folder, const RobotFile& file) {
  return [folder, packages = Packages(file.path, {})](const std::string& uri) {
    return packages.uri_from(folder, packages.find(uri, {1, 1, 1}));
  };
}

}  // namespace

RenamedFiles::RenamedFiles(const RobotFile& file, const XmlDocument& document, const std::filesystem::path& folder,
                           NewUri new_uri)
    : document_(document), new_uri_(new_uri ? std::move(new_uri) : found_from(folder, file)) {
  collect(document.root());
}

void RenamedFiles::collect(const XmlElement& element) {
  for (const auto& [key, value] : element.attributes)
    if (names_file(element, key, value)) old_.push_back({value_span(document_, element, key), value});
  if (std::string text = element.text(); element.children.empty() && names_file(element, text))
    old_.push_back({{element.start_tag.end, end_tag_begin(document_, element)}, std::move(text)});
  for (const XmlElement* child : element.children) collect(*child);
}

std::vector<XmlEdit> RenamedFiles::renamed(const std::vector<XmlEdit>& old) const {
  std::vector<XmlEdit> edits;
  for (const auto& [where, uri] : old)
    if (std::string now = new_uri_(uri); now != uri) edits.push_back({where, xml_escaped(now)});
  return edits;
}

std::string RenamedFiles::part(const Span& part) const {
  std::vector<XmlEdit> inside;
  for (const XmlEdit& old : old_)
    if (part.begin <= old.replaced.begin && old.replaced.end <= part.end) inside.push_back(old);
  return edited_part(document_, part, renamed(inside));
}

void RenamedFiles::add_to(std::vector<XmlEdit>& edits) const {
  std::vector<XmlEdit> outside = renamed(outside_of(old_, edits));
  edits.insert(edits.end(), std::make_move_iterator(outside.begin()), std::make_move_iterator(outside.end()));
}

}  // namespace prohull::robot
