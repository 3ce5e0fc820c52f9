#include "geometry/select.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

#include "random.h"

namespace prohull {
namespace {

using Entry = std::pair<int, int>;  // a key that many share, and where it was

std::vector<Entry> entries(std::mt19937& random) {
  const int count = std::uniform_int_distribution(0, 300)(random), keys = std::uniform_int_distribution(1, 60)(random);
  std::vector<Entry> result;
  for (int i = 0; i < count; ++i) result.emplace_back(std::uniform_int_distribution(0, keys)(random), i);
  return result;
}

bool has_less_key(const Entry& a, const Entry& b) { return a.first < b.first; }

#ifdef __GLIBCXX__
constexpr bool kIsLibstdcxx = true;
#else
constexpr bool kIsLibstdcxx = false;
#endif

TEST(Select, PutsTheNthInItsPlace) {
  std::mt19937 random(test_seed());
  for (int round = 0; round < 2000; ++round) {
    std::vector<Entry> mine = entries(random), theirs = mine;
    const auto nth = std::uniform_int_distribution<std::ptrdiff_t>(0, std::ssize(mine))(random);
    select_nth(mine.begin(), mine.begin() + nth, mine.end(), has_less_key);
    std::nth_element(theirs.begin(), theirs.begin() + nth, theirs.end(), has_less_key);
    EXPECT_TRUE(!kIsLibstdcxx || mine == theirs) << "it takes the same steps";
    if (nth == std::ssize(mine)) continue;
    EXPECT_EQ(mine[std::size_t(nth)].first, theirs[std::size_t(nth)].first);
    for (std::ptrdiff_t i = 0; i < std::ssize(mine); ++i)
      EXPECT_FALSE(i < nth ? has_less_key(mine[std::size_t(nth)], mine[std::size_t(i)])
                           : has_less_key(mine[std::size_t(i)], mine[std::size_t(nth)]));
  }
}

TEST(SortWithTies, SortsAndOrdersTiesAsLibstdcxxDoes) {
  std::mt19937 random(test_seed());
  for (int round = 0; round < 2000; ++round) {
    std::vector<Entry> mine = entries(random), theirs = mine;
    sort_with_ties(mine.begin(), mine.end(), has_less_key);
    std::sort(theirs.begin(), theirs.end(), has_less_key);
    EXPECT_TRUE(std::is_sorted(mine.begin(), mine.end(), has_less_key));
    EXPECT_TRUE(!kIsLibstdcxx || mine == theirs);
  }
}

}  // namespace
}  // namespace prohull
