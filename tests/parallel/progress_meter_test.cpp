#include "prohull/detail/progress_meter.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "progress.h"

namespace prohull {
namespace {

TEST(ProgressMeter, TellsWhatHasGoneForwardOnly) {
  const UnthrottledProgress unthrottled;
  std::vector<double> told;
  const Progress progress = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "work");
    told.push_back(fraction);
    return true;
  };
  ProgressMeter meter(progress, "work");
  for (const double fraction : {0.0, 0.5, 0.25, 0.75, 7.0}) meter.at(fraction);
  EXPECT_EQ(told, (std::vector{0.0, 0.5, 0.5, 0.75, 1.0}));
}

TEST(ProgressMeter, TellsSeldom) {
  int calls = 0;
  const Progress progress = [&](std::string_view, double) { return ++calls > 0; };
  ProgressMeter::interval = std::chrono::hours(1);
  ProgressMeter meter(progress, "work");
  for (int i = 0; i < 1000; ++i) meter.at(0.0001 * i);
  EXPECT_EQ(calls, 1) << "at the start";
  meter.at(1);
  EXPECT_EQ(calls, 2) << "and at the end";
  ProgressMeter::interval = std::chrono::milliseconds(20);
}

TEST(ProgressMeter, TellsOnTheThreadThatMadeItAndCancelsAll) {
  const UnthrottledProgress unthrottled;
  const auto maker = std::this_thread::get_id();
  const Progress progress = [&](std::string_view, double) {
    EXPECT_EQ(std::this_thread::get_id(), maker);
    return false;
  };
  ProgressMeter meter(progress, "work");
  const auto at_on_another_thread = [&] {
    bool cancelled = false;
    std::thread([&] {
      try {
        meter.at(0.5);
      } catch (const Cancelled&) {
        cancelled = true;
      }
    }).join();
    return cancelled;
  };
  EXPECT_FALSE(at_on_another_thread()) << "nobody has been asked";
  EXPECT_THROW(meter.at(0.5), Cancelled);
  EXPECT_TRUE(at_on_another_thread());
}

TEST(ProgressMeter, MapsPartsOfTheWork) {
  const UnthrottledProgress unthrottled;
  double told = 0;
  const Progress progress = [&](std::string_view stage, double fraction) {
    return stage == "whole" && (told = fraction) >= 0;
  };
  ProgressMeter meter(progress, "whole");
  const Progress second_half = meter.part(0.5, 1);
  ProgressMeter(second_half, "part").at(0.5);
  EXPECT_EQ(told, 0.75);
}

}  // namespace
}  // namespace prohull
