#pragma once

#include <filesystem>
#include <vector>

#include "prohull/regions.h"

namespace prohull::cli {

/// The regions of a --tolerance file (docs/guides/regions.md), in their order. Throws InputError with file and line.
std::vector<Region> read_regions(const std::filesystem::path& path);

}  // namespace prohull::cli
