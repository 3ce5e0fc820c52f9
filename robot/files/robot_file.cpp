#include "robot/files/robot_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <utility>

#include "prohull/detail/extension.h"
#include "prohull/detail/missing_file.h"
#include "prohull/error.h"
#include "robot/files/mesh_references.h"
#include "robot/files/mjcf.h"
#include "robot/files/packages.h"
#include "robot/files/sdf.h"
#include "robot/files/urdf.h"
#include "robot/files/xacro.h"
#include "robot/files/xml.h"

namespace fs = std::filesystem;

namespace prohull::robot {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 29;

using ReadText = std::function<std::string(const fs::path&)>;

struct Format {
  RobotFormat format;
  std::string_view root;
  RobotFile (*read)(const XmlDocument&, const Packages&);
  XmlDocument (*merged)(const XmlDocument&, const Packages&, const ReadText&);  ///< with what it includes
  std::string (*with_collisions)(const RobotFile&, const XmlDocument&, std::span<const NewCollision>, const fs::path&,
                                 const NewUri&);
};
constexpr std::array<Format, 3> kFormats{
    {{RobotFormat::Urdf, "robot", read_urdf, nullptr, urdf_with_collisions},
     {RobotFormat::Sdf, "sdf", read_sdf, with_included_models, sdf_with_collisions},
     {RobotFormat::Mjcf, "mujoco", read_mjcf, with_included_files, mjcf_with_collisions}}};

[[noreturn]] void refuse_file(Defect defect, const fs::path& path, const std::string& why) {
  throw InputError(defect, fmt::format("{}: {}", path.string(), why));
}

bool is_usd(const fs::path& path, std::string_view text) {
  constexpr std::array<std::string_view, 3> kMagics{"#usda", "PXR-USDC", "PK\x03\x04"};
  constexpr std::array<std::string_view, 4> kSuffixes{".usd", ".usda", ".usdc", ".usdz"};
  return std::ranges::any_of(kMagics, [&](std::string_view magic) { return text.starts_with(magic); }) ||
         std::ranges::find(kSuffixes, lower_case_extension(path)) != kSuffixes.end();
}

/// Whether it may be XML: it begins with "<", or is UTF-16.
bool may_be_xml(std::string_view text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) return true;
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != text.npos && text[first] == '<';
}

/// Called with the begin of a file, or all of it.
void refuse_other_formats(const fs::path& path, std::string_view text) {
  if (text.find_first_not_of(" \t\r\n") == text.npos) refuse_file(Defect::Malformed, path, "the file is empty");
  if (is_usd(path, text))
    refuse_file(Defect::UnknownFormat, path,
                "USD is not read; export the robot as URDF or MJCF, as Isaac Sim and the USD converters of MuJoCo do");
  if (!may_be_xml(text))
    refuse_file(Defect::UnknownFormat, path,
                "no robot: URDF, SDF and MJCF are XML, and this file is not; a mesh is read by prohull build");
}

[[noreturn]] void refuse_size(const fs::path& path) {
  refuse_file(Defect::Malformed, path, fmt::format("too large for a robot: more than {} MiB", kMostBytes >> 20));
}

std::string read_text(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error))
    refuse_file(Defect::CannotRead, path, "this is a folder; name the robot's file in it");
  const std::uintmax_t size_on_disk = fs::file_size(path, error);
  if (!error && size_on_disk > kMostBytes) refuse_size(path);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail_to_read(path.string(), errno);
  constexpr std::size_t kChunk = std::size_t{1} << 16;
  std::string text;
  while (stream) {
    const std::size_t size = text.size();
    text.resize(size + kChunk);
    stream.read(text.data() + size, kChunk);
    text.resize(size + static_cast<std::size_t>(stream.gcount()));
    if (size == 0) refuse_other_formats(path, text);
    if (text.size() > kMostBytes) refuse_size(path);
  }
  if (stream.bad()) refuse_file(Defect::CannotRead, path, "cannot be read to its end");
  return text;
}

RobotFile read_document(const XmlDocument& document, const fs::path& path, const FileOptions& options) {
  const std::string& root = document.root().name;
  const auto* const format = std::ranges::find(kFormats, root, &Format::root);
  if (format == kFormats.end())
    refuse_file(
        Defect::UnknownFormat, path,
        fmt::format("no robot: its root is <{}>; that of URDF is <robot>, of SDF <sdf>, of MJCF <mujoco>", root));
  const Packages packages(path, options);
  const auto read = [&](const XmlDocument& whole) {
    RobotFile file = format->read(whole, packages);
    file.format = format->format, file.path = path, file.options = options, file.text = whole.text();
    return file;
  };
  if (!format->merged || !includes_files(document.root())) return read(document);
  std::vector<fs::path> included;
  RobotFile file = read(format->merged(document, packages, [&](const fs::path& part) {
    included.push_back(part);
    return read_text(part);
  }));
  file.included = std::move(included);
  return file;
}

}  // namespace

Names<RobotFormat> robot_format_names() {
  static constexpr std::array<std::pair<std::string_view, RobotFormat>, 3> kNames{
      {{"urdf", RobotFormat::Urdf}, {"sdf", RobotFormat::Sdf}, {"mjcf", RobotFormat::Mjcf}}};
  return kNames;
}

bool is_robot_file(const fs::path& path) {
  constexpr std::array<std::string_view, 5> kSuffixes{".urdf", ".xacro", ".sdf", ".mjcf", ".xml"};
  return std::ranges::find(kSuffixes, path.extension().string()) != kSuffixes.end();
}

RobotFile read_robot(const fs::path& path, const FileOptions& options) {
  const XmlDocument document(read_text(path), path.string());
  if (!is_xacro(document)) return read_document(document, path, options);
  if (options.no_outside_files)
    refuse_file(
        Defect::CannotRead, path,
        "the macros of a xacro file may read any file, which --no-outside-files refuses; expand it elsewhere: xacro "
        "FILE > robot.urdf");
  std::string text = expanded_by_xacro(path);
  const std::string name = path.string() + ", expanded by xacro";
  refuse_other_formats(name, text);
  return read_document(XmlDocument(std::move(text), name), path, options);
}

RobotFile read_robot(std::string text, const fs::path& path, const FileOptions& options) {
  refuse_other_formats(path, text);
  const XmlDocument document(std::move(text), path.string());
  if (is_xacro(document)) refuse_xacro(path);
  return read_document(document, path, options);
}

std::string with_collisions(const RobotFile& file, std::span<const NewCollision> collisions, const fs::path& folder,
                            const NewUri& new_uri) {
  const XmlDocument document(file.text, file.path.string());
  const auto* const format = std::ranges::find(kFormats, file.format, &Format::format);
  return format->with_collisions(file, document, collisions, folder, new_uri);
}

}  // namespace prohull::robot
