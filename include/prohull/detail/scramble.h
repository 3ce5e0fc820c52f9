#pragma once

#include <cstdint>

namespace prohull {

/// A well mixed function of its argument, the same everywhere (the finaliser of splitmix64).
constexpr std::uint64_t scramble(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// Uniform in [0, 1).
constexpr double unit_random(std::uint64_t seed) { return double(scramble(seed) >> 11) * 0x1p-53; }

}  // namespace prohull
