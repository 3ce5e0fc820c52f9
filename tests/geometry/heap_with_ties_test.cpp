#include "geometry/heap_with_ties.h"

#include <gtest/gtest.h>

#include <queue>
#include <random>

#include "random.h"

namespace prohull {
namespace {

struct Keyed {
  int key, number;  // many share a key
  bool operator<(const Keyed& other) const { return key < other.key; }
};

TEST(HeapWithTies, HasTheSameElementOnTopAsThatOfLibstdcxx) {
  std::mt19937 random(test_seed());
  HeapWithTies<Keyed> mine;
  std::priority_queue<Keyed> theirs;
  for (int i = 0; i < 20000; ++i) {
    const bool grows = std::uniform_int_distribution(0, 99)(random) < (i % 2000 < 1000 ? 70 : 30);
    if (grows || mine.empty()) {
      const Keyed next{std::uniform_int_distribution(0, 20)(random), i};
      mine.push(next), theirs.push(next);
    } else {
      mine.pop(), theirs.pop();
    }
    ASSERT_EQ(mine.size(), theirs.size());
    if (mine.empty()) continue;
    ASSERT_EQ(mine.top().key, theirs.top().key);
#ifdef __GLIBCXX__
    ASSERT_EQ(mine.top().number, theirs.top().number);
#endif
  }
}

}  // namespace
}  // namespace prohull
