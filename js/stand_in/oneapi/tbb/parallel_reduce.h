#pragma once

#include <utility>

#include "blocked_range.h"

namespace oneapi::tbb {

/// Halves the range as oneTBB does, so that sums of doubles round the same.
template <class Range, class Value, class Body, class Join>
Value parallel_deterministic_reduce(const Range& range, const Value& identity, const Body& body, const Join& join) {
  if (!range.is_divisible()) return body(range, identity);
  Value first = parallel_deterministic_reduce(range.first_half(), identity, body, join);
  return join(std::move(first), parallel_deterministic_reduce(range.second_half(), identity, body, join));
}

template <class Range, class Value, class Body, class Join>
Value parallel_reduce(const Range& range, const Value& identity, const Body& body, const Join&) {
  return body(range, identity);
}

}  // namespace oneapi::tbb
