#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

namespace prohull::view {

/// The numbers of a page: arrays of whole numbers, one after another in one string of bytes. web/src/data/blocks.js
/// reads them. The bytes of an array are stored by significance, the lowest of all numbers first: like bytes side by
/// side compress well.
class Blocks {
 public:
  /// Each returns what the page needs to find the array and to read it.
  nlohmann::json plain(std::span<const std::uint32_t> values);
  /// Small negative numbers are stored as short as small positive ones.
  nlohmann::json differences(std::span<const std::int32_t> values);
  /// For numbers that differ little from those `stride` places before them.
  nlohmann::json running(std::span<const std::uint32_t> values, std::size_t stride);

  const std::string& bytes() const { return bytes_; }

 private:
  nlohmann::json add(const char* coding, std::span<const std::uint32_t> values, std::size_t stride);
  std::string bytes_;
};

}  // namespace prohull::view
