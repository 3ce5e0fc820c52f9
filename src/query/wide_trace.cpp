#include "query/wide_trace.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

namespace prohull {
namespace {

using Double4 = double __attribute__((vector_size(32)));

namespace baseline {
#define TARGET
TARGET inline __attribute__((always_inline)) unsigned mask_of(const Truth8& lanes) {
#if defined(__SSE2__)
  const auto* const half = reinterpret_cast<const __m128*>(&lanes);
  return static_cast<unsigned>(_mm_movemask_ps(half[0])) | static_cast<unsigned>(_mm_movemask_ps(half[1])) << 4;
#else
  unsigned mask = 0;
  for (int i = 0; i < 8; ++i) mask |= unsigned(lanes[i] != 0) << i;
  return mask;
#endif
}
#include "query/wide_trace.inl"
#undef TARGET
}  // namespace baseline

#if defined(__x86_64__)
namespace avx2 {
#define TARGET __attribute__((target("avx2,bmi")))
TARGET inline __attribute__((always_inline)) unsigned mask_of(const Truth8& lanes) {
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<const __m256&>(lanes)));
}
#include "query/wide_trace.inl"
#undef TARGET
}  // namespace avx2
#endif

}  // namespace

std::span<const WideTrace> wide_traces() {
#if defined(__x86_64__)
  static constexpr std::array<WideTrace, 2> kTraces{
      {{"baseline", baseline::trace, baseline::trace_nearest}, {"avx2", avx2::trace, avx2::trace_nearest}}};
  static const std::size_t count = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") ? 2 : 1;
#else
  static constexpr std::array<WideTrace, 1> kTraces{{{"baseline", baseline::trace, baseline::trace_nearest}}};
  constexpr std::size_t count = 1;
#endif
  return std::span(kTraces).first(count);
}

}  // namespace prohull
