#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <string_view>
#include <thread>

#include "prohull/detail/progress_meter.h"

namespace prohull {

/// While it lives, progress is told whenever there is any, so that what tests count does not hang on the clock.
class UnthrottledProgress {
 public:
  UnthrottledProgress() { ProgressMeter::interval = std::chrono::nanoseconds(0); }
  ~UnthrottledProgress() { ProgressMeter::interval = before_; }

 private:
  const std::chrono::nanoseconds before_ = ProgressMeter::interval;
};

/// Checks what progress.h promises of work that has one stage, and cancels the work at its `last` call.
class ProgressCheck {
 public:
  explicit ProgressCheck(std::string stage, int last = -1) : stage_(std::move(stage)), last_(last) {}

  Progress progress() {
    return [this](std::string_view stage, double fraction) {
      EXPECT_EQ(stage, stage_);
      EXPECT_EQ(std::this_thread::get_id(), caller_);
      EXPECT_GE(fraction, fraction_) << "it runs back";
      EXPECT_LE(fraction, 1);
      fraction_ = fraction;
      return ++calls_ != last_;
    };
  }
  int calls() const { return calls_; }
  double fraction() const { return fraction_; }

 private:
  const std::string stage_;
  const std::thread::id caller_ = std::this_thread::get_id();
  const int last_;
  int calls_ = 0;
  double fraction_ = 0;
};

/// work(progress) tells at least so many times how far it is, and throws Cancelled at whichever call asks it to.
template <class Work>
void expect_progress(const std::string& stage, int least_calls, Work&& work) {
  const UnthrottledProgress unthrottled;
  ProgressCheck whole(stage);
  work(whole.progress());
  EXPECT_GE(whole.calls(), least_calls);
  EXPECT_GT(whole.fraction(), 0.5) << "it moves";
  for (const int last : {1, 2, least_calls / 2, least_calls}) {
    if (last < 1) continue;
    ProgressCheck cancelled(stage, last);
    EXPECT_THROW(work(cancelled.progress()), Cancelled) << "at call " << last;
    EXPECT_EQ(cancelled.calls(), last) << "it goes on";
  }
}

}  // namespace prohull
