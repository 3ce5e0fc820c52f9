#include "console.h"

#include <semaphore.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <thread>

#include "command.h"
#include "prohull/error.h"

namespace prohull::cli {

Console& console() {
  static Console the_console;
  return the_console;
}

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const std::size_t bytes = text[0] == '\r' ? 0 : character_length(text);
    if (bytes > 0)
      shown += text.substr(0, bytes);
    else
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return shown;
}

void tell(std::string_view text, std::FILE* to) { std::fputs(printable(text).c_str(), to); }

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) line += c == '\n' || c == '\t' ? fmt::format("\\x{:02x}", c) : std::string(1, c);
  return printable(line);
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string shell_word(const std::string& text) {
  constexpr std::string_view kSpecial = " \t\n\\'\"`$&|;<>()[]{}*?!#~=%^";
  return text.empty() || text.find_first_of(kSpecial) != text.npos ? quoted(text) : text;
}

void tell_error(std::string_view what) { tell("prohull: " + one_line(what) + "\n", stderr); }

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

namespace {

volatile std::sig_atomic_t g_interrupted = 0;
sem_t g_signals;  // a handler may post it, but not much else

void remember(int) {
  g_interrupted = 1;
  sem_post(&g_signals);
}

void wait_for_signal() {
  while (sem_wait(&g_signals) != 0) {
  }
}

/// Until another signal comes, at most.
void wait_a_moment() {
  constexpr long kMoment = 600'000'000, kSecond = 1'000'000'000;  // nanoseconds
  timespec until{};
  clock_gettime(CLOCK_REALTIME, &until);
  until.tv_nsec += kMoment;
  if (until.tv_nsec >= kSecond) until.tv_nsec -= kSecond, ++until.tv_sec;
  while (sem_timedwait(&g_signals, &until) != 0 && errno == EINTR) {
  }
}

}  // namespace

void catch_interrupts(void (*clean_up)()) {
  sem_init(&g_signals, 0, 0);
  std::thread([clean_up] {
    wait_for_signal();
    wait_a_moment();
    clean_up();
    _exit(tell_interrupted());
  }).detach();
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
  if (std::signal(SIGHUP, remember) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // under nohup
}

bool interrupted() { return g_interrupted != 0; }

void stop_if_interrupted() {
  if (interrupted()) throw Cancelled();
}

int tell_interrupted() {
  if (isatty(STDERR_FILENO)) std::fputs("\r\x1b[K", stderr);
  tell(has_any_output_appeared() ? "prohull: interrupted; only what was finished before is written\n"
                                 : "prohull: interrupted; nothing was written\n",
       stderr);
  return kInterrupted;
}

}  // namespace prohull::cli
