#include "prohull/detail/run_program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "prohull/error.h"

extern char** environ;

namespace prohull {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void fail_with_errno(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

class Descriptor {
 public:
  /// Takes over what a system call has returned.
  Descriptor(int number, const char* call) : number_(number) {
    if (number_ < 0) fail_with_errno(call);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }

 private:
  int number_;
};

/// A copy above the three standard ones, which a program that runs without them would otherwise get in the way of.
int above_standard(int descriptor) { return fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1); }

class MemoryFile {
 public:
  int number() const { return file_.number(); }

  std::size_t size() const {
    struct stat status {};
    fstat(number(), &status);
    return static_cast<std::size_t>(status.st_size);
  }

  std::string text() const {
    std::string text(size(), '\0');
    std::size_t size = 0;
    while (size < text.size()) {
      const ssize_t count = pread(number(), text.data() + size, text.size() - size, static_cast<off_t>(size));
      if (count <= 0) break;
      size += static_cast<std::size_t>(count);
    }
    text.resize(size);
    return text;
  }

 private:
  Descriptor file_{above_standard(Descriptor(memfd_create("prohull", MFD_CLOEXEC), "memfd_create").number()), "fcntl"};
};

void write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) fail_with_errno("write");
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// What posix_spawn is told, freed in any case.
class SpawnPlan {
 public:
  /// `errors` may be nullptr.
  SpawnPlan(int input, int output, const MemoryFile* errors) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    if (errors)
      posix_spawn_file_actions_adddup2(&actions_, errors->number(), STDERR_FILENO);
    else
      posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&actions_, STDERR_FILENO + 1);
    posix_spawnattr_init(&attributes_);
    sigset_t signals;
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }

  /// 0 or an errno.
  int spawn(pid_t& pid, const std::filesystem::path& program, const std::vector<std::string>& arguments) const {
    std::vector<std::string> words = {program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    return posix_spawnp(&pid, program.c_str(), &actions_, &attributes_, argv.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

/// A program that was started; killed and waited for at the latest when the object ends.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (has_ended_) return;
    kill(pid_, SIGKILL);
    while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }

  /// Looks once whether the program has ended, without waiting for it.
  bool check_ended() {
    if (has_ended_) return true;
    int status = 0;
    const pid_t waited = waitpid(pid_, &status, WNOHANG);
    if (waited == pid_) status_ = status;
    return has_ended_ = waited == pid_ || (waited < 0 && errno != EINTR);
  }

  ProgramResult result(std::string output) const {
    using End = ProgramResult::End;
    if (!status_) return {End::Unknown, 0, std::move(output)};
    if (WIFEXITED(*status_)) return {End::Exited, WEXITSTATUS(*status_), std::move(output)};
    return {End::Signalled, WTERMSIG(*status_), std::move(output)};
  }

 private:
  pid_t pid_;
  bool has_ended_ = false;
  std::optional<int> status_;
};

/// Waits for at most a twentieth of a second until there is something to be read, or nothing will ever be: then true.
bool wait_for_output(int descriptor) {
  constexpr int kMilliseconds = 50;
  pollfd what{descriptor, POLLIN, 0};
  return poll(&what, 1, kMilliseconds) > 0;
}

}  // namespace

ProgramResult run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                          std::string_view input, const ProgramLimits& limits,
                          const std::function<void(double)>& wait) {
  using End = ProgramResult::End;
  constexpr std::size_t kChunk = std::size_t{1} << 16;
  const MemoryFile stdin_file;
  std::optional<MemoryFile> errors;
  if (limits.errors > 0) errors.emplace();
  write_all(stdin_file.number(), input);
  lseek(stdin_file.number(), 0, SEEK_SET);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail_with_errno("pipe2");
  Descriptor read_end(ends[0], "pipe2"), low_write_end(ends[1], "pipe2");
  Descriptor write_end(above_standard(low_write_end.number()), "fcntl");
  low_write_end.close();

  pid_t pid = 0;
  if (const int error = SpawnPlan(stdin_file.number(), write_end.number(), errors ? &*errors : nullptr)
                            .spawn(pid, program, arguments))
    return {End::NotStarted, error, {}};
  Child child(pid);
  write_end.close();

  const auto start = Clock::now(), deadline = start + limits.time;
  const auto limit_reached = [&]() -> std::optional<End> {
    const auto now = Clock::now();
    if (wait) wait(std::chrono::duration<double>(now - start) / limits.time);
    if (now >= deadline) return End::TimedOut;
    return errors && errors->size() > limits.errors ? std::optional(End::TooMuchOutput) : std::nullopt;
  };
  std::string output;
  while (true) {
    if (const auto end = limit_reached()) return {*end, 0, {}};
    if (!wait_for_output(read_end.number())) continue;
    const std::size_t size = output.size();
    output.resize(size + kChunk);
    const ssize_t read = ::read(read_end.number(), output.data() + size, kChunk);
    output.resize(size + static_cast<std::size_t>(std::max<ssize_t>(read, 0)));
    if (output.size() > limits.output) return {End::TooMuchOutput, 0, {}};
    if (read == 0) break;
    if (read < 0 && errno != EINTR) fail_with_errno("read");
  }
  for (std::chrono::milliseconds pause(1); !child.check_ended();
       pause = std::min(2 * pause, std::chrono::milliseconds(50))) {
    if (const auto end = limit_reached()) return {*end, 0, {}};
    std::this_thread::sleep_for(pause);
  }
  ProgramResult result = child.result(std::move(output));
  if (result.end == End::Signalled && (result.number == SIGINT || result.number == SIGTERM)) throw Cancelled();
  if (errors) result.errors = errors->text();
  return result;
}

}  // namespace prohull
