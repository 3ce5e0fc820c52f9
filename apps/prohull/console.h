#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "prohull/detail/stopwatch.h"
#include "prohull/detail/text.h"

namespace prohull::cli {

// What a command tells its user: a summary, and how far it is. Errors are main's, and go to standard error in any case.

struct Console {
  bool quiet = false, verbose = false;
  std::FILE* summary = stdout;  ///< stderr where standard output carries a file
};
Console& console();

/// Text without what could control a terminal, since it may quote file names and what files hold: "\\x1b" stands for
/// the byte 0x1b, and so on. New lines, tabs and all other UTF-8 stay.
std::string printable(std::string_view text);

/// The way of all messages to the terminal: prints what is printable. Errors of printing are not told.
void tell(std::string_view text, std::FILE* to);

/// What is printable, on one line: new lines and tabs, as names may have them, become "\\x0a" and "\\x09".
std::string one_line(std::string_view text);

/// In single quotes, as every POSIX shell reads them; with fish the text must have no backslash.
std::string quoted(const std::string& text);

/// The text as one word of a command line, quoted if a shell would not take it as it is.
std::string shell_word(const std::string& text);

/// Tells an error on one line of standard error.
void tell_error(std::string_view what);

/// Prints a part of the summary, unless --quiet was given.
template <class... Values>
void say(fmt::format_string<Values...> text, Values&&... values) {
  if (!console().quiet) tell(fmt::format(text, std::forward<Values>(values)...), console().summary);
}

/// Prints what only --verbose shows.
template <class... Values>
void say_more(fmt::format_string<Values...> text, Values&&... values) {
  if (console().verbose) say(text, std::forward<Values>(values)...);
}

/// A prohull::Progress that draws how far each stage is on one line of standard error, if that is a terminal. The line
/// vanishes with the object. Returns false once the user has interrupted.
class ProgressLine {
 public:
  ProgressLine() = default;
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();
  bool operator()(std::string_view stage, double fraction);

 private:
  using Clock = std::chrono::steady_clock;

  std::string stage_;
  double fraction_ = 0;
  bool shown_ = false;
  Clock::time_point started_ = Clock::now(), drawn_;
};

/// From now on Ctrl-C, SIGTERM and SIGHUP (not under nohup) end the program within a second, with kInterrupted:
/// `interrupted` becomes true, so that the work may end by itself; if it has not after a moment, or at a second Ctrl-C,
/// `clean_up` is called on another thread and the program ends.
void catch_interrupts(void (*clean_up)());

bool interrupted();

/// Throws Cancelled if the user has interrupted.
void stop_if_interrupted();

/// Says that nothing was written, or no more than what was finished before; returns kInterrupted.
int tell_interrupted();

}  // namespace prohull::cli
