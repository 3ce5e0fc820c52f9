#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace prohull {

/// Bytes without compression, and the name that tells their format and stands in messages.
struct FileContent {
  std::string bytes;
  std::filesystem::path name;
};

/// The bytes of a file as they are. Throws InputError(CannotRead) with the system's reason.
std::string read_file(const std::filesystem::path& path);

/// How many bytes `compressed` may become: 64 MiB + 200 for each. Meshes, even of zeros, stay far below; the formats
/// would allow 1,032 and more, so that a small file could exhaust the memory.
std::size_t decompression_limit(std::size_t compressed);

/// What gzip, or a zip archive with one mesh in it, contains; empty if `bytes` are neither. A zip member is named
/// "archive.zip/member.ply". Throws InputError(Malformed) if it is damaged or exceeds its limit.
std::optional<FileContent> decompressed(std::string_view bytes, const std::filesystem::path& name);

/// `read_file`, then `decompressed`.
FileContent read_file_content(const std::filesystem::path& path);

}  // namespace prohull
