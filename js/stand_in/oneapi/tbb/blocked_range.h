#pragma once

#include <cstddef>

// One thread in place of oneTBB: what src/ uses of it, with the same results. Only the build for WebAssembly sees this.
namespace oneapi::tbb {

template <class Value>
class blocked_range {
 public:
  blocked_range(Value begin, Value end, std::size_t grain = 1) : begin_(begin), end_(end), grain_(grain) {}
  Value begin() const { return begin_; }
  Value end() const { return end_; }
  bool is_divisible() const { return grain_ < static_cast<std::size_t>(end_ - begin_); }
  Value middle() const { return begin_ + (end_ - begin_) / Value{2}; }
  blocked_range first_half() const { return {begin_, middle(), grain_}; }
  blocked_range second_half() const { return {middle(), end_, grain_}; }

 private:
  Value begin_, end_;
  std::size_t grain_;
};

}  // namespace oneapi::tbb
