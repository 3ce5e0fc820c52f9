#include "robot/files/sdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include "robot/files/named_files.h"
#include "robot/files/sdf_frames.h"
#include "robot/files/xml_lines.h"

namespace fs = std::filesystem;

namespace prohull::robot {
namespace {

constexpr std::size_t kMostModels = 10000;
constexpr std::size_t kMostMerged = std::size_t{1} << 29;

/// The newest description that a model.config names.
std::string newest_in(const fs::path& config) {
  std::ifstream stream(config, std::ios::binary);
  const XmlDocument document({std::istreambuf_iterator<char>(stream), {}}, config.string());
  const XmlElement* newest = nullptr;
  for (const XmlElement* sdf : document.root().children_called("sdf"))
    if (!newest || sdf_version(*sdf) > sdf_version(*newest)) newest = sdf;
  return newest ? newest->text() : "model.sdf";
}

/// The includes in a model and in those nested in it, in the order of the text.
void add_includes(const XmlElement& model, std::vector<const XmlElement*>& includes) {
  for (const XmlElement* child : model.children) {
    if (child->name == "include") includes.push_back(child);
    if (child->name == "model" || child->name == "world") add_includes(*child, includes);
  }
}

class SdfMerger {
 public:
  SdfMerger(const XmlDocument& document, const Packages& packages,
            const std::function<std::string(const fs::path&)>& read)
      : document_(document), folder_(fs::path(document.file()).parent_path()), packages_(packages), read_(read) {}

  XmlDocument merged() {
    const std::vector<const XmlElement*> models = sdf_models(document_);
    std::vector<const XmlElement*> includes;
    add_includes(models.empty() ? document_.root() : *models[0], includes);
    append({document_, "", includes, {}}, {0, document_.text().size()});
    if (models.empty() && count_ == 0 && !includes.empty()) refuse_all(includes);
    return std::move(merged_).document(document_.file());
  }

 private:
  struct Part {
    const XmlDocument& document;
    fs::path folder;  // of its file, relative to the robot's
    std::vector<const XmlElement*> includes;
    std::vector<XmlEdit> edits;  // none in an <include>
  };

  void append(const Part& part, const Span& span) {
    std::vector<std::pair<Span, const XmlElement*>> events;  // an <include>, or nullptr for the next edit
    for (const XmlElement* include : part.includes) events.emplace_back(include->whole, include);
    for (const XmlEdit& edit : part.edits) events.emplace_back(edit.replaced, nullptr);
    std::ranges::stable_sort(events, {}, [](const auto& event) { return event.first.begin; });
    auto edit = part.edits.begin();
    std::size_t at = span.begin;
    for (const auto& [where, include] : events) {
      merged_.add(part.document, {at, where.begin});
      if (include)
        append_include(part, *include);
      else
        merged_.add((edit++)->text);
      at = where.end;
    }
    merged_.add(part.document, {at, span.end});
  }

  void append_include(const Part& part, const XmlElement& include) {
    const fs::path file = included_model(include, packages_, part.folder).path;
    if (!file.empty() && is_merged_as_model(include)) {
      const XmlDocument other(read_(file), file.string());
      if (const XmlElement* const model = model_of(part.document, include, other)) {
        enter(part.document, include, file);
        append_model(part.document, include, other, *model);
        return open_.pop_back();
      }
    }
    merged_.add(part.document, include.whole);
  }

  /// None of the includes that a document without a model has was read.
  void refuse_all(const std::vector<const XmlElement*>& includes) const {
    const XmlElement& first = *includes.front();
    const std::string why = included_model(first, packages_).why_not;
    document_.refuse(first, fmt::format("<include> names '{}', {}; the file has no <model>", sdf_text(first, "uri"),
                                        why.empty() ? "which has no model that is read" : why));
  }

  static bool is_merged_as_model(const XmlElement& include) {
    const std::string* const merge = include.attribute("merge");
    return !merge || *merge == "false" || *merge == "0";
  }

  void enter(const XmlDocument& document, const XmlElement& include, const fs::path& file) {
    const fs::path canonical = fs::weakly_canonical(file);
    if (std::ranges::find(open_, canonical) != open_.end() || canonical == fs::weakly_canonical(document_.file()))
      document.refuse(include, fmt::format("<include> names '{}', which includes itself", sdf_text(include, "uri")));
    if (++count_ > kMostModels || merged_.size() > kMostMerged)
      document.refuse(include, fmt::format("too large for a robot: more than 10,000 models, or {} MiB, are included",
                                           kMostMerged >> 20));
    open_.push_back(canonical);
  }

  /// nullptr if there is none that may stand there.
  const XmlElement* model_of(const XmlDocument& document, const XmlElement& include, const XmlDocument& other) const {
    if (other.root().name != "sdf")
      document.refuse(include, fmt::format("<include> names '{}', whose root is <{}>, not <sdf>",
                                           sdf_text(include, "uri"), other.root().name));
    if (!has_encoding_of(other, document))
      document.refuse(include,
                      fmt::format("<include> names '{}', whose encoding is another one", sdf_text(include, "uri")));
    const XmlElement* const model = other.root().child("model");
    const bool fits = sdf_axes_are_old(other.root()) == sdf_axes_are_old(document_.root());
    return model && !model->is_empty_tag() && fits ? model : nullptr;
  }

  void append_model(const XmlDocument& document, const XmlElement& include, const XmlDocument& other,
                    const XmlElement& model) {
    Part part{other, fs::absolute(fs::path(other.file()).parent_path()), {}, {}};
    add_includes(model, part.includes);
    std::vector<XmlEdit> edits{{model.start_tag, start_of(document, include, model)}}, nested;
    for (const std::string_view said : {"pose", "static"})
      if (const XmlElement* const old = model.child(said); old && include.child(said))
        edits.push_back({old->whole, ""});
    RenamedFiles({.path = other.file()}, other, folder_, found_from_robot(other)).add_to(edits);
    for (const XmlElement* each : part.includes) nested.push_back({each->whole, ""});
    part.edits = outside_of(std::move(edits), nested);
    std::erase_if(part.edits, [&](const XmlEdit& edit) {
      return edit.replaced.begin < model.whole.begin || edit.replaced.end > model.whole.end;
    });
    std::ranges::sort(part.edits, {}, [](const XmlEdit& edit) { return edit.replaced.begin; });
    append(part, model.whole);
  }

  /// A relative path of another folder is never one of the robot's, even if nothing is there.
  NewUri found_from_robot(const XmlDocument& other) const {
    return [this, place = fs::path(other.file()), packages = Packages(other.file(), {})](const std::string& uri) {
      MeshFile file = packages.find(uri, {1, 1, 1});
      if (file.path.empty() && uri.find(':') == uri.npos) file.path = place.parent_path() / uri;
      return packages.uri_from(folder_, file);
    };
  }

  /// The start tag of the model, and what the include says of it.
  static std::string start_of(const XmlDocument& document, const XmlElement& include, const XmlElement& model) {
    std::string text = "<model";
    for (const auto& [key, value] : model.attributes)
      if (sdf_text(include, key).empty()) text += fmt::format(" {}=\"{}\"", key, xml_escaped(value));
    for (const std::string_view said : {"name", "placement_frame"})
      if (const std::string value = sdf_text(include, said); !value.empty())
        text += fmt::format(" {}=\"{}\"", said, xml_escaped(value));
    text += ">";
    for (const XmlElement* said : include.children)
      if (said->name == "pose" || said->name == "static" || said->name == "plugin") text += document[said->whole];
    return text;
  }

  const XmlDocument& document_;
  const fs::path folder_;  // of the robot's file
  const Packages& packages_;
  const std::function<std::string(const fs::path&)>& read_;
  MergedText merged_;
  std::vector<fs::path> open_;  // the files that include the one that is appended
  std::size_t count_ = 0;
};

}  // namespace

MeshFile included_model(const XmlElement& include, const Packages& packages, const fs::path& folder) {
  const std::string uri = sdf_text(include, "uri");
  if (uri.empty()) return {.uri = uri, .why_not = "it has no <uri>"};
  if (MeshFile file = packages.find_description(uri, folder); !file.path.empty()) return file;
  const fs::path config = packages.find_description(uri + "/model.config", folder).path;
  return config.empty() ? packages.find_description(uri + "/model.sdf", folder)
                        : packages.find_description(newest_in(config), fs::absolute(config.parent_path()));
}

XmlDocument with_included_models(const XmlDocument& document, const Packages& packages,
                                 const std::function<std::string(const fs::path&)>& read) {
  return SdfMerger(document, packages, read).merged();
}

}  // namespace prohull::robot
