#pragma once

namespace oneapi::tbb {

template <class... Works>
void parallel_invoke(Works&&... works) {
  (works(), ...);
}

}  // namespace oneapi::tbb
