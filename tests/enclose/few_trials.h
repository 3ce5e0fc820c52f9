#pragma once

#include "effort.h"

namespace prohull {

/// HullOptions::tight_trials of tests: the search for tight hulls of few faces takes seconds.
constexpr unsigned few_trials = effort(100U, 12U);

}  // namespace prohull
