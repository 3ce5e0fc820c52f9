#pragma once

#include <filesystem>
#include <string>

namespace prohull {

/// "dir/A.PLY" -> ".ply"
inline std::string lower_case_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

}  // namespace prohull
