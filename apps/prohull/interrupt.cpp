#include "interrupt.h"

#include <semaphore.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <thread>

#include "command.h"
#include "prohull/error.h"

namespace prohull::cli {
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
