#include "construct/edge_queue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "effort.h"
#include "random.h"

namespace prohull {
namespace {

constexpr std::size_t kEdges = 300;

/// The order by priority and edge, or by octave bucket and age, of a multimap.
template <class Rank>
class Reference {
 public:
  bool empty() const { return sorted_.empty(); }
  bool contains(EdgeId e) const { return places_.contains(e); }
  void insert(EdgeId e, double priority) { places_[e] = sorted_.emplace(Rank()(e, priority, ++age_), e); }
  void erase(EdgeId e) {
    sorted_.erase(places_.at(e));
    places_.erase(e);
  }
  EdgeId pop() {
    const EdgeId e = sorted_.begin()->second;
    erase(e);
    return e;
  }
  /// Whether an edge inserted now with this priority would not be behind any other with a smaller priority.
  bool precedes_all(double priority) const {
    return empty() || Rank()(EdgeId{0}, priority, 0).first <= sorted_.begin()->first.first;
  }

 private:
  using Place = std::pair<double, std::uint64_t>;
  std::multimap<Place, EdgeId> sorted_;
  std::map<EdgeId, std::multimap<Place, EdgeId>::iterator> places_;
  std::uint64_t age_ = 0;
};

struct ByPriorityAndEdge {
  std::pair<double, std::uint64_t> operator()(EdgeId e, double priority, std::uint64_t) const {
    return {priority, index(e)};
  }
};

struct ByEighthOfOctaveAndAge {
  std::pair<double, std::uint64_t> operator()(EdgeId, double priority, std::uint64_t age) const {
    if (priority < std::numeric_limits<double>::min()) return {0, age};  // denormal numbers are not in the test
    const double octave = std::floor(std::log2(priority));
    return {octave + std::floor((priority / std::exp2(octave) - 1) * 8) / 8 + 2000, age};
  }
};

template <class Queue, class Rank>
void compare_with_reference() {
  std::mt19937 random(test_seed());
  Queue queue(kEdges);
  Reference<Rank> reference;
  const auto random_priority = [&]() -> double {
    switch (random() % 6) {
      case 0:
        return 0;
      case 1:
        return static_cast<double>(random() % 4);
      case 2:
        return std::ldexp(1.0, static_cast<int>(random() % 2000) - 1000);
      case 3:
        return 1 + static_cast<double>(random() % 16) / 8;
      default:
        return std::exp(std::uniform_real_distribution<double>(-20, 20)(random));
    }
  };
  for (int i = 0; i < rounds(200000); ++i) {
    const EdgeId e{static_cast<std::uint32_t>(random() % kEdges)};
    const double priority = random_priority();
    ASSERT_EQ(queue.contains(e), reference.contains(e));
    ASSERT_EQ(queue.empty(), reference.empty());
    ASSERT_EQ(queue.precedes_all(priority), reference.precedes_all(priority)) << priority;
    // Long phases of growth and of shrinking.
    const bool grows = i / 2000 % 2 == 0;
    if (queue.contains(e)) {
      if (grows && random() % 2) continue;
      queue.erase(e), reference.erase(e);
    } else if (grows || random() % 3 == 0) {
      queue.insert(e, priority), reference.insert(e, priority);
    } else if (!queue.empty()) {
      ASSERT_EQ(queue.pop(), reference.pop()) << "operation " << i;
    }
  }
  while (!reference.empty()) ASSERT_EQ(queue.pop(), reference.pop());
  EXPECT_TRUE(queue.empty());
}

TEST(EdgeHeap, PopsLikeASortedMap) { compare_with_reference<EdgeHeap, ByPriorityAndEdge>(); }
TEST(EdgeTree, PopsLikeASortedMap) { compare_with_reference<EdgeTree, ByPriorityAndEdge>(); }
TEST(EdgeBuckets, PopByEighthsOfAnOctaveThenByAge) { compare_with_reference<EdgeBuckets, ByEighthOfOctaveAndAge>(); }

TEST(EdgeBuckets, FirstInFirstOutWithinABucket) {
  EdgeBuckets queue(5);
  for (const std::uint32_t e : {3, 1, 4, 0, 2}) queue.insert(EdgeId{e}, 1 + 0.01 * e);
  for (const std::uint32_t e : {3, 1, 4, 0, 2}) EXPECT_EQ(queue.pop(), EdgeId{e});
}

TEST(EdgeBuckets, EightToAnOctave) {
  EdgeBuckets queue(3);
  queue.insert(EdgeId{0}, 1.125);
  EXPECT_FALSE(queue.precedes_all(1.25));
  EXPECT_TRUE(queue.precedes_all(std::nextafter(1.25, 0)));
  queue.insert(EdgeId{1}, std::nextafter(1.125, 0));
  EXPECT_EQ(queue.pop(), EdgeId{1}) << "an ulp below, but in the bucket before";
}

TEST(EdgeBuckets, TakeEveryPriorityFromZeroToInfinity) {
  EdgeBuckets queue(5);
  const double denormal = std::numeric_limits<double>::denorm_min();
  queue.insert(EdgeId{0}, std::numeric_limits<double>::infinity());
  queue.insert(EdgeId{1}, std::numeric_limits<double>::max());
  queue.insert(EdgeId{2}, 1);
  queue.insert(EdgeId{3}, denormal);
  queue.insert(EdgeId{4}, -0.0);
  EXPECT_EQ(queue.pop(), EdgeId{3}) << "in one bucket with zero";
  for (const std::uint32_t e : {4, 2, 1, 0}) EXPECT_EQ(queue.pop(), EdgeId{e});
}

}  // namespace
}  // namespace prohull
