#include "query/wide_trace.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>
#include <limits>

// Lanes are returned in another way with AVX2 than without: here they are by functions that are inlined. GCC says so at
// the end of the unit.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace prohull {
namespace {

using Double4 = double __attribute__((vector_size(32)));
using Truth4Double = decltype(Double4{} < Double4{});
constexpr double kMostDouble = std::numeric_limits<double>::max();

namespace baseline {
#define TARGET
#define INLINE inline __attribute__((always_inline))
INLINE unsigned mask_of(const Truth8& lanes) {
#if defined(__SSE2__)
  const auto* const half = reinterpret_cast<const __m128*>(&lanes);
  return static_cast<unsigned>(_mm_movemask_ps(half[0])) | static_cast<unsigned>(_mm_movemask_ps(half[1])) << 4;
#else
  unsigned mask = 0;
  for (int i = 0; i < 8; ++i) mask |= unsigned(lanes[i] != 0) << i;
  return mask;
#endif
}
INLINE unsigned mask_of(const Truth4Double& lanes) {
  const auto* const half = reinterpret_cast<const Truth2*>(&lanes);
  return mask(half[0]) | mask(half[1]) << 2;
}
INLINE Float8 floats_of(const Short8& lanes) { return __builtin_convertvector(lanes, Float8); }
INLINE Double4 doubles_of(const Float8& lanes, int half) {
  return __builtin_convertvector(reinterpret_cast<const Float4*>(&lanes)[half], Double4);
}
#include "query/wide_trace.inl"
#undef INLINE
#undef TARGET
}  // namespace baseline

#if defined(__x86_64__)
namespace avx2 {
#define TARGET __attribute__((target("avx2,bmi")))
#define INLINE TARGET inline __attribute__((always_inline))
INLINE unsigned mask_of(const Truth8& lanes) {
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<const __m256&>(lanes)));
}
INLINE unsigned mask_of(const Truth4Double& lanes) {
  return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<const __m256d&>(lanes)));
}
INLINE Float8 floats_of(const Short8& lanes) {
  return _mm256_cvtepi32_ps(_mm256_cvtepu16_epi32(reinterpret_cast<const __m128i&>(lanes)));
}
INLINE Double4 doubles_of(const Float8& lanes, int half) {
  return _mm256_cvtps_pd(reinterpret_cast<const __m128*>(&lanes)[half]);
}
#include "query/wide_trace.inl"
#undef INLINE
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
