#pragma once

#include <filesystem>
#include <string>

namespace prohull {

/// With letters of ASCII in lower case, whatever the locale.
inline std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// "dir/A.PLY" -> ".ply"
inline std::string lower_case_extension(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

/// "dir/arm.dae.gz" -> "dir/arm.dae"
inline std::filesystem::path without_gz(std::filesystem::path path) {
  return lower_case_extension(path) == ".gz" ? path.replace_extension() : path;
}

}  // namespace prohull
