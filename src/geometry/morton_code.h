#pragma once

#include <algorithm>
#include <cstdint>

namespace prohull {

/// The place, below 2^30, on the curve of Morton (1966) through the cube [-1, 1]^3, which leads past what lies together
/// in space. Points outside of the cube are moved to its surface.
inline std::uint32_t morton_code(float x, float y, float z) {
  // Ten bits to an axis, spread so that two zeros follow each.
  const auto spread = [](float along) {
    auto bits = static_cast<std::uint32_t>(std::clamp(511.5f + 511.5f * along, 0.0f, 1023.0f));
    bits = (bits | bits << 16) & 0x030000ff;
    bits = (bits | bits << 8) & 0x0300f00f;
    bits = (bits | bits << 4) & 0x030c30c3;
    return (bits | bits << 2) & 0x09249249;
  };
  return spread(x) | spread(y) << 1 | spread(z) << 2;
}

}  // namespace prohull
