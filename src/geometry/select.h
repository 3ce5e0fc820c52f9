#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>

namespace prohull {

/// Brings to the front of [`first`, `last`) the median of three of its elements, and what is less than it before what
/// is greater. Returns where the latter begins.
template <class Iterator, class Less>
Iterator partition_by_median(Iterator first, Iterator last, Less& less) {
  const Iterator a = first + 1, b = first + (last - first) / 2, c = last - 1;
  const bool is_a_low = less(*a, *b);
  const Iterator low = is_a_low ? a : b, high = is_a_low ? b : a;
  std::iter_swap(first, less(*high, *c) ? high : less(*low, *c) ? c : low);
  for (Iterator i = a, j = last;; ++i) {
    while (less(*i, *first)) ++i;
    do --j;
    while (less(*first, *j));
    if (i >= j) return i;
    std::iter_swap(i, j);
  }
}

/// As std::nth_element, by the same steps as libstdc++ takes: where the other elements come to lie is the same with
/// every standard library.
template <class Iterator, class Less>
void select_nth(Iterator first, Iterator nth, Iterator last, Less less) {
  if (nth == last) return;
  for (int left = 2 * std::bit_width(static_cast<std::size_t>(last - first)) - 2; last - first > 3; --left) {
    if (left == 0) break;
    const Iterator middle = partition_by_median(first, last, less);
    (middle <= nth ? first : last) = middle;
  }
  if (last - first > 3) return std::stable_sort(first, last, less);
  for (Iterator i = first; i != last; ++i) std::rotate(std::upper_bound(first, i, *i, less), i, i + 1);
}

}  // namespace prohull
