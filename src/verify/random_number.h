#pragma once

#include <cstdint>
#include <random>

namespace prohull::verify {

/// One of `least` to `most`, with the same bits everywhere: the standard fixes those of the engine, but not those of
/// its distributions. None is likelier than another by more than their number / 2^32.
inline int random_number(std::mt19937& random, int least, int most) {
  const auto count = static_cast<std::uint64_t>(most - least) + 1;
  return least + static_cast<int>(random() * count >> 32);
}

}  // namespace prohull::verify
