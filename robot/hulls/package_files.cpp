#include "robot/hulls/package_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string_view>
#include <utility>

#include "prohull/detail/extension.h"
#include "prohull/error.h"
#include "robot/hulls/cache.h"

namespace fs = std::filesystem;

namespace prohull::robot {
namespace {

bool is_image(std::string_view suffix) {
  constexpr std::array<std::string_view, 17> kImages{".png",  ".jpg", ".jpeg", ".tga",  ".bmp", ".gif",
                                                     ".dds",  ".tif", ".tiff", ".webp", ".hdr", ".exr",
                                                     ".ktx2", ".ktx", ".pgm",  ".ppm",  ".psd"};
  return std::ranges::find(kImages, suffix) != kImages.end();
}

/// Whether a file of the robot is one to be shown.
bool is_shown(const fs::path& file) {
  constexpr std::array<std::string_view, 12> kMeshes{".msh",  ".stl", ".obj", ".ply", ".off", ".dae",
                                                     ".gltf", ".glb", ".3mf", ".fbx", ".gz",  ".mesh"};
  const std::string suffix = lower_case_extension(file);
  return is_image(suffix) || std::ranges::find(kMeshes, suffix) != kMeshes.end();
}

/// Whether a mesh or material file may name such a file. No such file names one of the first kind again.
bool goes_with(const fs::path& file, const fs::path& companion) {
  const std::string suffix = lower_case_extension(companion);
  return lower_case_extension(file) == ".obj" ? suffix == ".mtl" : suffix == ".bin" || is_image(suffix);
}

/// Whether the file is one of a robot, whose own files are not copied. Files of MJCF are called as other XML is.
bool is_description(const fs::path& file) { return is_robot_file(file) && lower_case_extension(file) != ".xml"; }

bool can_be_read(const fs::path& file) { return std::ifstream(file, std::ios::binary).is_open(); }

/// Up to `count` bytes.
void copy_bytes(std::istream& in, std::ostream& out, std::size_t count) {
  std::array<char, 1 << 16> bytes;
  while (count > 0 && in && out) {
    in.read(bytes.data(), static_cast<std::streamsize>(std::min(count, bytes.size())));
    out.write(bytes.data(), in.gcount());
    count -= static_cast<std::size_t>(in.gcount());
  }
}

void copy_with_edits(const fs::path& from, const fs::path& to, const std::vector<XmlEdit>& edits) {
  std::ifstream in(from, std::ios::binary);
  if (!in) throw InputError(Defect::CannotRead, fmt::format("{}: cannot be read", from.string()));
  std::ofstream out(to, std::ios::binary);
  std::size_t at = 0;
  for (const XmlEdit& edit : edits) {
    copy_bytes(in, out, edit.replaced.begin - at);
    out << edit.text;
    in.seekg(static_cast<std::streamoff>(at = edit.replaced.end));
  }
  copy_bytes(in, out, std::string::npos);
  out.close();
  if (in.bad()) throw InputError(Defect::CannotRead, fmt::format("{}: cannot be read to its end", from.string()));
  if (!out) throw InputError(Defect::CannotWrite, fmt::format("{}: cannot write", to.string()));
}

/// A suffix that a name may have in any program.
std::string plain_suffix(const fs::path& file) {
  std::string suffix = file.extension().string();
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  std::replace_if(
      suffix.begin() + (suffix.empty() ? 0 : 1), suffix.end(), [&](char c) { return !is_plain(c); }, '_');
  return suffix;
}

}  // namespace

PackageFiles::PackageFiles(const RobotFile& file, std::string package)
    : packages_(file.path, file.options), package_(std::move(package)) {}

std::string PackageFiles::uri_of(const std::string& uri) {
  const fs::path source = packages_.find_description(uri).path;
  if (source.empty() || is_description(source) || !can_be_read(source)) {
    left_.insert(uri);
    return uri;
  }
  return "package://" + package_ + "/" + copy_of(source).generic_string();
}

fs::path PackageFiles::copy_of(const fs::path& source) {
  if (const auto known = copies_.find(source); known != copies_.end()) return known->second;
  return copies_[source] = placed({source, edits_of(source)});
}

fs::path PackageFiles::placed(Content content) {
  const std::string suffix = plain_suffix(content.source);
  for (std::size_t i = 0; i < contents_.size(); ++i)
    if (files_[i].path.extension() == suffix && have_same_bytes(contents_[i].source, content.source) &&
        contents_[i].edits == content.edits)
      return files_[i].path;
  const bool is_beside_meshes =
      is_shown(content.source) || goes_with("a.obj", content.source) || goes_with("a.mtl", content.source);
  fs::path path = (is_beside_meshes ? fs::path("meshes") / "visual" : fs::path("files")) /
                  names_.of(content.source.stem().string(), suffix);
  files_.push_back(
      {path, [content](const fs::path& target) { copy_with_edits(content.source, target, content.edits); }});
  contents_.push_back(std::move(content));
  return path;
}

/// Gives what the file names the names of copies, which are in its folder.
std::vector<XmlEdit> PackageFiles::edits_of(const fs::path& source) {
  std::vector<FileReference> references;
  try {
    references = references_in(source, [&](const std::string& name) { return found_beside(source, name); });
  } catch (const InputError& error) {
    if (error.defect() != Defect::Malformed) throw;
    left_.insert(fmt::format("what {} names ({})", source.filename().string(), error.what()));
  }
  std::vector<std::string> names;
  for (const FileReference& reference : references) {
    const bool is_here = !reference.file.empty();
    if (!is_here && !reference.name.starts_with("data:"))
      left_.insert(fmt::format("{} of {}", reference.name, source.filename().string()));
    names.push_back(is_here ? copy_of(reference.file).filename().string() : reference.name);
  }
  return renamed(source, references, names);
}

/// Also by a path of Windows.
fs::path PackageFiles::found_beside(const fs::path& source, const std::string& name) const {
  std::string slashes = name;
  std::ranges::replace(slashes, '\\', '/');
  for (const std::string& each : {name, slashes})
    if (fs::path file = packages_.find_description(each, source.parent_path()).path;
        !file.empty() && goes_with(source, file) && can_be_read(file))
      return file;
  return {};
}

}  // namespace prohull::robot
