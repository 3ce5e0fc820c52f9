#include "robot/files/packages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>

#include "prohull/detail/percents.h"
#include "prohull/detail/text.h"
#include "prohull/error.h"
#include "robot/files/xml.h"

namespace fs = std::filesystem;

namespace prohull::robot {
namespace {

constexpr std::size_t kMostPlacesInMessages = 6;
constexpr std::uintmax_t kMostPackageXml = std::uintmax_t{1} << 20;  // bytes

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

/// Absolute and without "..", but with the links that it goes through, unless ".." stands behind one: then it is where
/// the link leads. A folder loses its slash at the end.
fs::path tidied(const fs::path& path) {
  const fs::path absolute = fs::absolute(path);
  fs::path tidy = absolute.lexically_normal();
  std::error_code error;
  if (std::ranges::find(absolute, "..") != absolute.end() && !fs::equivalent(absolute, tidy, error))
    if (fs::path canonical = fs::weakly_canonical(absolute, error); !error) tidy = std::move(canonical);
  return tidy.has_filename() || !tidy.has_relative_path() ? tidy : tidy.parent_path();
}

std::vector<fs::path> paths_of_environment(const char* variable) {
  const char* const value = std::getenv(variable);
  std::vector<fs::path> paths;
  for (std::string_view rest = value ? value : ""; !rest.empty();) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    if (end > 0) paths.push_back(tidied(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return paths;
}

/// The name that the package.xml of a folder says; "" without a readable one.
std::string declared_name(const fs::path& folder) {
  const fs::path path = folder / "package.xml";
  std::error_code error;
  if (!is_file(path) || fs::file_size(path, error) > kMostPackageXml) return "";
  std::ifstream stream(path, std::ios::binary);
  try {
    const XmlDocument document({std::istreambuf_iterator<char>(stream), {}}, path.string());
    const XmlElement* const name = document.root().child("name");
    return name ? name->text() : "";
  } catch (const InputError&) {
    return "";
  }
}

bool is_package(const fs::path& folder, const std::string& name) {
  return is_folder(folder) && (folder.filename() == name || declared_name(folder) == name);
}

std::vector<fs::path> folders_in(const fs::path& parent) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::directory_iterator entry(parent, error), end; !error && entry != end; entry.increment(error))
    if (is_folder(entry->path())) folders.push_back(entry->path());
  std::ranges::sort(folders);
  return folders;
}

/// Folders without repetition, in the order in which they were added.
class Found {
 public:
  void add(const fs::path& folder) {
    if (std::ranges::find(folders_, folder) == folders_.end()) folders_.push_back(folder);
  }
  void add_if_folder(const fs::path& folder) {
    if (is_folder(folder)) add(folder);
  }
  std::vector<fs::path> folders() && { return std::move(folders_); }

 private:
  std::vector<fs::path> folders_;
};

/// At a package path, in it, and one level deeper.
void find_at(const fs::path& place, const std::string& name, Found& found) {
  if (is_package(place, name)) found.add(place);
  found.add_if_folder(place / name);
  for (const fs::path& folder : folders_in(place)) {
    if (declared_name(folder) == name) found.add(folder);
    found.add_if_folder(folder / name);
  }
}

/// Among the folders above a file and their neighbours. A neighbour that only its package.xml calls so is looked for
/// beside packages.
void find_above(const fs::path& lowest, const std::string& name, Found& found) {
  for (fs::path folder = lowest;; folder = folder.parent_path()) {
    if (is_package(folder, name)) found.add(folder);
    found.add_if_folder(folder / name);
    if (folder == folder.parent_path()) return;
    if (!is_file(folder / "package.xml")) continue;
    for (const fs::path& neighbour : folders_in(folder.parent_path()))
      if (declared_name(neighbour) == name) found.add(neighbour);
  }
}

/// The lowest folder that is, or is above, `lowest` and is a package; `lowest` without one.
fs::path package_around(const fs::path& lowest) {
  for (fs::path folder = lowest;; folder = folder.parent_path()) {
    if (is_file(folder / "package.xml") || is_file(folder / "model.config")) return folder;
    if (folder == folder.parent_path()) return lowest;
  }
}

/// The file that a path names as it is written, or with its %20 decoded.
std::optional<fs::path> file_at(const fs::path& folder, std::string_view path) {
  for (const fs::path& candidate : {fs::path(path), fs::path(without_percents(path))})
    if (const fs::path file = tidied(folder / candidate); is_file(file)) return file;
  return std::nullopt;
}

/// Whether a relative path leads out of the folder that it begins in.
bool leads_out(std::string_view path) {
  const fs::path normal = fs::path(without_percents(path)).lexically_normal();
  return normal.is_absolute() || (!normal.empty() && *normal.begin() == "..");
}

std::string_view without_slashes(std::string_view path) {
  path.remove_prefix(std::min(path.find_first_not_of('/'), path.size()));
  return path;
}

std::string why_not_at(const fs::path& path) {
  return is_folder(path) ? fmt::format("{} is a folder", path.string())
                         : fmt::format("there is no file {}", path.string());
}

/// "/home/robot/x" of "file:///home/robot/x", "file://localhost/home/robot/x" and "file:/home/robot/x"; "x" of
/// "file:x".
std::optional<std::string_view> path_of_file_uri(std::string_view rest) {
  if (rest.starts_with("//localhost/")) rest.remove_prefix(std::string_view("//localhost").size());
  if (rest.starts_with("//") && !rest.starts_with("///")) return std::nullopt;
  return rest;
}

/// "package" of "package://arm/link.stl"; "" of a path.
std::string_view scheme_of(std::string_view uri) {
  const std::size_t end = uri.find("://");
  if (end == uri.npos) return uri.starts_with("file:") ? "file" : "";
  return uri.substr(0, end).find('/') == uri.npos ? uri.substr(0, end) : "";
}

/// The path that a URI names without a package.
std::optional<std::string_view> path_of(std::string_view uri, std::string_view scheme) {
  if (scheme == "file") return path_of_file_uri(uri.substr(5));
  return scheme.empty() ? std::optional(uri) : std::nullopt;
}

}  // namespace

bool is_in(const fs::path& file, const fs::path& folder) {
  std::error_code no_folder, no_file;
  const fs::path root = fs::weakly_canonical(folder, no_folder), place = fs::weakly_canonical(file, no_file);
  return !no_folder && !no_file && std::ranges::mismatch(root, place).in1 == root.end();
}

std::string_view package_of(std::string_view uri) {
  constexpr std::string_view kScheme = "package://";
  return uri.starts_with(kScheme) ? uri.substr(kScheme.size(), uri.find('/', kScheme.size()) - kScheme.size()) : "";
}

Packages::Packages(const fs::path& robot, const FileOptions& options)
    : folder_(tidied(robot).parent_path()), prefixes_(paths_of_environment("AMENT_PREFIX_PATH")) {
  for (const fs::path& path : options.package_paths) package_paths_.push_back(tidied(path));
  for (const char* variable :
       {"ROS_PACKAGE_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH", "SDF_PATH"})
    std::ranges::move(paths_of_environment(variable), std::back_inserter(environment_paths_));
  if (!options.no_outside_files) return;
  inside_.push_back(package_around(folder_));
  for (const auto* paths : {&package_paths_, &environment_paths_, &prefixes_})
    inside_.insert(inside_.end(), paths->begin(), paths->end());
}

const std::vector<fs::path>& Packages::folders_of(const std::string& package) const {
  if (const auto known = known_.find(package); known != known_.end()) return known->second;
  Found found;
  for (const fs::path& place : package_paths_) find_at(place, package, found);
  find_above(folder_, package, found);
  for (const fs::path& place : environment_paths_) find_at(place, package, found);
  for (const fs::path& prefix : prefixes_) found.add_if_folder(prefix / "share" / package);
  return known_[package] = std::move(found).folders();
}

std::string Packages::looked_in() const {
  std::vector<std::string> places;
  for (const fs::path& path : package_paths_)
    places.push_back(path.string() + (is_folder(path) ? "" : " (which is no folder)"));
  places.push_back(fmt::format("{} and the folders above it", folder_.string()));
  for (const fs::path& path : environment_paths_) places.push_back(path.string());
  for (const fs::path& prefix : prefixes_) places.push_back((prefix / "share").string());
  return first_of(places, kMostPlacesInMessages);
}

void Packages::find_in_package(std::string_view inside, std::string_view scheme, MeshFile& mesh) const {
  const std::size_t slash = std::min(inside.find('/'), inside.size());
  const std::string name = without_percents(inside.substr(0, slash));
  const std::string_view path = without_slashes(inside.substr(slash));
  if (name.empty() || name == "." || name == ".." || path.empty())
    return void(mesh.why_not = fmt::format("expected {}://PACKAGE/FILE", scheme));
  if (leads_out(path)) return void(mesh.why_not = fmt::format("its path leads out of the package {}", name));
  const std::vector<fs::path>& folders = folders_of(name);
  for (const fs::path& folder : folders)
    if (auto file = file_at(folder, path)) return void(mesh.path = *std::move(file));
  mesh.why_not = folders.empty() ? fmt::format(
                                       "there is no package {} in {}; name the folder that holds it by "
                                       "--package-path",
                                       name, looked_in())
                                 : fmt::format("{}; name another folder that holds the package {} by --package-path",
                                               why_not_at(folders.front() / path), name);
}

void Packages::refuse_outside(const MeshFile& file, const std::string& why) {
  throw InputError(Defect::CannotRead, fmt::format("{}: {}, which --no-outside-files refuses", file.uri, why));
}

void Packages::require_inside(const MeshFile& file) const {
  if (inside_.empty() || file.path.empty()) return;
  if (std::ranges::none_of(inside_, [&](const fs::path& folder) { return is_in(file.path, folder); }))
    refuse_outside(file, fmt::format("{} is outside of {}, and of every folder that --package-path names",
                                     file.path.string(), inside_.front().string()));
}

MeshFile Packages::find(std::string uri, const Vec3& scale, const fs::path& folder) const {
  MeshFile mesh = found(std::move(uri), scale, folder);
  require_inside(mesh);
  mesh.alone = !inside_.empty();
  return mesh;
}

MeshFile Packages::find_description(std::string uri, const fs::path& folder) const {
  MeshFile file = found(std::move(uri), {1, 1, 1}, folder);
  require_inside(file);
  return file;
}

MeshFile Packages::found(std::string uri, const Vec3& scale, const fs::path& folder) const {
  MeshFile mesh;
  mesh.uri = std::move(uri), mesh.scale = scale;
  const std::string_view text = mesh.uri, scheme = scheme_of(text);
  if (scheme == "package" || scheme == "model") {
    find_in_package(text.substr(scheme.size() + 3), scheme, mesh);
    return mesh;
  }
  const auto path = path_of(text, scheme);
  if (scheme == "http" || scheme == "https")
    mesh.why_not = "files are not fetched from the net; download it and name the copy";
  else if (!scheme.empty() && scheme != "file")
    mesh.why_not = fmt::format("{}:// is not known; package://, model://, file:/// and paths are", scheme);
  else if (!path)
    mesh.why_not = "it names a host; three slashes have to follow file:";
  else if (auto file = file_at(folder_ / folder, *path))
    mesh.path = *std::move(file);
  else
    mesh.why_not = why_not_at(tidied(folder_ / folder / fs::path(*path)));
  return mesh;
}

namespace {

/// The file that a robot in `folder` finds, without package paths.
fs::path found_from(const fs::path& folder, const std::string& uri) {
  return Packages(folder / "robot", {}).find(uri, {1, 1, 1}).path;
}

}  // namespace

std::string Packages::uri_from(const fs::path& folder, const MeshFile& mesh) const {
  const std::string_view scheme = scheme_of(mesh.uri);
  const auto path = path_of(mesh.uri, scheme);
  const bool is_relative = path && !fs::path(*path).is_absolute();
  const bool is_of_model = scheme == "model" && package_paths_.empty();
  if (mesh.path.empty() || (!is_relative && !is_of_model)) return mesh.uri;
  std::error_code error;
  const fs::path found = found_from(folder, mesh.uri);
  if (!found.empty() && fs::equivalent(found, mesh.path, error)) return mesh.uri;
  const fs::path relative = fs::relative(mesh.path, fs::absolute(folder / "."), error);  // it may not be there yet
  return error || relative.empty() ? mesh.path.string() : relative.generic_string();
}

}  // namespace prohull::robot
