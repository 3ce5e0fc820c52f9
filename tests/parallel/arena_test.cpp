#include "parallel/arena.h"

#include <gtest/gtest.h>

#include <barrier>
#include <thread>
#include <utility>
#include <vector>

namespace prohull {
namespace {

TEST(Arena, CallsOfOneThreadDoNotWaitForEachOther) {
  constexpr int kCalls = 4;
  std::barrier all_at_once(kCalls);
  std::vector<std::jthread> callers;
  for (int i = 0; i < kCalls; ++i)
    callers.emplace_back([&] { arena_of(1).execute([&] { all_at_once.arrive_and_wait(); }); });
}

TEST(Arena, IsLentToOneCallAtATimeAndThenAgain) {
  ArenaPool pool;
  ArenaPool::Arenas one = pool.take(1);
  const ArenaPool::Arenas other = pool.take(1);
  const auto* const arena = &one.front();
  EXPECT_NE(arena, &other.front());
  pool.put_back(1, std::move(one));
  EXPECT_EQ(&pool.take(1).front(), arena);
}

}  // namespace
}  // namespace prohull
