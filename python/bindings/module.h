#pragma once

#include <pybind11/pybind11.h>

namespace prohull::python {

void bind_meshes(pybind11::module_& module);
void bind_construction(pybind11::module_& module);
void bind_covers(pybind11::module_& module);
void bind_verification(pybind11::module_& module);
void bind_queries(pybind11::module_& module);
void bind_collisions(pybind11::module_& module);
void bind_pictures(pybind11::module_& module);
void bind_pages(pybind11::module_& module);
void bind_robots(pybind11::module_& module);
void bind_paths(pybind11::module_& module);
void bind_sweeps(pybind11::module_& module);

}  // namespace prohull::python
