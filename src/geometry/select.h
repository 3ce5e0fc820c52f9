#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>

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

/// Sorts but for runs of at most 16 elements.
template <class Iterator, class Less>
void sort_roughly(Iterator first, Iterator last, Less& less, int most_steps) {
  for (; last - first > 16; --most_steps) {
    if (most_steps == 0) return std::stable_sort(first, last, less);
    const Iterator middle = partition_by_median(first, last, less);
    sort_roughly(middle, last, less, most_steps - 1);
    last = middle;
  }
}

template <class Iterator>
int most_steps(Iterator first, Iterator last) {
  return 2 * std::bit_width(static_cast<std::size_t>(last - first)) - 2;
}

/// As std::sort, by the same steps as libstdc++ takes: equal elements come in the same order with every standard
/// library.
template <class Iterator, class Less>
void sort_with_ties(Iterator first, Iterator last, Less less) {
  sort_roughly(first, last, less, most_steps(first, last));
  std::stable_sort(first, last, less);
}

/// As std::nth_element, by the same steps as libstdc++ takes: where the other elements come to lie is the same with
/// every standard library.
template <class Iterator, class Less>
void select_nth(Iterator first, Iterator nth, Iterator last, Less less) {
  if (nth == last) return;
  for (int left = most_steps(first, last); last - first > 3 && left > 0; --left) {
    const Iterator middle = partition_by_median(first, last, less);
    (middle <= nth ? first : last) = middle;
  }
  if (last - first > 3) return std::stable_sort(first, last, less);
  for (Iterator i = first; i != last; ++i) std::rotate(std::upper_bound(first, i, *i, less), i, i + 1);
}

}  // namespace prohull
