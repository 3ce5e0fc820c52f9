#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "prohull/error.h"
#include "prohull/progress.h"

namespace prohull {

/// Tells a Progress of one stage of the work, and keeps what progress.h promises: work may call at() from any thread as
/// often as it likes.
class ProgressMeter {
 public:
  /// Between two calls of the Progress. Tests set it to 0, so that what they count does not hang on the clock.
  inline static std::chrono::nanoseconds interval = std::chrono::milliseconds(20);

  ProgressMeter(Progress progress, std::string stage) : progress_(std::move(progress)), stage_(std::move(stage)) {}

  /// So much is done; what is less than before asks only whether to go on. Throws Cancelled on every thread once the
  /// Progress has returned false.
  void at(double fraction) {
    if (cancelled_) throw Cancelled();
    if (!progress_ || std::this_thread::get_id() != caller_) return;
    const auto now = std::chrono::steady_clock::now();
    fraction_ = std::clamp(fraction, fraction_, 1.0);
    if (has_told_ && fraction < 1 && now - told_ < interval) return;
    has_told_ = true, told_ = now;
    if (progress_(stage_, fraction_)) return;
    cancelled_ = true;
    throw Cancelled();
  }
  /// Asks whether to go on where a step takes long.
  void go_on() { at(0.0); }
  void at(std::size_t done, std::size_t all) {
    at(static_cast<double>(done) / static_cast<double>(std::max({done, all, std::size_t{1}})));
  }

  /// For a function that does a part of the work: what it tells as [0, 1] is told as [from, to] of this stage.
  Progress part(double from, double to) {
    return [this, from, to](std::string_view, double fraction) {
      at(from + fraction * (to - from));
      return true;
    };
  }

 private:
  const Progress progress_;
  const std::string stage_;
  const std::thread::id caller_ = std::this_thread::get_id();
  std::chrono::steady_clock::time_point told_;
  bool has_told_ = false;
  double fraction_ = 0;
  std::atomic<bool> cancelled_ = false;
};

/// For work of which one item after another is done: asks every 64th time only.
class ProgressCounter {
 public:
  ProgressCounter(Progress progress, std::string stage, std::size_t all)
      : meter_(std::move(progress), std::move(stage)), all_(all) {}
  void next() {
    constexpr std::size_t kInterval = 64;
    if (done_++ % kInterval == 0) meter_.at(done_, all_);
  }
  void finish() { meter_.at(1); }
  /// For steps that take long.
  ProgressMeter& meter() { return meter_; }

 private:
  ProgressMeter meter_;
  const std::size_t all_;
  std::size_t done_ = 0;
};

}  // namespace prohull
