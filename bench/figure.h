#pragma once

#include <filesystem>

namespace prohull::bench {

/// Draws NAME.csv as NAME.svg and NAME.png beside it, by the script NAME.py of this folder; says on stderr if it could
/// not, as where matplotlib is missing.
void draw_figure(const std::filesystem::path& csv);

}  // namespace prohull::bench
