#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "prohull/error.h"

namespace prohull {

/// Throws InputError unless there is one tolerance for each face, of at least 0.
template <class Tolerances>
void require_tolerances(const Tolerances& tolerances, std::size_t faces) {
  if (tolerances.size() != faces)
    throw InputError(Defect::InvalidOption, fmt::format("{} tolerances for {} faces: there must be one for each face",
                                                        tolerances.size(), faces));
  if (!std::ranges::all_of(tolerances, [](double tolerance) { return tolerance >= 0; }))
    throw InputError(Defect::InvalidOption, "tolerances must be at least 0; 0 keeps a face, infinity allows anything");
}

}  // namespace prohull
