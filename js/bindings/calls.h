#pragma once

#include <new>
#include <string>
#include <string_view>

#include "prohull/progress.h"
#include "values.h"

// What all functions do that JavaScript calls.

namespace prohull::js {

/// progress(stage, fraction); the work is stopped where that returns false.
inline Progress progress_of(const val& progress) {
  if (progress.isUndefined() || progress.isNull()) return {};
  return
      [progress](std::string_view stage, double fraction) { return !progress(std::string(stage), fraction).isFalse(); };
}

/// Those that `read` takes from what is given; no others may be.
template <class Read>
auto options_of(const val& given, const val& progress, Read read) {
  const Given named(given);
  auto options = read(named);
  named.refuse_others();
  options.progress = progress_of(progress);
  return options;
}

inline val failure(const char* name, const std::string& message) {
  val object = val::object();
  object.set("error", message);
  object.set("name", std::string(name));
  return object;
}

/// A function as JavaScript calls it: what it throws becomes an object with `error` and its name.
template <auto function>
struct Guarded;
template <class... Arguments, val (*function)(Arguments...)>
struct Guarded<function> {
  static val call(Arguments... arguments) {
    try {
      return function(arguments...);
    } catch (const InputError& error) {
      return failure("InputError", error.what());
    } catch (const Cancelled&) {
      return failure("AbortError", "cancelled");
    } catch (const std::bad_alloc&) {
      return failure("RangeError", "the memory does not do: of WebAssembly's, 4 GB, or of this page's");
    } catch (const std::exception& error) {
      return failure("Error", error.what());
    }
  }
};

}  // namespace prohull::js
