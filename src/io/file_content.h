#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace prohull {

/// Bytes without compression, and the name that tells their format and stands in messages.
struct FileContent {
  std::string bytes;
  std::filesystem::path name;
};

/// How many bytes `compressed` may become: 64 MiB + 200 for each. Meshes, even of zeros, stay far below; the formats
/// would allow 1,032 and more, so that a small file could exhaust the memory.
std::size_t decompression_limit(std::size_t compressed);

bool is_gzip(std::string_view bytes);
bool is_zip(std::string_view bytes);

// All that follow throw InputError(Malformed) if the content is damaged or exceeds its limit.

std::string gunzip(std::string_view compressed, const std::filesystem::path& name);

/// The names of what a zip archive contains, in its order.
std::vector<std::string> zip_members(std::string_view bytes, const std::filesystem::path& name);

/// One of them, which is then named "archive.zip/member.ply".
FileContent zip_member(std::string_view bytes, const std::filesystem::path& name, const std::string& member);

/// What gzip, or a zip archive with one mesh in it, contains; empty if `bytes` are neither.
std::optional<FileContent> decompressed(std::string_view bytes, const std::filesystem::path& name);

}  // namespace prohull
