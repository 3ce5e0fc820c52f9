#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "prohull/detail/query_io.h"

namespace prohull {

/// ".npy"
std::string_view extension_of(QueryFormat format);

/// By the extension, in any case; empty if it is none that is known.
std::optional<QueryFormat> query_format(const std::filesystem::path& path);

}  // namespace prohull
