#pragma once

#include <emscripten/val.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "prohull/detail/ids.h"
#include "prohull/detail/names.h"
#include "prohull/error.h"
#include "prohull/geometry.h"
#include "prohull/triangle_mesh.h"

namespace prohull::js {

using emscripten::val;

constexpr double kMostIndex = 0xffffffff;
constexpr double kMostWhole = 0x1p53 - 1;  ///< up to it, JavaScript has all whole numbers

/// Throws InputError unless it is a whole number between them; `what` is for messages.
void check_whole(double number, const std::string& what, double least, double most = kMostIndex);

/// "max_distance" -> "maxDistance"
std::string camel_case(std::string_view name);

/// The options of a call, by name; those that are not given keep their values (prohull/detail/given_options.h).
class Given {
 public:
  explicit Given(const val& values) : values_(values) {}

  bool flag(const char* name, bool& to) const;
  template <class Count>
  bool count(const char* name, Count& to, unsigned least = 0, double most = kMostIndex) const {
    double value = 0;
    if (!whole(name, least, most, value)) return false;
    return to = static_cast<Count>(value), true;
  }
  bool seed(const char* name, std::uint64_t& to) const { return count(name, to, 0, kMostWhole); }
  bool threads(unsigned&) const { return false; }  ///< there is one
  bool number(const char* name, double& to) const;
  bool not_negative(const char* name, double& to) const;
  bool positive(const char* name, double& to) const;
  bool text(const char* name, std::string& to) const;
  bool numbers(const char* name, PerFace<double>& to) const;
  template <class T>
  bool choice(const char* name, Names<T> choices, T& to) const {
    const std::optional<std::string> text = word(name, joined(choices));
    if (!text) return false;
    const auto value = value_of(choices, *text);
    if (!value) refuse(name, "one of " + joined(choices));
    return to = *value, true;
  }
  template <class T>
  bool choice_or_none(const char* name, Names<T> choices, std::optional<T>& to) const {
    T value{};
    if (!choice(name, choices, value)) return false;
    return to = value, true;
  }

  /// Throws InputError if there is an option that nobody has asked for: a wrong name.
  void refuse_others() const;

 private:
  /// Undefined if it is not given.
  val value(const char* name) const;
  bool whole(const char* name, double least, double most, double& to) const;
  std::optional<std::string> word(const char* name, const std::string& choices) const;
  [[noreturn]] void refuse(const char* name, const std::string& expected) const;

  const val& values_;
  mutable std::vector<std::string> known_;
};

/// Numbers that JavaScript has in a typed array; `name` is for messages.
std::vector<double> numbers_of(const val& array, const std::string& name);

/// Of {vertices, faces}. Throws InputError if they are no mesh.
TriangleMesh mesh_of(const val& mesh, const std::string& name);

/// A typed array of its own.
template <class T>
val array_of(const T* data, std::size_t count) {
  return val(emscripten::typed_memory_view(count, data)).call<val>("slice");
}

val array_of(const Vec3& p);

/// {vertices, faces}
val object_of_mesh(const TriangleMesh& mesh);

/// {bytes}
val object_of_file(std::string_view content);

val strings_of(const std::vector<std::string>& strings);

}  // namespace prohull::js
