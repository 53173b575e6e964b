#include "app/signals.h"

#include "app/exit_code.h"

#include <csignal>
#include <unistd.h>

namespace hemilux {

namespace {

std::atomic<std::atomic<bool>*> interrupted{nullptr};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not wait for a lock");

/// Only what is safe in a signal handler (POSIX.1, signal-safety).
extern "C" void on_interrupt(int) {
    std::atomic<bool>* const flag = interrupted;
    if (!flag || flag->exchange(true))
        _exit(exit_interrupted);
}

} // namespace

InterruptGuard::InterruptGuard(std::atomic<bool>& flag) {
    interrupted = &flag;
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    action.sa_flags = SA_RESTART; // a write that is under way goes on
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_DFL);
    interrupted = nullptr;
}

} // namespace hemilux
