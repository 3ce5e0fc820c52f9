#pragma once

#include <xxhash.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "robot/hulls/link_hulls.h"

namespace prohull::robot {

/// A short text that tells contents apart: 128 bits, not safe against those who look for two of the same.
class Fingerprint {
 public:
  Fingerprint();
  /// What is added in one call is kept apart from what is added in the next.
  void add(std::string_view bytes);
  void add(double number);
  void add(std::size_t number);
  void add(const TriangleMesh& mesh);
  std::string text() const;  ///< 32 hexadecimal digits

 private:
  std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

/// XXH3 of the content of a file in 128 bits, as `xxhsum -H128` prints it; empty if the file cannot be read. It finds a
/// file that has changed, but is not safe against those who look for two with the same.
std::string hash_of_file(const std::filesystem::path& path);

/// Whether both files can be read and have the same content.
bool have_same_bytes(const std::filesystem::path& a, const std::filesystem::path& b);

/// The fingerprint of the program, or of the Python module, that this code is a part of: another version may make other
/// hulls.
const std::string& program_fingerprint();

/// What the hulls of a link are made from, and how: the triangles as this run has read them, whatever files and
/// importers they come from.
std::string key_of(const TriangleMesh& triangles, const Budget& budget, const LinkHullOptions& options);

/// A folder that keeps how the hulls of links were constructed, by what they were made from, and pictures of them. It
/// saves their search and nothing else: what it returns is a proposal, and `verified` (verdict.h) decides about it.
class HullCache {
 public:
  /// An empty path: nothing is kept.
  explicit HullCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// What keep() has kept under the key, if the file is whole: hulls with what their construction gave. All numbers are
  /// finite, and all corners of faces exist. Nothing is certified or measured. Of notes only their number is kept: no
  /// file says what a report tells.
  std::optional<std::vector<LinkHull>> find(std::string_view key) const;
  /// If it cannot be written, the next run is slower, and nothing else. Hulls that were not found for 90 days are
  /// removed, and what earlier runs have left unfinished.
  void keep(std::string_view key, std::span<const LinkHull> hulls) const;

  /// The picture that is kept by this key: the content of a PNG file.
  std::optional<std::string> find_picture(std::string_view key) const { return find_content(key, kPictureSuffix); }
  void keep_picture(std::string_view key, const std::string& png) const { keep_content(key, kPictureSuffix, png); }

  static constexpr std::string_view kHullsSuffix = ".hulls", kPictureSuffix = ".picture";  ///< of files in the folder

 private:
  std::optional<std::string> find_content(std::string_view key, std::string_view suffix) const;
  void keep_content(std::string_view key, std::string_view suffix, const std::string& content) const;

  std::filesystem::path folder_;
};

}  // namespace prohull::robot
