#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace prohull {

/// The bytes of a file as they are. Throws InputError(CannotRead) with the system's reason.
std::string read_file(const std::filesystem::path& path);

/// Writes `content` beside `path`, then renames: an interrupted write leaves no partial file, and an older file stays
/// whole until then. Throws InputError(CannotWrite) with the system's reason.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace prohull
