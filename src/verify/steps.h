#pragma once

#include <cstddef>

#include "prohull/detail/progress_meter.h"

namespace prohull::verify {

/// A decision would take more steps than it may.
struct OutOfSteps {};

/// Counts the steps of a search: pairs of segments, of triangles or boxes, balls around a point; and more where rounded
/// numbers do not decide.
class Steps {
 public:
  Steps(ProgressMeter& meter, std::size_t most) : meter_(meter), most_(most) {}

  std::size_t taken() const { return taken_; }
  /// Asks the meter now and then whether to go on. Throws OutOfSteps.
  void take(std::size_t count) {
    if (!may_take(count)) throw OutOfSteps();
  }
  /// The same, but false where no steps are left.
  bool may_take(std::size_t count) {
    constexpr std::size_t kInterval = 256;
    taken_ += count;
    if (taken_ > most_) return false;
    if (taken_ < asked_ + kInterval) return true;
    asked_ = taken_;
    meter_.go_on();
    return true;
  }

 private:
  ProgressMeter& meter_;
  const std::size_t most_;
  std::size_t taken_ = 0, asked_ = 0;
};

}  // namespace prohull::verify
