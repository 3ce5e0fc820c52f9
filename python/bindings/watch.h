#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "prohull/progress.h"

namespace prohull::python {

/// What passes between work in C++ and the thread of Python that waits for it.
class Watch {
 public:
  /// For the work.
  Progress progress() {
    return [this](std::string_view stage, double fraction) {
      const std::scoped_lock lock(mutex_);
      stage_ = stage, fraction_ = fraction;
      return !stopped_;
    };
  }
  void stop() {
    const std::scoped_lock lock(mutex_);
    stopped_ = true;
  }
  std::pair<std::string, double> state() {
    const std::scoped_lock lock(mutex_);
    return {stage_, fraction_};
  }

 private:
  std::mutex mutex_;
  std::string stage_ = "start";
  double fraction_ = 0;
  bool stopped_ = false;
};

/// work(watch), on a thread of its own and without the GIL. The calling thread looks for Ctrl-C some 20 times a second
/// and tells `progress` how it goes, so that Python runs on no other thread. If either throws, the work is stopped and
/// waited for, and the exception goes on: what progress(stage, fraction) throws, and KeyboardInterrupt where it returns
/// False, or numpy's.
void watch_over(const pybind11::object& progress, const std::function<void(Watch&)>& work);

/// The same, for what the work returns.
template <class Work>
auto watched(const pybind11::object& progress, Work work) {
  std::optional<std::invoke_result_t<Work&, Watch&>> made;
  watch_over(progress, [&](Watch& watch) { made.emplace(work(watch)); });
  return std::move(*made);
}

/// The same of work(options), which tell how far it is.
template <class Options, class Work>
auto watched(const pybind11::object& progress, Options options, Work work) {
  return watched(progress, [&](Watch& watch) {
    options.progress = watch.progress();
    return work(std::as_const(options));
  });
}

}  // namespace prohull::python
