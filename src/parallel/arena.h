#pragma once

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <list>
#include <map>
#include <mutex>
#include <utility>

namespace prohull {

/// Lends the arenas of the process, by their numbers of threads, and keeps them. An arena that is destroyed
/// stays in memory for as long as a worker is asked for that did not get to run: on a busy machine, that is every
/// arena. Each is lent to one call at a time, so that calls neither wait for each other nor take up each other's tasks:
/// there are as many arenas as calls that ran at the same time. They decide nothing but which threads work.
class ArenaPool {
 public:
  using Arenas = std::list<oneapi::tbb::task_arena>;  // moves from list to list without allocation

  static ArenaPool& of_process() {
    static ArenaPool& pool = *new ArenaPool;  // threads may still work while the process ends
    return pool;
  }

  /// One.
  Arenas take(int threads) {
    Arenas lent;
    const std::lock_guard lock(mutex_);
    Arenas& idle = idle_[threads];
    if (idle.empty()) idle.emplace_back(threads);
    lent.splice(lent.end(), idle, idle.begin());
    return lent;
  }

  void put_back(int threads, Arenas lent) {
    const std::lock_guard lock(mutex_);
    Arenas& idle = idle_[threads];
    idle.splice(idle.begin(), lent);
  }

  void give_up_idle() {
    const std::lock_guard lock(mutex_);
    idle_.clear();
  }

 private:
  std::mutex mutex_;
  std::map<int, Arenas> idle_;
};

/// An arena of the pool, for as long as this lives.
class LentArena {
 public:
  explicit LentArena(int threads) : threads_(threads), arena_(ArenaPool::of_process().take(threads)) {}
  LentArena(const LentArena&) = delete;
  LentArena& operator=(const LentArena&) = delete;
  ~LentArena() { ArenaPool::of_process().put_back(threads_, std::move(arena_)); }

  template <class Work>
  auto execute(Work&& work) {
    return arena_.front().execute(std::forward<Work>(work));
  }

 private:
  int threads_;
  ArenaPool::Arenas arena_;
};

/// For so many `threads`, and no more than cores; 0: one for each core.
inline LentArena arena_of(unsigned threads) {
  const int cores = oneapi::tbb::this_task_arena::max_concurrency();
  return LentArena(threads == 0 ? cores : static_cast<int>(std::min(threads, static_cast<unsigned>(cores))));
}

}  // namespace prohull
