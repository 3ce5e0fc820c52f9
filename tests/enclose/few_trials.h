#pragma once

namespace prohull {

/// HullOptions::tight_trials of tests: the search for tight hulls of few faces takes seconds.
constexpr unsigned few_trials = 12;

}  // namespace prohull
