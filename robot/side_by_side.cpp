#include "robot/side_by_side.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "prohull/error.h"

namespace prohull::robot {
namespace {

class Workers {
 public:
  Workers(std::size_t count, const std::function<void(std::size_t, const Progress&)>& work)
      : count_(count), work_(work), thrown_(count) {}

  void run() {
    const Progress go_on = [this](std::string_view, double) { return !cancelled_; };
    for (std::size_t i; !cancelled_ && !failed_ && (i = begun_++) < count_; ++done_) try {
        work_(i, go_on);
      } catch (...) {
        thrown_[i] = std::current_exception();
        failed_ = true;
      }
    const std::lock_guard lock(mutex_);
    ++stopped_;
    has_stopped_.notify_one();
  }

  /// Returns when `workers` have stopped.
  void tell(std::size_t workers, std::span<const std::string> names, const Progress& progress) {
    constexpr std::chrono::milliseconds kInterval(20);
    std::unique_lock lock(mutex_);
    while (!has_stopped_.wait_for(lock, kInterval, [&] { return stopped_ == workers; })) {
      const std::size_t last = std::clamp<std::size_t>(begun_, 1, count_) - 1;
      if (progress && !cancelled_ && !progress(names[last], double(done_) / double(count_))) cancelled_ = true;
    }
    if (progress && !cancelled_ && !failed_ && !progress(names.back(), 1)) cancelled_ = true;
  }

  void rethrow() const {
    if (cancelled_) throw Cancelled();
    for (const std::exception_ptr& thrown : thrown_)
      if (thrown) std::rethrow_exception(thrown);
  }

 private:
  const std::size_t count_;
  const std::function<void(std::size_t, const Progress&)>& work_;
  std::vector<std::exception_ptr> thrown_;
  std::atomic<std::size_t> begun_ = 0, done_ = 0;
  std::atomic<bool> cancelled_ = false, failed_ = false;
  std::mutex mutex_;
  std::condition_variable has_stopped_;
  std::size_t stopped_ = 0;
};

}  // namespace

std::size_t workers_for(std::size_t count, unsigned threads) {
  const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
  return std::min<std::size_t>(count, threads > 0 ? std::min(threads, cores) : cores);
}

void side_by_side(std::span<const std::string> names, unsigned threads, const Progress& progress,
                  const std::function<void(std::size_t, const Progress&)>& work) {
  if (names.empty()) return;
  const std::size_t count = workers_for(names.size(), threads);
  Workers workers(names.size(), work);
  // Threads of their own: the workers of oneTBB are one less than the cores, and the caller only waits.
  std::vector<std::jthread> running;
  for (std::size_t i = 0; i < count; ++i) running.emplace_back([&workers] { workers.run(); });
  workers.tell(count, names, progress);
  running.clear();
  workers.rethrow();
}

}  // namespace prohull::robot
