#include "program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <sstream>
#include <stdexcept>

#include "apart.h"
#include "machine.h"

namespace prohull::bench {
namespace {

/// In the child, where only what is safe in signal handlers may be called. Alarms outlive exec.
[[noreturn]] void become(char* const* words, int err, const ProgramLimits& limits) {
  setpgid(0, 0);
  const rlimit address_space{limits.address_bytes, limits.address_bytes}, no_core{0, 0};
  setrlimit(RLIMIT_AS, &address_space);
  setrlimit(RLIMIT_CORE, &no_core);
  const int nothing = open("/dev/null", O_RDWR);
  dup2(nothing, STDIN_FILENO);
  dup2(nothing, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  alarm(limits.seconds);
  execv(words[0], words);
  constexpr int kNotFound = 127;
  _exit(kNotFound);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

ProgramEnd run_program(std::vector<std::string> words, const ProgramLimits& limits) {
  std::vector<char*> arguments(words.size() + 1);
  std::ranges::transform(words, arguments.begin(), [](std::string& word) { return word.data(); });
  const File err = temporary_file();
  ProgramEnd end;
  int status = 0;
  rusage usage{};
  end.seconds = elapsed_seconds_of([&] {
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no process can be started");
    if (child == 0) become(arguments.data(), fileno(err.get()), limits);
    if (wait4(child, &status, 0, &usage) != child) throw std::runtime_error("a process was lost");
    kill(-child, SIGKILL);  // what it has started
  });
  end.peak_bytes = std::size_t(usage.ru_maxrss) * 1024;
  end.err = lines_of(text_of(err.get()));
  if (WIFEXITED(status))
    end.exit_code = WEXITSTATUS(status);
  else if (WTERMSIG(status) == SIGALRM)
    end.failure = fmt::format("more than {} s", limits.seconds);
  else
    end.failure = fmt::format("signal {}", WTERMSIG(status));
  return end;
}

}  // namespace prohull::bench
