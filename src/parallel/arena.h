#pragma once

#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace prohull {

/// For so many `threads`, and no more than cores; 0: one for each core.
inline oneapi::tbb::task_arena arena_of(unsigned threads) {
  const int cores = oneapi::tbb::this_task_arena::max_concurrency();
  return oneapi::tbb::task_arena(threads == 0 ? cores
                                              : static_cast<int>(std::min(threads, static_cast<unsigned>(cores))));
}

}  // namespace prohull
