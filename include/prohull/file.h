#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace prohull {

/// Writes `content` beside `path`, then renames: an interrupted write leaves no partial file, and an older file stays
/// whole until then. Throws InputError(CannotWrite) with the system's reason.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace prohull
