#pragma once

#include <filesystem>
#include <string_view>

#include "prohull/progressive_hull.h"

namespace prohull {

/// The .phull file: a progressive hull, compressed and checksummed; see docs/phull.md for its layout.

/// Writes beside `path`, then renames. Throws InputError(CannotWrite).
void save_hull(const std::filesystem::path& path, const ProgressiveHull& hull);

/// Throws InputError if the file cannot be read, is no .phull, is of a newer version, truncated, corrupted, or holds
/// anything but a sound progressive hull (first_defect). Memory is bounded by the size of the file.
ProgressiveHull load_hull(const std::filesystem::path& path);

/// The same for the content of a file; `name` stands in error messages.
ProgressiveHull load_hull(std::string_view content, const std::filesystem::path& name);

/// Whether the content starts as a .phull file does. A pipe cannot be read again after is_hull_file: read_file first.
bool is_hull_content(std::string_view content);
bool is_hull_file(const std::filesystem::path& path);

}  // namespace prohull
