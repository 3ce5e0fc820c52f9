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

/// "dir/arm.dae.gz" -> "dir/arm.dae"
inline std::filesystem::path without_gz(std::filesystem::path path) {
  return lower_case_extension(path) == ".gz" ? path.replace_extension() : path;
}

}  // namespace prohull
