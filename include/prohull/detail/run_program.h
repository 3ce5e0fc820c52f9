#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace prohull {

/// How a program came to its end, and what it had written by then.
struct ProgramResult {
  enum class End {
    NotStarted,     ///< `number` is the system's errno
    Exited,         ///< `number` is its exit code
    Signalled,      ///< `number` is the signal, which it did not get from here
    TimedOut,       ///< killed here
    TooMuchOutput,  ///< killed here
    Unknown,        ///< somebody else took its exit code, as SIGCHLD set to SIG_IGN does
  };
  End end;
  int number;
  std::string output;
  std::string errors = {};  ///< as far as ProgramLimits asks for them
};

struct ProgramLimits {
  std::chrono::milliseconds time;
  std::size_t output;
  std::size_t errors = 0;  ///< 0: they go to /dev/null
};

/// Runs a program, which PATH tells where it is, without a shell: `input` is its standard input, its standard output is
/// returned. It inherits nothing else: no other open file, no signal mask, no ignored signals. It is waited for in any
/// case, so that no zombie is left, and killed before, if it exceeds a limit or if `wait`, called some 20 times a
/// second with the part of the time that is over, throws. Throws Cancelled if the program ends by Ctrl-C. Throws
/// std::system_error if the system is out of descriptors or memory. May be called from any thread.
ProgramResult run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                          std::string_view input, const ProgramLimits& limits, const std::function<void(double)>& wait);

}  // namespace prohull
