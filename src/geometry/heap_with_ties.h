#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace prohull {

/// As std::priority_queue, by the same steps as libstdc++ takes: of equal elements, the same one is on top with every
/// standard library.
template <class T>
class HeapWithTies {
 public:
  bool empty() const { return elements_.empty(); }
  std::size_t size() const { return elements_.size(); }
  const T& top() const { return elements_.front(); }

  void push(T value) {
    elements_.emplace_back();
    rise(elements_.size() - 1, std::move(value));
  }

  /// The last element takes the place of the top: the hole sinks to a leaf, and the element rises from there.
  void pop() {
    T last = std::move(elements_.back());
    elements_.pop_back();
    if (elements_.empty()) return;
    std::size_t hole = 0;
    for (std::size_t child = 1; child < elements_.size(); child = 2 * hole + 1) {
      if (child + 1 < elements_.size() && !(elements_[child + 1] < elements_[child])) ++child;
      elements_[hole] = std::move(elements_[child]);
      hole = child;
    }
    rise(hole, std::move(last));
  }

 private:
  void rise(std::size_t hole, T value) {
    while (hole > 0 && elements_[(hole - 1) / 2] < value) {
      elements_[hole] = std::move(elements_[(hole - 1) / 2]);
      hole = (hole - 1) / 2;
    }
    elements_[hole] = std::move(value);
  }

  std::vector<T> elements_;
};

}  // namespace prohull
