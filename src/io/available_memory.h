#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

namespace prohull {

/// As the system says that has its files, such as proc/meminfo, below `root`.
std::optional<std::size_t> available_memory(const std::filesystem::path& root);

}  // namespace prohull
