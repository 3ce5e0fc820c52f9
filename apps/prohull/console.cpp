#include "console.h"

#include <unistd.h>

#include <algorithm>

#include "interrupt.h"

namespace prohull::cli {

Console& console() {
  static Console the_console;
  return the_console;
}

std::string grouped(std::size_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

std::string counted(std::size_t number, const char* one, const char* many) {
  return grouped(number) + ' ' + (number == 1 ? one : many);
}

ProgressLine::~ProgressLine() {
  if (shown_) fmt::print(stderr, "\r\x1b[K");
}

bool ProgressLine::operator()(std::string_view stage, double fraction) {
  constexpr std::chrono::milliseconds kInterval(100);
  const auto now = Clock::now();
  if (stage != stage_) stage_ = stage, fraction_ = 0, started_ = now;
  fraction_ = std::max(fraction_, std::clamp(fraction, 0.0, 1.0));
  if (now - drawn_ >= kInterval && !console().quiet && isatty(STDERR_FILENO)) {
    constexpr int kWidth = 30;
    const int filled = static_cast<int>(kWidth * fraction_);
    fmt::print(stderr, "\r\x1b[K{:<8} [{:=<{}}{: <{}}] {:3.0f} %  {:.0f} s", stage_, "", filled, "", kWidth - filled,
               100 * fraction_, std::chrono::duration<double>(now - started_).count());
    std::fflush(stderr);
    shown_ = true;
    drawn_ = now;
  }
  return !interrupted();
}

}  // namespace prohull::cli
