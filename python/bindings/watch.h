#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <future>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "prohull/error.h"
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

/// Calls progress(stage, fraction); throws what it throws, and KeyboardInterrupt where it returns False.
inline void tell(const pybind11::object& progress, const std::string& stage, double fraction) {
  if (progress.is_none() || !progress(stage, fraction).is(pybind11::bool_(false))) return;
  PyErr_SetString(PyExc_KeyboardInterrupt, "progress returned False");
  throw pybind11::error_already_set();
}

/// work(watch), on a thread of its own and without the GIL. The calling thread looks for Ctrl-C some 20 times a second
/// and tells `progress` how it goes, so that Python runs on no other thread. If either throws, the work is stopped and
/// waited for, and the exception goes on.
template <class Work>
auto watched(const pybind11::object& progress, Work work) {
  constexpr std::chrono::milliseconds kLook{50};
  Watch watch;
  tell(progress, "start", 0);
  auto result = std::async(std::launch::async, [&] { return work(watch); });
  const auto is_ready_after = [&](auto time) {
    const pybind11::gil_scoped_release released;
    return result.wait_for(time) == std::future_status::ready;
  };
  while (!is_ready_after(kLook)) try {
      if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
      const auto [stage, fraction] = watch.state();
      tell(progress, stage, fraction);
    } catch (...) {
      watch.stop();
      const pybind11::gil_scoped_release released;
      result.wait();
      throw;
    }
  try {
    auto made = result.get();
    tell(progress, "done", 1);
    return made;
  } catch (const Cancelled&) {  // Ctrl-C has also reached a program that was reading the file
    if (PyErr_CheckSignals() == 0) PyErr_SetString(PyExc_KeyboardInterrupt, "interrupted");
    throw pybind11::error_already_set();
  }
}

}  // namespace prohull::python
