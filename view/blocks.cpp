#include "view/blocks.h"

#include <algorithm>
#include <vector>

namespace prohull::view {
namespace {

/// 0, -1, 1, -2, 2 become 0, 1, 2, 3, 4. Differences are those of 32-bit arithmetic, which wraps around.
std::uint32_t zigzag(std::uint32_t difference) { return difference << 1 ^ (difference >> 31 ? 0xffffffffU : 0U); }

std::size_t bytes_of(std::uint32_t value) { return value >> 24 ? 4 : value >> 16 ? 3 : value >> 8 ? 2 : 1; }

}  // namespace

nlohmann::json Blocks::add(const char* coding, std::span<const std::uint32_t> values, std::size_t stride) {
  const std::uint32_t greatest = values.empty() ? 0 : *std::ranges::max_element(values);
  const std::size_t planes = bytes_of(greatest);
  nlohmann::json found = {
      {"at", bytes_.size()}, {"count", values.size()}, {"planes", planes}, {"coding", coding}, {"stride", stride}};
  for (std::size_t plane = 0; plane < planes; ++plane)
    for (const std::uint32_t value : values) bytes_ += static_cast<char>(value >> (8 * plane) & 0xff);
  return found;
}

nlohmann::json Blocks::plain(std::span<const std::uint32_t> values) { return add("plain", values, 1); }

nlohmann::json Blocks::differences(std::span<const std::int32_t> values) {
  std::vector<std::uint32_t> coded;
  coded.reserve(values.size());
  for (const std::int32_t value : values) coded.push_back(zigzag(static_cast<std::uint32_t>(value)));
  return add("differences", coded, 1);
}

nlohmann::json Blocks::running(std::span<const std::uint32_t> values, std::size_t stride) {
  std::vector<std::uint32_t> coded;
  coded.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    coded.push_back(zigzag(values[i] - (i < stride ? 0 : values[i - stride])));
  return add("running", coded, stride);
}

}  // namespace prohull::view
