#pragma once

#include <chrono>
#include <future>

namespace prohull {

/// Runs `work` on a thread of its own. Until it ends, calls `meanwhile` on this thread, again and again. Throws what
/// either throws, once the work has ended.
template <class Work, class Meanwhile>
void run_beside(Work work, Meanwhile meanwhile, std::chrono::nanoseconds interval) {
  auto done = std::async(std::launch::async, work);
  while (done.wait_for(interval) != std::future_status::ready) meanwhile();
  done.get();
}

}  // namespace prohull
