#include "robot/side_by_side.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <set>
#include <thread>

#include "input_error.h"
#include "prohull/error.h"

namespace prohull::robot {
namespace {

const std::vector<std::string> kNames{"base", "arm", "hand", "finger"};

TEST(SideBySide, DoesEachOnce) {
  for (const unsigned threads : {0U, 1U, 2U, 9U}) {
    std::array<std::atomic<int>, 4> done{};
    side_by_side(kNames, threads, {}, [&](std::size_t i, const Progress& go_on) {
      EXPECT_TRUE(go_on("", 0));
      ++done[i];
    });
    for (const auto& times : done) EXPECT_EQ(times, 1);
  }
  side_by_side({}, 0, {}, [](std::size_t, const Progress&) { FAIL(); });
}

TEST(SideBySide, TellsOnTheThreadOfTheCaller) {
  const std::thread::id caller = std::this_thread::get_id();
  std::set<std::string> stages;
  double last = 0;
  const Progress progress = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_GE(fraction, last);
    last = fraction, stages.emplace(stage);
    return true;
  };
  side_by_side(kNames, 1, progress,
               [&](std::size_t, const Progress&) { std::this_thread::sleep_for(std::chrono::milliseconds(60)); });
  EXPECT_TRUE(stages.contains("finger"));
}

TEST(SideBySide, CancelsWhatIsUnderWay) {
  std::atomic<int> begun = 0;
  const auto work = [&](std::size_t, const Progress& go_on) {
    ++begun;
    while (go_on("", 0)) std::this_thread::yield();
    throw Cancelled();
  };
  EXPECT_THROW(side_by_side(
                   kNames, 2, [](std::string_view, double) { return false; }, work),
               Cancelled);
  EXPECT_EQ(begun, workers_for(kNames.size(), 2));
}

TEST(SideBySide, HasNoMoreWorkersThanCores) {
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  EXPECT_EQ(workers_for(1000, 0), std::min<std::size_t>(1000, cores));
  EXPECT_EQ(workers_for(100'000, 90'000), std::min<std::size_t>(90'000, cores));
  EXPECT_EQ(workers_for(1000, 1), 1U);
  EXPECT_EQ(workers_for(1, 8), 1U);
  std::atomic<std::size_t> now = 0, most = 0;
  side_by_side(std::vector<std::string>(4 * cores, "link"), 1000, {}, [&](std::size_t, const Progress&) {
    const std::size_t with_this = ++now;
    for (std::size_t known = most; known < with_this && !most.compare_exchange_weak(known, with_this);) continue;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    --now;
  });
  EXPECT_LE(most, cores);
}

TEST(SideBySide, ThrowsTheExceptionOfTheFirstName) {
  for (const unsigned threads : {1U, 2U, 4U}) {
    const auto work = [&](std::size_t i, const Progress&) {
      if (i == 1) std::this_thread::sleep_for(std::chrono::milliseconds(20));  // the next one may throw before it
      if (i > 0) throw InputError(Defect::EmptyMesh, kNames[i]);
    };
    EXPECT_STREQ(error_of([&] { side_by_side(kNames, threads, {}, work); }).what(), "arm");
  }
}

TEST(SideBySide, BeginsNothingAfterAnException) {
  std::atomic<std::size_t> begun = 0, finished = 0;
  std::atomic<bool> has_thrown = false;
  const auto work = [&](std::size_t i, const Progress& go_on) {
    ++begun;
    if (i == 0) {
      has_thrown = true;
      throw InputError(Defect::EmptyMesh, "link");
    }
    while (!has_thrown) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_TRUE(go_on("", 0)) << "what is under way finishes";
    ++finished;
  };
  double told = 0;
  const auto progress = [&](std::string_view, double fraction) { return told = fraction, true; };
  EXPECT_THROW(side_by_side(std::vector<std::string>(1000, "link"), 2, progress, work), InputError);
  EXPECT_LE(begun, 3U);  // a second one may begin before the first one has thrown
  EXPECT_EQ(finished, begun - 1);
  EXPECT_LT(told, 1);
}

}  // namespace
}  // namespace prohull::robot
