#include "robot/files/xacro.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <system_error>
#include <thread>

#include "prohull/error.h"

extern char** environ;

namespace prohull::robot {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostOutput = std::size_t{1} << 28;  // bytes
constexpr std::size_t kMostErrors = 2000;                  // bytes of them in messages

bool has_macro(const XmlElement& element) {
  const auto is_macro = [](const auto& attribute) {
    return attribute.second.find("${") != std::string::npos || attribute.second.find("$(") != std::string::npos;
  };
  return element.name.starts_with("xacro:") || std::ranges::any_of(element.attributes, is_macro) ||
         std::ranges::any_of(element.children, [](const XmlElement* child) { return has_macro(*child); });
}

/// A file in memory that a program writes to.
class MemoryFile {
 public:
  MemoryFile() {
    const int low = memfd_create("xacro", MFD_CLOEXEC);
    if (low < 0) throw std::system_error(errno, std::generic_category(), "memfd_create");
    descriptor_ = fcntl(low, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);  // not among the three that the program gets
    close(low);
    if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "fcntl");
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { close(descriptor_); }

  int descriptor() const { return descriptor_; }

  std::size_t size() const {
    struct stat status {};
    fstat(descriptor_, &status);
    return static_cast<std::size_t>(status.st_size);
  }

  std::string text() const {
    std::string text(size(), '\0');
    std::size_t read = 0;
    while (read < text.size()) {
      const ssize_t count = pread(descriptor_, text.data() + read, text.size() - read, static_cast<off_t>(read));
      if (count <= 0) break;
      read += static_cast<std::size_t>(count);
    }
    text.resize(read);
    return text;
  }

 private:
  int descriptor_ = -1;
};

/// Starts xacro with nothing to read, without other open files, ignored signals or a signal mask. 0 or an errno.
int spawn(pid_t& pid, const std::string& file, const MemoryFile& output, const MemoryFile& errors) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, output.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors.descriptor(), STDERR_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  sigfillset(&signals);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  std::string program = "xacro", argument = file;
  char* const argv[] = {program.data(), argument.data(), nullptr};
  const int error = posix_spawnp(&pid, program.c_str(), &actions, &attributes, argv, environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

int wait_for(pid_t pid) {
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw InputError(Defect::Malformed, fmt::format("{}: {}", file.string(), why));
}

/// The status of the program as waitpid has it, or an error if it exceeds a limit.
int wait_within_limits(pid_t pid, const std::filesystem::path& file, const MemoryFile& output, const MemoryFile& errors,
                       std::chrono::seconds time) {
  const auto deadline = Clock::now() + time;
  int status = 0;
  for (std::chrono::milliseconds pause(1); waitpid(pid, &status, WNOHANG) == 0;
       pause = std::min(2 * pause, std::chrono::milliseconds(50))) {
    const bool is_late = Clock::now() > deadline;
    if (is_late || std::max(output.size(), errors.size()) > kMostOutput) {
      kill(pid, SIGKILL);
      wait_for(pid);
      refuse(file, is_late ? fmt::format("xacro was stopped after {} s; expand the file by hand: xacro {} > robot.urdf",
                                         time.count(), file.string())
                           : "xacro was stopped: its output is too large for a robot");
    }
    std::this_thread::sleep_for(pause);
  }
  return status;
}

std::string trimmed(std::string text) {
  if (text.size() > kMostErrors) text = "..." + text.substr(text.size() - kMostErrors);
  text.resize(text.find_last_not_of(" \t\r\n") + 1);
  return text;
}

}  // namespace

/// The manifest of a package and a launch file have substitutions of their own.
bool is_xacro(const XmlDocument& document) {
  const std::string& root = document.root().name;
  return root != "package" && root != "launch" && has_macro(document.root());
}

void refuse_xacro(const std::filesystem::path& file) {
  throw InputError(Defect::UnknownFormat,
                   fmt::format("{0}: this is xacro, macros for URDF, and the program xacro is not installed; install "
                               "it (ros-<distro>-xacro, or pip install xacro), or expand the file elsewhere: "
                               "xacro {0} > robot.urdf",
                               file.string()));
}

std::string expanded_by_xacro(const std::filesystem::path& file, std::chrono::seconds time) {
  const MemoryFile output, errors;
  const std::string argument = file.string().starts_with('-') ? "./" + file.string() : file.string();
  pid_t pid = 0;
  const int error = spawn(pid, argument, output, errors);
  if (error == ENOENT) refuse_xacro(file);
  if (error != 0) refuse(file, fmt::format("the program xacro could not be started: {}", std::strerror(error)));
  const int status = wait_within_limits(pid, file, output, errors, time);
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGINT || WTERMSIG(status) == SIGTERM)) throw Cancelled();
  if (status != 0)
    refuse(file, fmt::format("xacro failed; if the file needs arguments, expand it by hand: xacro {} NAME:=VALUE > "
                             "robot.urdf. xacro says: {}",
                             file.string(), trimmed(errors.text())));
  return output.text();
}

}  // namespace prohull::robot
