#pragma once

#include <chrono>

namespace prohull {

/// On the only thread that there is.
template <class Work, class Meanwhile>
void run_beside(Work work, Meanwhile, std::chrono::nanoseconds) {
  work();
}

}  // namespace prohull
