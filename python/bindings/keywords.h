#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "prohull/detail/ids.h"
#include "prohull/detail/names.h"
#include "prohull/error.h"

namespace prohull::python {

/// The options of a function, by name, all of them: each function sets one (prohull/detail/given_options.h) and returns
/// true. Those that are wrong are named in an InputError.
class Keywords {
 public:
  explicit Keywords(const pybind11::dict& values) : values_(values) {}

  bool flag(const char* name, bool& to) const { return to = get<bool>(name, "True or False"), true; }
  template <class Count>
  bool count(const char* name, Count& to, unsigned least = 0) const {
    const std::string expected = "a whole number, at least " + std::to_string(least) + " and less than 2^32";
    const auto value = get<unsigned>(name, expected.c_str());
    if (value < least) refuse(name, expected.c_str());
    return to = value, true;
  }
  bool seed(const char* name, std::uint64_t& to) const {
    return to = get<std::uint64_t>(name, "a whole number, at least 0 and less than 2^64"), true;
  }
  bool threads(unsigned& to) const { return count("threads", to); }
  bool number(const char* name, double& to) const { return to = get<double>(name, "a number"), true; }
  bool not_negative(const char* name, double& to) const {
    number(name, to);
    if (!(to >= 0)) refuse(name, "a number, at least 0");
    return true;
  }
  bool positive(const char* name, double& to) const {
    number(name, to);
    if (!(to > 0)) refuse(name, "a number greater than 0");
    return true;
  }
  bool numbers(const char* name, PerFace<double>& to) const {
    return to = PerFace<double>(get<std::vector<double>>(name, "a number for each face")), true;
  }
  template <class T>
  bool choice(const char* name, Names<T> choices, T& to) const {
    const auto value = value_of(choices, pybind11::str(values_[name]).cast<std::string>());
    if (!value) refuse(name, ("one of " + joined(choices)).c_str());
    return to = *value, true;
  }
  /// None: nothing.
  template <class T>
  bool choice_or_none(const char* name, Names<T> choices, std::optional<T>& to) const {
    if (values_[name].is_none()) return to.reset(), true;
    return choice(name, choices, to.emplace());
  }

 private:
  template <class T>
  T get(const char* name, const char* expected) const {
    try {
      return values_[name].cast<T>();
    } catch (const pybind11::cast_error&) {
      refuse(name, expected);
    }
  }
  [[noreturn]] void refuse(const char* name, const char* expected) const {
    throw InputError(Defect::InvalidOption,
                     std::string(name) + "=" + std::string(pybind11::repr(values_[name])) + ": expected " + expected);
  }

  const pybind11::dict& values_;
};

}  // namespace prohull::python
