#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/text_scanner.h"

namespace prohull {
namespace {

// Everything in the specification (appendix B1 of the Advanced Visualizer manual) that is not a vertex or a face.
constexpr auto kIgnoredKeywords = std::to_array<std::string_view>(
    {"vn",     "vt",     "vp",    "g",     "o",          "s",         "usemtl",   "mtllib", "l",        "p",   "mg",
     "usemap", "maplib", "bevel", "lod",   "shadow_obj", "trace_obj", "c_interp", "con",    "d_interp", "deg", "cstype",
     "bmat",   "step",   "curv",  "curv2", "surf",       "parm",      "trim",     "hole",   "scrv",     "sp",  "end",
     "ctech",  "stech",  "call",  "csh",   "bsp",        "bzp",       "cdc",      "cdp",    "res"});

class ObjReader {
 public:
  ObjReader(std::string_view content, const std::string& file, const ReadOptions& options)
      : scanner_(content, file, {.comments = true, .continued_lines = true}),
        builder_(file, 1, content, options),
        marks_(options.marks) {}

  TriangleMesh read() {
    while (scanner_.next_line()) {
      const std::string_view keyword = scanner_.word();
      if (keyword == "v")
        read_vertex();
      else if (keyword == "f" || keyword == "fo")
        read_face();
      else if (marks_ && (keyword == "g" || keyword == "o" || keyword == "usemtl"))
        read_names(keyword == "g" ? groups_ : keyword == "o" ? object_ : material_);
      else if (!is_obj_keyword(keyword))
        scanner_.fail(fmt::format("{} is not a record of an OBJ file", in_quotes(keyword)));
    }
    return builder_.finish();
  }

 private:
  void read_vertex() {
    Vec3 position;
    for (int axis = 0; axis < 3; ++axis) position[axis] = scanner_.number("a coordinate");
    builder_.add_vertex(position, scanner_.place());
  }

  void read_face() {
    const Place place = scanner_.place();
    corners_.clear();
    while (!scanner_.at_line_end()) corners_.push_back(read_corner());
    builder_.add_polygon(corners_, place);
    if (marks_) marks_->names_of.resize(builder_.triangle_count(), names_in_force());
  }

  void read_names(std::vector<std::string>& names) {
    names.clear();
    while (!scanner_.at_line_end()) names.emplace_back(scanner_.word());
    has_new_names_ = true;
  }

  // Their number among the combinations that have occurred.
  std::uint32_t names_in_force() {
    if (std::exchange(has_new_names_, false)) {
      std::vector<std::string> all = groups_;
      all.insert(all.end(), object_.begin(), object_.end());
      all.insert(all.end(), material_.begin(), material_.end());
      const auto [known, is_new] = known_names_.try_emplace(all, static_cast<std::uint32_t>(marks_->names.size()));
      if (is_new) marks_->names.push_back(std::move(all));
      names_number_ = known->second;
    }
    return names_number_;
  }

  /// vertex, vertex/texture, vertex//normal or vertex/texture/normal; a negative vertex counts back from the last one.
  std::int64_t read_corner() {
    const std::string_view word = scanner_.word();
    std::int64_t number = 0;
    const char* const end = word.data() + word.size();
    const auto [rest, error] = std::from_chars(word.data(), end, number);
    if (error != std::errc() || (rest != end && *rest != '/'))
      scanner_.fail(fmt::format("{} is not a corner of a face; expected a vertex number", in_quotes(word)));
    const auto count = static_cast<std::int64_t>(builder_.vertex_count());
    if (number >= 0) return number - 1;
    if (number < -count)
      scanner_.fail(fmt::format("the face has vertex {}, but only {} vertices come before it", number, count));
    return count + number;
  }

  TextScanner scanner_;
  MeshBuilder builder_;
  std::vector<std::int64_t> corners_;
  MeshMarks* const marks_;
  std::vector<std::string> groups_, object_, material_;
  std::map<std::vector<std::string>, std::uint32_t> known_names_;
  bool has_new_names_ = true;
  std::uint32_t names_number_ = 0;
};

}  // namespace

bool is_obj_keyword(std::string_view word) {
  return word == "v" || word == "f" || word == "fo" ||
         std::find(kIgnoredKeywords.begin(), kIgnoredKeywords.end(), word) != kIgnoredKeywords.end();
}

TriangleMesh read_obj(std::string_view content, const std::string& file, const ReadOptions& options) {
  return ObjReader(content, file, options).read();
}

}  // namespace prohull
