#pragma once

#include <filesystem>
#include <vector>

#include "inputs.h"
#include "prohull/regions.h"

namespace prohull::cli {

/// The regions of a --tolerance file (docs/guides/regions.md), in their order, for a mesh of this unit. Throws
/// InputError with file and line.
std::vector<Region> read_regions(const std::filesystem::path& path, const MeshUnit& unit);

}  // namespace prohull::cli
