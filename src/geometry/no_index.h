#pragma once

#include <cstdint>

namespace prohull {

/// Stands where an index has no value.
inline constexpr std::uint32_t kNone = 0xffffffff;

}  // namespace prohull
