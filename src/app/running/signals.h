#pragma once
// Handles the signals that ask the program to end: Ctrl-C, SIGTERM, SIGHUP of a terminal that is
// closed (unless it is ignored, as by nohup), SIGXCPU of a limit of processor time. The first one
// asks the solver to stop, so that what was computed is still written; a second SIGINT or SIGTERM
// ends the program at once, and takes away files that are half-written. Writing after a signal has
// no limit of time: it takes longer for large outputs, and a second signal is at hand.

#include <atomic>

namespace hemilux {

/// A guard that, while it lives, takes these signals for itself; there is one at a time.
class InterruptGuard {
  public:
    /// Takes the signals. As long as there is nothing to save, a signal ends the program at once.
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// Makes every later signal set the flag. Call it before telling of the stage at which there is
    /// something to save: who waits for that word may send a signal right after it.
    void watch(std::atomic<bool>& flag);
};

/// Returns how the program ends after the first signal: 128 and its number, such as 130 or 143.
[[nodiscard]] int exit_code_of_signal();

/// Ends the program after a signal, when all is written: the system takes the memory back sooner
/// than it could be given back piece by piece.
[[noreturn]] void end_at_once(int code);

/// Prepares the process; main calls it. Writing to a pipe that nobody reads, or beyond the limit of
/// a file's size, becomes an error to be reported, not a death. No file is ever opened in the place
/// of a closed stdout or stderr.
void prepare_process();

} // namespace hemilux
