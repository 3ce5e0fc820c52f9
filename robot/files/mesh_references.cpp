#include "robot/files/mesh_references.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "prohull/detail/extension.h"
#include "prohull/error.h"

namespace fs = std::filesystem;

namespace prohull::robot {
namespace {

constexpr std::string_view kBlanksInALine = " \t\r";

std::ifstream opened(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(Defect::CannotRead, fmt::format("{}: cannot be read", file.string()));
  return in;
}

std::string content_of(const fs::path& file) {
  std::ifstream in = opened(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// OBJ and its materials

/// Part of a line: blanks around it are none of it.
struct Words {
  std::string_view text;
  std::size_t begin = 0;  // in the line

  bool is_empty() const { return text.empty(); }

  static Words of(std::string_view line, std::size_t begin, std::size_t end) {
    begin = std::min(line.find_first_not_of(kBlanksInALine, begin), end);
    while (end > begin && kBlanksInALine.find(line[end - 1]) != kBlanksInALine.npos) --end;
    return {line.substr(begin, end - begin), begin};
  }
};

/// Calls `take(first word, rest of the line, where the line begins)` for each line.
template <class Take>
void for_each_line(const fs::path& file, const Take& take) {
  std::ifstream in = opened(file);
  std::size_t begin = 0;
  for (std::string line; std::getline(in, line); begin += line.size() + 1) {
    const Words all = Words::of(line, 0, line.size());
    const std::size_t end = std::min(line.find_first_of(kBlanksInALine, all.begin), line.size());
    take(std::string_view(line).substr(all.begin, end - all.begin), Words::of(line, end, line.size()), begin);
  }
}

FileReference reference(const Words& name, std::size_t line, const FindFile& find) {
  const std::size_t begin = line + name.begin;
  return {{begin, begin + name.text.size()}, std::string(name.text), find(std::string(name.text))};
}

/// "mtllib a.mtl b.mtl" names two files, or one with a blank.
std::vector<FileReference> references_in_obj(const fs::path& file, const FindFile& find) {
  std::vector<FileReference> found;
  for_each_line(file, [&](std::string_view key, const Words& rest, std::size_t line) {
    if (key != "mtllib" || rest.is_empty()) return;
    FileReference whole = reference(rest, line, find);
    if (!whole.file.empty() || rest.text.find_first_of(kBlanksInALine) == rest.text.npos)
      return void(found.push_back(std::move(whole)));
    for (Words left = rest; !left.is_empty();) {
      const std::size_t end = std::min(left.text.find_first_of(kBlanksInALine), left.text.size());
      found.push_back(reference({left.text.substr(0, end), left.begin}, line, find));
      const Words next = Words::of(left.text, end, left.text.size());
      left = {next.text, left.begin + next.begin};
    }
  });
  return found;
}

/// "map_Kd -s 1 1 1 my wood.png": the longest end of the line that is a file; otherwise its last word.
FileReference image_of(Words rest, std::size_t line, const FindFile& find) {
  for (;;) {
    FileReference found = reference(rest, line, find);
    const std::size_t end = rest.text.find_first_of(kBlanksInALine);
    if (!found.file.empty() || end == rest.text.npos) return found;
    const Words next = Words::of(rest.text, end, rest.text.size());
    rest = {next.text, rest.begin + next.begin};
  }
}

std::vector<FileReference> references_in_mtl(const fs::path& file, const FindFile& find) {
  constexpr std::array<std::string_view, 6> kMaps{"map_", "bump", "disp", "decal", "refl", "norm"};
  std::vector<FileReference> found;
  for_each_line(file, [&](std::string_view key, const Words& rest, std::size_t line) {
    const std::string lower = lower_case(std::string(key));
    if (!rest.is_empty() && std::ranges::any_of(kMaps, [&](std::string_view map) { return lower.starts_with(map); }))
      found.push_back(image_of(rest, line, find));
  });
  return found;
}

// DAE

/// <image> has its file in <init_from>, of version 1.5 in a <ref> therein.
void add_images(const XmlElement& element, const FindFile& find, std::vector<FileReference>& found) {
  for (const XmlElement* child : element.children) {
    const XmlElement* const from = child->name == "image" ? child->child("init_from") : nullptr;
    const XmlElement* const ref = from && from->child("ref") ? from->child("ref") : from;
    if (!ref || ref->text().empty())
      add_images(*child, find, found);
    else
      found.push_back({{ref->start_tag.end, ref->whole.end}, ref->text(), find(ref->text())});
  }
}

std::vector<FileReference> references_in_dae(const fs::path& file, const FindFile& find) {
  std::string text = content_of(file);
  std::vector<FileReference> found;
  if (text.find("<init_from") == text.npos) return found;
  const XmlDocument document(std::move(text), file.string());
  add_images(document.root(), find, found);
  for (FileReference& each : found) each.where.end = document.text().rfind("</", each.where.end - 1);
  return found;
}

// glTF

/// The end of a JSON string that begins at its quote, behind the other one.
std::size_t end_of_string(std::string_view json, std::size_t begin) {
  std::size_t at = begin + 1;
  while (at < json.size() && json[at] != '"') at += json[at] == '\\' ? 2 : 1;
  return std::min(at + 1, json.size());
}

/// Values of "uri". `begin` is where the text begins in the file.
std::vector<FileReference> references_in_json(std::string_view json, std::size_t begin, const FindFile& find) {
  std::vector<FileReference> found;
  bool is_uri = false;  // the last string was this key
  for (std::size_t at = json.find('"'); at != json.npos; at = json.find('"', at)) {
    const std::size_t end = end_of_string(json, at);
    const std::string_view token = json.substr(at, end - at);
    const std::size_t next = json.find_first_not_of(" \t\r\n", end);
    const bool is_key = next != json.npos && json[next] == ':';
    if (is_uri && !is_key) {
      const nlohmann::json value = nlohmann::json::parse(token, nullptr, false);
      if (value.is_string())
        found.push_back({{begin + at, begin + end}, value.get<std::string>(), find(value.get<std::string>())});
    }
    is_uri = is_key && token == "\"uri\"";
    at = end;
  }
  return found;
}

/// A GLB file begins with a header of 12 bytes, the last 4 of which are its size, and one of 8 for its JSON text, the
/// first 4 of which are the size of that.
struct GlbHeader {
  static constexpr std::size_t kFile = 8, kText = 12, kEnd = 20;  // in bytes
  std::array<unsigned char, kEnd> bytes{};

  std::size_t size_at(std::size_t at) const {
    return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 | std::size_t(bytes[at + 3]) << 24;
  }
  XmlEdit with_size(std::size_t at, std::size_t size) const {
    std::string text;
    for (int shift = 0; shift < 32; shift += 8) text += static_cast<char>(size >> shift & 255U);
    return {{at, at + 4}, text};
  }
  static GlbHeader of(std::istream& in) {
    GlbHeader header;
    in.read(reinterpret_cast<char*>(header.bytes.data()), header.bytes.size());
    return header;
  }
};

std::vector<FileReference> references_in_glb(const fs::path& file, const FindFile& find) {
  std::ifstream in = opened(file);
  const std::size_t size = GlbHeader::of(in).size_at(GlbHeader::kText);
  std::error_code error;
  if (!in || size > fs::file_size(file, error)) return {};
  std::string json(size, ' ');
  in.read(json.data(), static_cast<std::streamsize>(size));
  return references_in_json(json, GlbHeader::kEnd, find);
}

/// The JSON text has a multiple of 4 bytes, and the headers have the sizes.
void add_glb_sizes(const fs::path& file, std::vector<XmlEdit>& edits) {
  std::ifstream in = opened(file);
  const GlbHeader header = GlbHeader::of(in);
  const std::size_t old = header.size_at(GlbHeader::kText), end = GlbHeader::kEnd + old;
  std::size_t size = old;
  for (const XmlEdit& edit : edits) size += edit.text.size() - (edit.replaced.end - edit.replaced.begin);
  const std::string padding((4 - size % 4) % 4, ' ');
  size += padding.size();
  edits.push_back({{end, end}, padding});
  edits.insert(edits.begin(), {header.with_size(GlbHeader::kFile, header.size_at(GlbHeader::kFile) - old + size),
                               header.with_size(GlbHeader::kText, size)});
}

}  // namespace

std::vector<FileReference> references_in(const fs::path& file, const FindFile& find) {
  const std::string suffix = lower_case_extension(file);
  if (suffix == ".obj") return references_in_obj(file, find);
  if (suffix == ".mtl") return references_in_mtl(file, find);
  if (suffix == ".dae") return references_in_dae(file, find);
  if (suffix == ".gltf") return references_in_json(content_of(file), 0, find);
  if (suffix == ".glb") return references_in_glb(file, find);
  return {};
}

std::vector<XmlEdit> renamed(const fs::path& file, std::span<const FileReference> references,
                             std::span<const std::string> names) {
  const std::string suffix = lower_case_extension(file), quote = suffix == ".gltf" || suffix == ".glb" ? "\"" : "";
  std::vector<XmlEdit> edits;
  for (std::size_t i = 0; i < references.size(); ++i)
    if (references[i].name != names[i]) edits.push_back({references[i].where, quote + names[i] + quote});
  if (suffix == ".glb" && !edits.empty()) add_glb_sizes(file, edits);
  return edits;
}

}  // namespace prohull::robot
