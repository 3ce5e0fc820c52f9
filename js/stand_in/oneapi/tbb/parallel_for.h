#pragma once

namespace oneapi::tbb {

template <class Index, class Body>
void parallel_for(Index begin, Index end, const Body& body) {
  for (Index i = begin; i < end; ++i) body(i);
}

}  // namespace oneapi::tbb
