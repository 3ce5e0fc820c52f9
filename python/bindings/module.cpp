// prohull._prohull: what the Python package needs of the library. Arguments arrive checked and converted by the
// package; see its _prohull.pyi for the types.
#include "module.h"

#include <oneapi/tbb/global_control.h>

#include <new>

#include "prohull/detail/missing_file.h"
#include "prohull/detail/threads.h"

namespace {

/// Ends the threads that oneTBB keeps for later; they start anew when needed. A process forked beside them would have
/// their locks, but not them: one in a thousand waited for ever. Does nothing while other threads of Python use
/// prohull.
void end_idle_threads() {
  prohull::give_up_idle_arenas();
  oneapi::tbb::task_scheduler_handle scheduler{oneapi::tbb::attach{}};
  static_cast<void>(oneapi::tbb::finalize(scheduler, std::nothrow));
}

}  // namespace

PYBIND11_MODULE(_prohull, module) {
  module.attr("version") = PROHULL_VERSION;
  const auto error = pybind11::register_exception<prohull::InputError>(module, "InputError", PyExc_ValueError);
  pybind11::register_exception<prohull::MissingFile>(
      module, "MissingFile", pybind11::make_tuple(error, pybind11::handle(PyExc_FileNotFoundError)));
  pybind11::module_::import("os").attr("register_at_fork")(pybind11::arg("before") =
                                                               pybind11::cpp_function(&end_idle_threads));
  prohull::python::bind_meshes(module);
  prohull::python::bind_construction(module);
  prohull::python::bind_covers(module);
  prohull::python::bind_verification(module);
  prohull::python::bind_queries(module);
  prohull::python::bind_collisions(module);
  prohull::python::bind_pictures(module);
  prohull::python::bind_pages(module);
  prohull::python::bind_robots(module);
  prohull::python::bind_paths(module);
  prohull::python::bind_sweeps(module);
}
