#pragma once

#include <nlohmann/json.hpp>

#include "prohull/verdict.h"
#include "robot/json.h"

namespace prohull {

/// The verdict as all reports have it.
nlohmann::json facts(const Verdict& verdict);
nlohmann::json facts(const DistanceBounds& bounds);  ///< `farthest` is null where no point is known to be away

}  // namespace prohull
