#include "prohull/detail/run_program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "io_testing.h"

namespace prohull {
namespace {

using namespace std::chrono_literals;
using End = ProgramResult::End;

constexpr ProgramLimits kLimits{60s, 1 << 20};

ProgramResult run_shell(const std::string& script, std::string_view input = {}, const ProgramLimits& limits = kLimits) {
  return run_program("/bin/sh", {"-c", script}, input, limits, {});
}

/// Whether this process has a child, running or not yet waited for.
bool has_children() { return waitpid(-1, nullptr, WNOHANG) == 0 || errno != ECHILD; }

class RunProgram : public testing::Test {
 protected:
  void TearDown() override { EXPECT_FALSE(has_children()); }
};

TEST_F(RunProgram, GivesInputAndReturnsOutputAndExitCode) {
  const std::string input(300000, 'x');
  const ProgramResult result = run_shell("cat; echo error >&2; exit 7", input);
  EXPECT_EQ(result.end, End::Exited);
  EXPECT_EQ(result.number, 7);
  EXPECT_EQ(result.output, input);
}

TEST_F(RunProgram, PassesArgumentsAsTheyAre) {
  EXPECT_EQ(run_program("/bin/echo", {"a b", "$HOME;ls"}, {}, kLimits, {}).output, "a b $HOME;ls\n");
}

TEST_F(RunProgram, TellsTheSignal) {
  const ProgramResult result = run_shell("kill -SEGV $$");
  EXPECT_EQ(result.end, End::Signalled);
  EXPECT_EQ(result.number, SIGSEGV);
}

TEST_F(RunProgram, TellsThatThereIsNone) {
  const ProgramResult result = run_program("/no/such/program", {}, {}, kLimits, {});
  EXPECT_EQ(result.end, End::NotStarted);
  EXPECT_EQ(result.number, ENOENT);
}

TEST_F(RunProgram, KillsWhatTakesTooLong) {
  EXPECT_EQ(run_shell("exec sleep 100", {}, {100ms, 100}).end, End::TimedOut);
  EXPECT_EQ(run_shell("exec >&-; exec sleep 100", {}, {100ms, 100}).end, End::TimedOut);
  EXPECT_EQ(run_shell("trap '' TERM INT; while true; do :; done", {}, {100ms, 100}).end, End::TimedOut);
}

TEST_F(RunProgram, KillsWhatWritesTooMuch) {
  EXPECT_EQ(run_shell("exec cat /dev/zero").end, End::TooMuchOutput);
  EXPECT_EQ(run_shell("printf 1234", {}, {60s, 4}).output, "1234");
  EXPECT_EQ(run_shell("printf 12345", {}, {60s, 4}).end, End::TooMuchOutput);
}

TEST_F(RunProgram, IsCancelledAtOnce) {
  int calls = 0;
  const auto wait = [&](double) {
    if (++calls == 3) throw Cancelled();
  };
  EXPECT_THROW(run_program("/bin/sleep", {"100"}, {}, kLimits, wait), Cancelled);
  EXPECT_EQ(calls, 3) << "it waits on";
  EXPECT_THROW(run_shell("kill -INT $$"), Cancelled);
}

TEST_F(RunProgram, InheritsNeitherFilesNorSignals) {
  const int open_file = open("/dev/null", O_RDONLY);  // without O_CLOEXEC
  std::signal(SIGPIPE, SIG_IGN);
  EXPECT_EQ(run_shell("ls /proc/self/fd | wc -l").output, "4\n");  // 0, 1, 2, and the folder itself
  const std::string ignored = run_shell("grep SigIgn: /proc/self/status | cut -f 2").output;
  EXPECT_EQ(std::stoull(ignored, nullptr, 16) >> (SIGPIPE - 1) & 1, 0u) << ignored;
  std::signal(SIGPIPE, SIG_DFL);
  close(open_file);
}

TEST_F(RunProgram, LeavesNoFileOpen) {
  const auto open_files = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator());
  };
  const auto before = open_files();
  run_shell("cat", "x");
  run_shell("exec sleep 100", {}, {10ms, 100});
  run_program("/no/such/program", {}, {}, kLimits, {});
  EXPECT_EQ(open_files(), before);
}

TEST_F(RunProgram, DoesWithoutStandardFiles) {
  const int saved = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 10);
  close(STDIN_FILENO);
  EXPECT_EQ(run_shell("cat", "abc").output, "abc");
  if (saved >= 0) dup2(saved, STDIN_FILENO), close(saved);
}

TEST_F(RunProgram, IsRunByManyThreads) {
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([i] {
      const std::string text = std::to_string(i);
      for (int j = 0; j < 5; ++j) EXPECT_EQ(run_shell("cat", text).output, text);
    });
  for (std::thread& thread : threads) thread.join();
}

TEST_F(RunProgram, IsNotConfusedByIgnoredChildren) {
  std::signal(SIGCHLD, SIG_IGN);
  const ProgramResult result = run_shell("echo abc");
  std::signal(SIGCHLD, SIG_DFL);
  EXPECT_EQ(result.output, "abc\n");
  EXPECT_EQ(result.end, End::Unknown);
}

}  // namespace
}  // namespace prohull
