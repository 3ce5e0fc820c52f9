#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "prohull/detail/verdict_parts.h"

namespace prohull::python {

inline pybind11::object object_of(bool value) { return pybind11::bool_(value); }
inline pybind11::object object_of(std::size_t value) { return pybind11::int_(value); }
inline pybind11::object object_of(double value) { return pybind11::float_(value); }
inline pybind11::object object_of(std::string_view text) { return pybind11::str(std::string(text)); }
inline pybind11::object object_of(const DistanceBounds& bounds) {
  return pybind11::make_tuple(bounds.lower, bounds.upper);
}
template <class Value>
pybind11::object object_of(const std::optional<Value>& value) {
  return value ? object_of(*value) : pybind11::none();
}

/// The keywords of the class Verdict in Python.
inline pybind11::dict verdict_facts(const Verdict& verdict) {
  pybind11::dict facts;
  visit_fields(verdict, [&](const char* name, const auto& value) { facts[name] = object_of(value); });
  return facts;
}

}  // namespace prohull::python
