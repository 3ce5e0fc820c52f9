#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "prohull/progressive_hull.h"

namespace prohull {

// A .phull file holds a progressive hull, compressed and with a checksum. docs/phull.md describes the format.

/// Writes a .phull file: first beside `path`, then it is renamed, so that no half-written file is left. Throws
/// InputError(CannotWrite).
void save_hull(const std::filesystem::path& path, const ProgressiveHull& hull);

/// What save_hull writes.
std::string hull_content(const ProgressiveHull& hull);

/// Reads a .phull file. Throws InputError if the file cannot be read, is not a .phull file, has a newer version of the
/// format, is truncated or corrupted, or does not hold a sound progressive hull (first_defect). The memory that it uses
/// is bounded by the size of the file.
ProgressiveHull load_hull(const std::filesystem::path& path);

/// Reads the content of a .phull file. `name` stands in error messages.
ProgressiveHull load_hull(std::string_view content, const std::filesystem::path& name);

/// Whether the content of a file starts as a .phull file does.
bool is_hull_content(std::string_view content);
/// Whether a file starts as a .phull file does. Not for pipes, which can be read only once.
bool is_hull_file(const std::filesystem::path& path);

}  // namespace prohull
