#pragma once

#include <algorithm>
#include <functional>

namespace oneapi::tbb {

template <class Iterator, class Less>
void parallel_sort(Iterator begin, Iterator end, const Less& less) {
  std::sort(begin, end, less);
}

template <class Container>
void parallel_sort(Container& all) {
  std::sort(all.begin(), all.end());
}

}  // namespace oneapi::tbb
