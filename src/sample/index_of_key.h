#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "prohull/detail/scramble.h"

namespace prohull {

/// Numbers keys 0, 1, 2, ... in the order in which they are first seen. A flat hash table with linear probing.
class IndexOfKey {
 public:
  struct Found {
    std::uint32_t index;
    bool is_new;
  };

  Found find_or_add(std::uint64_t key) {
    if (2 * std::size_t(count_) >= slots_.size()) grow();
    Slot& slot = slot_of(key);
    const bool is_new = slot.index == kFree;
    if (is_new) slot = {key, count_++};
    return {slot.index, is_new};
  }

 private:
  static constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t index = kFree;
  };

  Slot& slot_of(std::uint64_t key) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = scramble(key) & mask;
    while (slots_[i].index != kFree && slots_[i].key != key) i = (i + 1) & mask;
    return slots_[i];
  }

  void grow() {
    std::vector<Slot> old(slots_.empty() ? 1024 : 2 * slots_.size());
    old.swap(slots_);
    for (const Slot& s : old)
      if (s.index != kFree) slot_of(s.key) = s;
  }

  std::vector<Slot> slots_;
  std::uint32_t count_ = 0;
};

}  // namespace prohull
