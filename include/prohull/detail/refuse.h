#pragma once

#include <string>

#include "prohull/error.h"

namespace prohull {

/// Throws InputError(InvalidOption).
[[noreturn]] inline void refuse(const std::string& what) { throw InputError(Defect::InvalidOption, what); }

}  // namespace prohull
