#include "outputs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <iterator>
#include <map>
#include <mutex>
#include <random>
#include <system_error>

#include "console.h"
#include "options.h"
#include "prohull/detail/extension.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "robot/hulls/write_robot.h"

namespace prohull::cli {
namespace {

using std::filesystem::path;

/// Held while outputs appear, and for good by the thread that ends the program.
std::mutex g_mutex;
std::vector<path> g_temporaries, g_folders;
std::atomic<bool> g_any_has_appeared = false;

[[noreturn]] void fail_to_write(const path& target, const std::string& why) {
  throw InputError(Defect::CannotWrite, fmt::format("{}: cannot write: {}", output_name(target), why));
}

[[noreturn]] void fail_to_write(const path& target) { fail_to_write(target, std::generic_category().message(errno)); }

class Descriptor {
 public:
  Descriptor(const path& file, int flags) : descriptor_(open(file.c_str(), flags | O_CLOEXEC, S_IRUSR | S_IWUSR)) {
    if (descriptor_ < 0) fail_to_write(file);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(descriptor_); }
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

bool is_stream(const path& target) {
  std::error_code error;
  const auto status = std::filesystem::status(target, error);
  return is_standard_stream(target) || (exists(status) && !is_regular_file(status) && !is_directory(status));
}

/// Where links lead, also one to a file that is not there yet. A pipe, as /dev/stdin may be, has no canonical name.
path resolved(path file) {
  constexpr int kMostLinks = 40;  // as Linux follows
  std::error_code error;
  file = absolute(file, error);
  for (int links = 0; links < kMostLinks && is_symlink(file, error) && !exists(file, error); ++links)
    file = file.parent_path() / read_symlink(file, error);
  path canonical = weakly_canonical(file, error);
  return error ? file : canonical;
}

/// A text that is the same for all names of a file, hard links included. Standard input and output may be one terminal.
std::string identity(const path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode))
    return fmt::format("{}:{}", status.st_dev, status.st_ino);
  return resolved(file).string();
}

path temporary_for(const path& target, const std::string& suffix) {
  constexpr std::size_t kLongest = 100;  // of 255 bytes: a name beside this one is longer
  std::random_device random;
  const std::string tail = fmt::format(".{:08x}{:08x}.unfinished{}", random(), random(), suffix);
  if (is_stream(target)) return std::filesystem::temp_directory_path() / ("prohull" + tail);
  return resolved(target).replace_filename("." + target.stem().string().substr(0, kLongest) + tail);
}

bool is_replaced(const path& target) { return std::filesystem::is_regular_file(target) && !is_stream(target); }

/// Until it appears, nobody else reads what goes to a stream, or into a file that others may not read. Whoever writes
/// the file keeps its mode. That of a new one, or of a folder, is the system's.
void prepare(const path& temporary, const path& target) {
  if (is_stream(target) || is_replaced(target)) Descriptor(temporary, O_WRONLY | O_CREAT | O_EXCL);
}

/// Together with what a writer left beside it, whose name begins alike.
void remove_all_of(const path& temporary) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(temporary.parent_path(), ignored))
    if (entry.path().filename().string().starts_with(temporary.filename().string()))
      std::filesystem::remove_all(entry.path(), ignored);
}

/// Removes the folders that are empty. The deepest come last.
void remove_folders(const std::vector<path>& folders) {
  std::error_code ignored;
  for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) std::filesystem::remove(*folder, ignored);
}

void write_all(int to, const char* bytes, std::size_t size, const path& target) {
  while (size > 0) {
    const ssize_t written = write(to, bytes, size);
    if (written < 0 && errno != EINTR) fail_to_write(target);
    if (written < 0) continue;
    bytes += written, size -= static_cast<std::size_t>(written);
  }
}

/// The file has no name meanwhile, so that nothing of it stays if the reader of a pipe goes away.
void pour(const path& temporary, const path& target) {
  const Descriptor from(temporary, O_RDONLY);
  std::filesystem::remove(temporary);
  std::array<char, 1 << 16> bytes;
  const auto copy_to = [&](int to) {
    while (const ssize_t size = read(from.get(), bytes.data(), bytes.size())) {
      if (size < 0) fail_to_write(target);
      write_all(to, bytes.data(), static_cast<std::size_t>(size), target);
    }
  };
  if (is_standard_stream(target))
    copy_to(STDOUT_FILENO);
  else
    copy_to(Descriptor(target, O_WRONLY).get());
}

/// "ply" of ".ply"
std::vector<std::string> formats_of(const OutputKind& kind) {
  std::vector<std::string> formats;
  for (const std::string& suffix : kind.suffixes) formats.push_back(suffix.substr(1));
  return formats;
}

void require_writable(const path& file) {
  if (file.empty() || is_stream(file)) return;
  const path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder))
    fail_to_write(file, fmt::format("{} is a file and no folder; choose another name", folder.string()));
  if (!std::filesystem::is_directory(folder))
    fail_to_write(file, fmt::format("there is no folder {}; create it first", folder.string()));
  if (std::filesystem::is_directory(file)) fail_to_write(file, "it is a folder; name a file in it");
  if (access(folder.c_str(), W_OK) != 0)
    fail_to_write(file, fmt::format("{} takes no files from you; choose another folder", folder.string()));
}

}  // namespace

Outputs::~Outputs() {
  const std::lock_guard lock(g_mutex);
  for (const Pending& pending : pending_) {
    remove_all_of(pending.temporary);
    std::erase(g_temporaries, pending.temporary);
  }
  remove_folders(folders_);
  for (const path& folder : folders_) std::erase(g_folders, folder);
}

void Outputs::add_folder(const path& folder) {
  std::error_code error;
  if (folder.empty() || std::filesystem::is_directory(folder, error)) return;
  add_folder(folder.parent_path());
  const std::lock_guard lock(g_mutex);
  std::filesystem::create_directory(folder, error);
  if (error == std::errc::file_exists) fail_to_write(folder, "a file has that name; name another folder");
  if (error) fail_to_write(folder, error.message());
  folders_.push_back(folder), g_folders.push_back(folder);
}

bool Outputs::add(const path& target, const std::string& suffix, const std::function<bool(const path&)>& write) {
  if (target.empty()) return true;
  stop_if_interrupted();
  const path temporary = temporary_for(target, suffix);
  {
    const std::lock_guard lock(g_mutex);
    pending_.push_back({target, temporary});
    g_temporaries.push_back(temporary);
  }
  try {
    prepare(temporary, target);
    if (write(temporary)) return true;
  } catch (const InputError& error) {  // which names the file that we see, not the one that the user knows
    std::string what = error.what();
    if (const auto at = what.find(temporary.string()); at != std::string::npos)
      what.replace(at, temporary.string().size(), target.string());
    throw InputError(error.defect(), what);
  }
  remove_all_of(temporary);
  pending_.pop_back();
  return false;
}

void Outputs::add(const path& target, std::string_view bytes) {
  add(target, "", [&](const path& file) { return robot::write_text(file, bytes), true; });
}

bool Outputs::add(const path& target, const std::string& suffix, const TriangleMesh& mesh) {
  return add(target, suffix, [&](const path& file) {
    write_mesh(file, mesh);
    return holds_triangles_of(file, mesh);
  });
}

void Outputs::add_report(const path& target, nlohmann::json report) {
  if (target.empty()) return;
  report["version"] = PROHULL_VERSION;
  add(target, report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void Outputs::put_last_first() {
  const std::lock_guard lock(g_mutex);
  std::rotate(pending_.begin(), std::prev(pending_.end()), pending_.end());
}

void Outputs::commit() {
  {
    const std::lock_guard lock(g_mutex);
    stop_if_interrupted();
    for (const auto& [target, temporary] : pending_)
      if (!is_stream(target)) {
        std::error_code error;
        if (is_replaced(target))
          std::filesystem::permissions(temporary, std::filesystem::status(target).permissions(), error);
        std::filesystem::rename(temporary, resolved(target), error);
        if (error) fail_to_write(target, error.message());
        g_any_has_appeared = true;
      }
  }
  for (const auto& [target, temporary] : pending_)  // who reads a pipe may take his time
    if (is_stream(target)) pour(temporary, target), g_any_has_appeared = true;
}

bool has_any_output_appeared() { return g_any_has_appeared; }

bool holds_triangles_of(const path& file, const TriangleMesh& mesh) { return has_triangles_of(read_mesh(file), mesh); }

void remove_unfinished_outputs() {
  g_mutex.lock();
  for (const path& temporary : g_temporaries) remove_all_of(temporary);
  remove_folders(g_folders);
}

bool is_standard_stream(const path& file) { return file == "-"; }

void check_files(const std::vector<path>& inputs, const std::vector<path>& outputs) {
  if (std::ranges::count_if(inputs, is_standard_stream) > 1)
    refuse("standard input (-) is named twice, but can be read only once; save one of the files first");
  std::map<std::string, path> named;
  for (const path& input : inputs)
    if (!input.empty() && !is_standard_stream(input)) named.emplace(identity(input), input);
  for (const path& output : outputs) {
    if (output.empty()) continue;
    const bool is_standard = is_standard_stream(output);
    const auto& [other, is_new] = named.emplace(is_standard ? output.string() : identity(output), output);
    if (!is_new && is_standard)
      refuse("standard output (-) is named twice, but takes one file only; name another file");
    if (!is_new && other->second == output)
      refuse(fmt::format("{} is named twice, and would be overwritten; choose another name", output.string()));
    if (!is_new)
      refuse(fmt::format("{} and {} are one file, which would be overwritten; choose another name",
                         other->second.string(), output.string()));
    require_writable(output);
    if (is_standard) console().summary = stderr;
  }
}

OutputKind mesh_outputs() { return {"meshes", written_mesh_extensions()}; }

void add_mesh_output_options(CLI::App& command, path& out, std::string& format, const std::string& what) {
  add_value(command, "-o,--out", out, "OUT",
            fmt::format("File for {}. Its name ends in {}, which tells the format. With - it goes to standard output.",
                        what, alternatives(mesh_outputs().suffixes)))
      ->required();
  add_out_format_option(command, format, mesh_outputs());
}

CLI::Option* add_out_format_option(CLI::App& command, std::string& format, const OutputKind& kind) {
  const std::vector<std::string> formats = formats_of(kind);
  return add_value(command, "--out-format", format, CLI::detail::join(formats, "|"),
                   "Format of the output, where its name does not tell it: the name - does not.")
      ->transform(one_of("--out-format", formats));
}

path path_for(const path& pattern, std::size_t faces) {
  constexpr std::string_view kFacesInName = "{faces}";
  std::string name = pattern.string();
  if (const auto at = name.find(kFacesInName); at != std::string::npos)
    name.replace(at, kFacesInName.size(), std::to_string(faces));
  return name;
}

void flush_standard_output() {
  const bool has_failed = std::ferror(stdout) != 0;
  if (std::fflush(stdout) != 0) {
    if (errno != EPIPE) fail_to_write("-");  // a reader who goes away has seen enough
  } else if (has_failed) {
    fail_to_write("-", "a part of what was printed is missing");
  }
}

std::string output_name(const path& file) { return is_standard_stream(file) ? "standard output" : file.string(); }

std::string output_suffix(const path& file, const OutputKind& kind, const std::string& format) {
  const std::string suffix = lower_case_extension(file);
  const bool is_known = std::ranges::find(kind.suffixes, suffix) != kind.suffixes.end();
  if (is_known && !format.empty() && suffix != "." + format)
    refuse(fmt::format("{}: its name ends in {}, but --out-format says {}; make them agree", file.string(), suffix,
                       format));
  if (is_known) return suffix;
  if (!format.empty()) return "." + format;
  if (is_standard_stream(file))
    refuse(fmt::format("standard output (-) has no name that tells its format; add --out-format {}",
                       alternatives(formats_of(kind))));
  refuse(fmt::format("{}: {} are not written to {}; name the file {}", file.string(), kind.what,
                     suffix.empty() ? "files without a suffix" : suffix + " files", alternatives(kind.suffixes)));
}

}  // namespace prohull::cli
