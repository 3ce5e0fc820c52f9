#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace prohull::bench {

// Another program in a process of its own, which may crash, hang or want all memory.

struct ProgramLimits {
  unsigned seconds;           ///< on the wall
  std::size_t address_bytes;  ///< of address space
};

struct ProgramEnd {
  int exit_code = 0;             ///< meaningful if `failure` is empty
  std::string failure;           ///< "signal 11", or "more than 60 s"; empty if it came to an end by itself
  std::vector<std::string> err;  ///< the lines of its stderr
  double seconds = 0;            ///< on the wall
  std::size_t peak_bytes = 0;    ///< of resident memory; at least what this program has
};

/// Runs `words[0]` with the others as its arguments, and ends whatever it leaves running. Any thread may call it.
ProgramEnd run_program(std::vector<std::string> words, const ProgramLimits& limits);

}  // namespace prohull::bench
