#pragma once

#include <chrono>
#include <ctime>
#include <string>
#include <utility>

namespace prohull::bench {

/// "prohull 0.1.0, GNU 12.2.0, AMD EPYC, 2 cores": goes with every figure.
std::string machine();

/// Of all threads of the program, since it started.
inline double processor_seconds() {
  std::timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The processor time, in seconds, that all threads of the program spend in `work`: what a clock on the wall shows for
/// one thread on an idle machine, on a busy machine too, and never flattered by threads.
template <class Work>
double seconds_of(Work&& work) {
  const double start = processor_seconds();
  std::forward<Work>(work)();
  return processor_seconds() - start;
}

/// Elapsed time: of work that several threads do.
template <class Work>
double elapsed_seconds_of(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  std::forward<Work>(work)();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace prohull::bench
