#pragma once
// The program at work, to be watched and disturbed.

#include "app/program.h"

#include <chrono>
#include <csignal>
#include <cstdint>
#include <fcntl.h>
#include <fstream>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace test {

/// Nothing is expected to take so long, even on a slow machine with other work: what does failed.
inline constexpr auto patience = std::chrono::minutes(5);

/// Looks again and again until the condition holds; false when that takes too long.
template <class Condition>
bool wait_until(const Condition& condition) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end)
            return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

/// The program in the background, its stderr in a file or on a terminal.
class Running {
  public:
    Running(const Workplace& place, const std::string& arguments, const char* stderr_path)
        : child_(fork()) {
        if (child_ != 0)
            return;
        const std::string command = "exec '" HEMILUX_PROGRAM "' " + arguments;
        const int stderr_fd = open(stderr_path, O_WRONLY | O_CREAT | O_TRUNC | O_NOCTTY, 0600);
        const bool ready =
            chdir(place.path("").c_str()) == 0 && dup2(stderr_fd, STDERR_FILENO) >= 0;
        if (ready)
            execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        _exit(127);
    }
    ~Running() {
        if (child_ > 0) {
            kill(child_, SIGKILL);
            waitpid(child_, nullptr, 0);
        }
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    void interrupt() const { send(SIGINT); }
    void send(int signal) const { kill(child_, signal); }
    /// The exit code, or -1 for a death by signal.
    int wait() {
        int status = 0;
        rusage usage{};
        wait4(std::exchange(child_, -1), &status, 0, &usage);
        seconds_of_processors_ = seconds(usage.ru_utime) + seconds(usage.ru_stime);
        peak_bytes_ = 1024.0 * static_cast<double>(usage.ru_maxrss);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    /// The most memory that it had at once, after `wait`.
    [[nodiscard]] double peak_bytes() const { return peak_bytes_; }
    /// Whether the process has come to its end; `wait` still gives its exit code.
    [[nodiscard]] bool ended() const {
        siginfo_t info{};
        return waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
               info.si_pid == child_;
    }
    /// Whether the program has a handler of its own for the signal. Before the process becomes
    /// hemilux it has the handlers of these tests, which take SIGABRT too, and then the shell's.
    /// One reading tells them apart: between two readings one program may follow another.
    [[nodiscard]] bool handles(int signal) const {
        const auto has = [](std::uint64_t set, int member) {
            return (set >> (member - 1) & 1) != 0;
        };
        std::ifstream status("/proc/" + std::to_string(child_) + "/status");
        for (std::string word; status >> word;)
            if (std::uint64_t handled = 0; word == "SigCgt:" && status >> std::hex >> handled)
                return has(handled, signal) && !has(handled, SIGABRT);
        return false;
    }
    /// Time that processors have worked for it, which other programs do not lengthen: so far, or
    /// after `wait` in all.
    [[nodiscard]] double seconds_of_processors() const {
        if (child_ < 0)
            return seconds_of_processors_;
        std::ifstream stat("/proc/" + std::to_string(child_) + "/stat");
        std::string field; // the second field, a name in brackets, has no blank here
        double user = 0, system = 0;
        for (int i = 1; i < 14; ++i)
            stat >> field;
        stat >> user >> system;
        return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
    }

  private:
    static double seconds(const timeval& t) {
        return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) / 1e6;
    }

    double seconds_of_processors_ = 0, peak_bytes_ = 0;
    pid_t child_;
};

/// Until the file contains the text; false when that takes too long.
inline bool wait_for(const Workplace& place, const std::string& file, const std::string& text) {
    return wait_until([&] { return place.read(file).find(text) != std::string::npos; });
}

/// Of the file that has the name now: atomic writing gives each version a time of its own.
struct FileVersion {
    std::uint64_t inode = 0;
    std::int64_t seconds = 0, nanoseconds = 0;
    bool operator==(const FileVersion&) const = default;
};

/// All zeros where there is no such file.
inline FileVersion version_of(const Workplace& place, const std::string& file) {
    struct stat status {};
    if (stat(place.path(file).c_str(), &status) != 0)
        return {};
    return {status.st_ino, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

} // namespace test
