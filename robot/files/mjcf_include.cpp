#include "robot/files/mjcf.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "prohull/error.h"
#include "robot/files/xml_lines.h"

namespace fs = std::filesystem;

namespace prohull::robot {
namespace {

class Merger {
 public:
  Merger(const Packages& packages, const std::function<std::string(const fs::path&)>& read)
      : packages_(packages), read_(read) {}

  /// Appends a part of the document. `folder` is that of its file, relative to the robot's.
  void append(const XmlDocument& document, const Span& part, const fs::path& folder) {
    std::size_t at = part.begin;
    for (const XmlElement* element : includes(document.root(), part)) {
      merged_.add(document, {at, element->whole.begin});
      append_file(document, *element, folder);
      at = element->whole.end;
    }
    merged_.add(document, {at, part.end});
  }

  XmlDocument merged(const XmlDocument& document) {
    append(document, {0, document.text().size()}, "");
    return std::move(merged_).document(document.file());
  }

 private:
  /// In the order of the text.
  static std::vector<const XmlElement*> includes(const XmlElement& element, const Span& part) {
    std::vector<const XmlElement*> found;
    for (const XmlElement* child : element.children) {
      if (child->whole.begin < part.begin || child->whole.end > part.end) continue;
      if (child->name == "include")
        found.push_back(child);
      else
        std::ranges::copy(includes(*child, part), std::back_inserter(found));
    }
    return found;
  }

  void append_file(const XmlDocument& document, const XmlElement& element, const fs::path& folder) {
    const std::string& name = document.required(element, "file");
    MeshFile file = packages_.find_description(name);
    if (file.path.empty()) file = packages_.find_description(name, folder);
    if (file.path.empty())
      throw InputError(Defect::CannotRead,
                       fmt::format("{}: <include> names '{}': {}", document.place_of(element), name, file.why_not));
    if (!included_.insert(fs::weakly_canonical(file.path)).second)
      document.refuse(element, fmt::format("<include> names '{}' a second time, which MuJoCo refuses, too", name));
    const XmlDocument other(read_(file.path), file.path.string());
    if (other.root().name != "mujocoinclude" && other.root().name != "mujoco")
      document.refuse(element, fmt::format("<include> names '{}', whose root is <{}>, not <mujocoinclude>", name,
                                           other.root().name));
    if (!has_encoding_of(other, document))
      document.refuse(element, fmt::format("<include> names '{}', whose encoding is another one", name));
    append(other, inside_of(other, other.root()), (folder / name).parent_path());
  }

  const Packages& packages_;
  const std::function<std::string(const fs::path&)>& read_;
  std::set<fs::path> included_;
  MergedText merged_;
};

}  // namespace

bool includes_files(const XmlElement& element) {
  return element.name == "include" ||
         std::ranges::any_of(element.children, [](const XmlElement* child) { return includes_files(*child); });
}

XmlDocument with_included_files(const XmlDocument& document, const Packages& packages,
                                const std::function<std::string(const fs::path&)>& read) {
  return Merger(packages, read).merged(document);
}

}  // namespace prohull::robot
