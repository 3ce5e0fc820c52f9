#pragma once

#include <string>

#include "prohull/error.h"

namespace prohull {

/// Thrown for a file that is to be read and is not there. In Python it is a FileNotFoundError, too.
struct MissingFile : InputError {
  explicit MissingFile(const std::string& message) : InputError(Defect::CannotRead, message) {}
};

/// Throws MissingFile, or InputError(CannotRead), by an error number of the system; the message says what to do.
[[noreturn]] void fail_to_read(const std::string& name, int error);

}  // namespace prohull
