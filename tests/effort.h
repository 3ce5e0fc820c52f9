#pragma once

namespace prohull {

/// How many rounds a random test makes: a tenth under sanitizers, which slow everything down that much.
constexpr int rounds(int count) {
#ifdef PROHULL_TESTS_ARE_SLOW
  return count / 10 + 1;
#else
  return count;
#endif
}

}  // namespace prohull
