#pragma once

namespace prohull::cli {

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
