#pragma once

namespace oneapi::tbb {

class task_arena {
 public:
  explicit task_arena(int) {}
  template <class Work>
  auto execute(Work&& work) {
    return work();
  }
};

namespace this_task_arena {

inline int max_concurrency() { return 1; }

template <class Work>
auto isolate(Work&& work) {
  return work();
}

}  // namespace this_task_arena

}  // namespace oneapi::tbb
