#pragma once

#include <span>

#include "prohull/enclosing_hull.h"

namespace prohull {

/// Throws InputError where the options of a hull exclude each other, or no hull can be what they say.
void require_usable(const TriangleMesh& triangles, std::span<const std::size_t> target_faces,
                    const EnclosingOptions& options);

}  // namespace prohull
