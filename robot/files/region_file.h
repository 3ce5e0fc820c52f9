#pragma once

#include <functional>
#include <string>
#include <vector>

#include "prohull/length.h"
#include "prohull/regions.h"

namespace prohull::robot {

/// The regions of a --tolerance file (docs/guides/regions.md), in their order. `in_mesh` is a length in the mesh's
/// unit. Throws InputError with `name` and the line; so does what `in_mesh` throws.
std::vector<Region> read_region_file(const std::string& text, const std::string& name,
                                     const std::function<double(const Length&)>& in_mesh);

}  // namespace prohull::robot
