#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "prohull/repair.h"

namespace prohull::cover {

inline void add_note_of_left_out(const Repairs& repairs, std::vector<std::string>& notes) {
  if (repairs.dropped_non_finite_faces > 0)
    notes.push_back(
        fmt::format("triangles with corners that are not finite were left out: {}", repairs.dropped_non_finite_faces));
}

}  // namespace prohull::cover
