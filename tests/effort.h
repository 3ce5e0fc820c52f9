#pragma once

namespace prohull {

#ifdef PROHULL_TESTS_ARE_SLOW
constexpr bool kTestsAreSlow = true;
#else
constexpr bool kTestsAreSlow = false;
#endif

/// What a test works on: less under sanitizers, which slow everything down tenfold.
template <class T>
constexpr T effort(T usual, T under_sanitizers) {
  return kTestsAreSlow ? under_sanitizers : usual;
}

/// How many rounds a random test makes: a tenth under sanitizers.
constexpr int rounds(int count) { return effort(count, count / 10 + 1); }

}  // namespace prohull
