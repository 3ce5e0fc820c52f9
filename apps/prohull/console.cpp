#include "console.h"

#include <unistd.h>

#include <algorithm>

#include "interrupt.h"

namespace prohull::cli {
namespace {

/// The length of the UTF-8 sequence that the text begins with; 0 if it is none, or one of a control character.
std::size_t shown_bytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return (lead >= 0x20 && lead != 0x7f) || lead == '\n' || lead == '\t';
  const std::size_t size = lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : lead < 0xf5 ? 4 : 0;
  if (size == 0 || size > text.size()) return 0;
  for (std::size_t i = 1; i < size; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const bool is_control = lead == 0xc2 && byte(1) < 0xa0;
  return is_control ? 0 : size;
}

}  // namespace

Console& console() {
  static Console the_console;
  return the_console;
}

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const std::size_t bytes = shown_bytes(text);
    if (bytes > 0)
      shown += text.substr(0, bytes);
    else
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return shown;
}

void tell(std::string_view text, std::FILE* to) { std::fputs(printable(text).c_str(), to); }

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
