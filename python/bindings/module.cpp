// prohull._prohull: what the Python package needs of the library. Arguments arrive checked and converted by the
// package; see its _prohull.pyi for the types.
#include "module.h"

#include <oneapi/tbb/global_control.h>

#include <cstring>
#include <exception>
#include <new>
#include <utility>

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

/// Names of files need not be UTF-8: such a byte becomes "\\xff" in the message.
void raise(const pybind11::handle& type, const char* what) {
  const auto message = pybind11::reinterpret_steal<pybind11::object>(
      PyUnicode_DecodeUTF8(what, static_cast<Py_ssize_t>(std::strlen(what)), "backslashreplace"));
  PyErr_SetObject(type.ptr(), message.ptr());
}

/// The classes live as long as the module, which is never unloaded.
void bind_errors(pybind11::module_& module) {
  static const pybind11::handle bad_input =
      pybind11::exception<prohull::InputError>(module, "InputError", PyExc_ValueError).inc_ref();
  static const pybind11::handle missing =
      pybind11::exception<prohull::MissingFile>(
          module, "MissingFile", pybind11::make_tuple(bad_input, pybind11::handle(PyExc_FileNotFoundError)))
          .inc_ref();
  pybind11::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(std::move(thrown));
    } catch (const prohull::MissingFile& error) {
      raise(missing, error.what());
    } catch (const prohull::InputError& error) {
      raise(bad_input, error.what());
    }
  });
}

/// Of pickle's protocols 0 and 1, pybind11 ends the process for classes that do not say how they are pickled.
void refuse_to_pickle_others(const pybind11::module_& module) {
  const pybind11::handle bound(reinterpret_cast<PyObject*>(pybind11::detail::get_internals().default_metaclass));
  for (const auto& [name, value] : pybind11::dict(module.attr("__dict__"))) {
    if (!pybind11::isinstance(value, bound) || value.attr("__dict__").contains("__reduce__")) continue;
    const std::string message = "cannot pickle '" + std::string(pybind11::str(name)) + "' object";
    value.attr("__reduce__") = pybind11::cpp_function(
        [message](const pybind11::handle&) -> pybind11::object { throw pybind11::type_error(message); },
        pybind11::name("__reduce__"), pybind11::is_method(value));
  }
}

}  // namespace

PYBIND11_MODULE(_prohull, module) {
  module.attr("version") = PROHULL_VERSION;
  bind_errors(module);
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
  refuse_to_pickle_others(module);
}
