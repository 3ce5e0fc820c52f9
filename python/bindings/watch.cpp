#include "watch.h"

#include <chrono>
#include <future>

#include "prohull/detail/refuse.h"

namespace prohull::python {
namespace {

void tell(const pybind11::object& progress, const std::string& stage, double fraction) {
  pybind11::detail::make_caster<bool> goes_on;  // of bools, and numpy's, alone
  if (progress.is_none() || !goes_on.load(progress(stage, fraction), false) || goes_on) return;
  PyErr_SetString(PyExc_KeyboardInterrupt, "progress returned False");
  throw pybind11::error_already_set();
}

}  // namespace

void watch_over(const pybind11::object& progress, const std::function<void(Watch&)>& work) {
  constexpr std::chrono::milliseconds kLook{50};
  if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0)
    refuse("progress=" + std::string(pybind11::repr(progress)) +
           ": expected a function of a stage and a fraction, or None");
  Watch watch;
  tell(progress, "start", 0);
  std::future<void> result = std::async(std::launch::async, [&] { work(watch); });
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
    result.get();
    tell(progress, "done", 1);
  } catch (const Cancelled&) {  // Ctrl-C has also reached a program that was reading the file
    if (PyErr_CheckSignals() == 0) PyErr_SetString(PyExc_KeyboardInterrupt, "interrupted");
    throw pybind11::error_already_set();
  }
}

}  // namespace prohull::python
