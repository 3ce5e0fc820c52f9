#pragma once

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string_view>

namespace prohull {

/// The seed of all random tests, 1 unless the environment's PROHULL_TEST_SEED is another number or `random`.
/// It is printed when it is first asked for, so that a failure can be replayed.
inline unsigned test_seed() {
  static const unsigned seed = [] {
    unsigned value = 1;
    if (const char* variable = std::getenv("PROHULL_TEST_SEED"); variable && *variable) {
      const std::string_view text = variable;
      if (text == "random")
        value = std::random_device{}();
      else if (const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
               error != std::errc{} || end != text.data() + text.size())
        throw std::invalid_argument("PROHULL_TEST_SEED is neither a number below 2^32 nor `random`");
    }
    std::printf("PROHULL_TEST_SEED=%u\n", value);
    std::fflush(stdout);
    return value;
  }();
  return seed;
}

}  // namespace prohull
