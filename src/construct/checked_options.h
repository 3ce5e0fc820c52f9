#pragma once

#include "prohull/hull_builder.h"

namespace prohull {

/// Throws InputError if a number is outside of its range, or options contradict each other.
void check(const HullOptions& options);

}  // namespace prohull
