#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

#include "prohull/error.h"
#include "prohull/names.h"

namespace prohull::python {

/// The options of a function, by name; those that are wrong are named in an InputError.
class Keywords {
 public:
  explicit Keywords(const pybind11::dict& values) : values_(values) {}

  template <class T>
  T get(const char* name, const char* expected) const {
    try {
      return values_[name].cast<T>();
    } catch (const pybind11::cast_error&) {
      refuse(name, expected);
    }
  }
  bool flag(const char* name) const { return get<bool>(name, "True or False"); }
  unsigned count(const char* name, unsigned least = 0) const {
    const std::string expected = "a whole number, at least " + std::to_string(least);
    const auto value = get<unsigned>(name, expected.c_str());
    if (value < least) refuse(name, expected.c_str());
    return value;
  }
  double number(const char* name) const { return get<double>(name, "a number"); }
  double not_negative(const char* name) const {
    const double value = number(name);
    if (!(value >= 0)) refuse(name, "a number, at least 0");
    return value;
  }
  template <class T>
  T choice(const char* name, Names<T> choices) const {
    if (const auto value = value_of(choices, pybind11::str(values_[name]).cast<std::string>())) return *value;
    refuse(name, ("one of " + joined(choices)).c_str());
  }
  /// None: nothing.
  template <class T>
  std::optional<T> choice_or_none(const char* name, Names<T> choices) const {
    return values_[name].is_none() ? std::nullopt : std::optional(choice(name, choices));
  }

 private:
  [[noreturn]] void refuse(const char* name, const char* expected) const {
    throw InputError(Defect::InvalidOption,
                     std::string(name) + "=" + std::string(pybind11::repr(values_[name])) + ": expected " + expected);
  }

  const pybind11::dict& values_;
};

}  // namespace prohull::python
