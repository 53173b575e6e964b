#include "app/running/signals.h"

#include "app/settings/exit_code.h"
#include "io/files/atomic_file.h"
#include "io/files/temporary_file.h"
#include "io/pictures/picture_files.h"
#include "radiosity/answers/images/image.h"

#include <array>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <iostream>
#include <poll.h>
#include <string_view>
#include <unistd.h>

namespace hemilux {

namespace {

constexpr std::array<int, 4> signals{SIGINT, SIGTERM, SIGHUP, SIGXCPU};

std::atomic<std::atomic<bool>*> interrupted{nullptr};
std::atomic<int> exit_code{exit_interrupted};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler must not wait for a lock");

/// Returns whether a signal may come again by itself: a terminal that is closed sends one, and its
/// shell another; the limit of processor time sends one each second.
bool repeats(int signal) { return signal == SIGHUP || signal == SIGXCPU; }

/// Does only what is safe in a signal handler (POSIX.1, signal-safety). AddressSanitizer would add
/// warnings of its own before _exit, on a thread that is being started, and wait for their reader.
extern "C" [[gnu::no_sanitize_address]] void on_interrupt(int signal) {
    constexpr int of_shells = 128;
    std::atomic<bool>* const flag = interrupted;
    if (flag && !flag->exchange(true)) {
        exit_code = of_shells + signal;
        return;
    }
    if (flag && repeats(signal))
        return;
    remove_listed_temporaries();
    if (!flag) {
        constexpr std::string_view text = "hemilux: interrupted before there was a result\n";
        pollfd stderr_fd{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
        if (poll(&stderr_fd, 1, 0) > 0) // else nobody reads what is said
            (void)!write(STDERR_FILENO, text.data(), text.size());
    }
    _exit(of_shells + signal);
}

} // namespace

InterruptGuard::InterruptGuard() {
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    action.sa_flags = SA_RESTART; // a write that is under way goes on
    sigemptyset(&action.sa_mask);
    for (const int signal : signals) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (signal == SIGHUP && before.sa_handler == SIG_IGN) // by nohup
            continue;
        sigaction(signal, &action, nullptr);
    }
}

InterruptGuard::~InterruptGuard() {
    for (const int signal : signals)
        if (struct sigaction now{};
            sigaction(signal, nullptr, &now) == 0 && now.sa_handler == on_interrupt)
            std::signal(signal, SIG_DFL);
    interrupted = nullptr;
    end_waits_on(nullptr);
    compress_little_on(nullptr);
}

void InterruptGuard::watch(std::atomic<bool>& flag) {
    end_waits_on(&flag);
    compress_little_on(&flag);
    interrupted = &flag;
}

int exit_code_of_signal() { return exit_code; }

void end_at_once(int code) {
    std::cout.flush();
    std::fflush(nullptr);
    _exit(code);
}

void prepare_process() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    // Opening takes the lowest number that is free. Writing to what is open for reading fails.
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(descriptor, F_GETFD) < 0)
            (void)!open("/dev/null", O_RDONLY);
}

} // namespace hemilux
