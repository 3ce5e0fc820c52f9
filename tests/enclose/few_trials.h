#pragma once

#include "construct/tight/few_faces.h"
#include "effort.h"

namespace prohull {

/// The search for tight hulls of few faces, which takes seconds, is short in these tests.
[[maybe_unused]] inline const std::size_t few_trials = trials_of_few_faces = effort<std::size_t>(100, 12);

}  // namespace prohull
