#pragma once
// The program at work, to be watched and disturbed.

#include "app/program.h"

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace test {

inline constexpr auto patience = std::chrono::seconds(60);

/// The program in the background, its stderr in a file or on a terminal.
class Running {
  public:
    Running(const Workplace& place, const std::string& arguments, const char* stderr_path)
        : child_(fork()) {
        if (child_ != 0)
            return;
        const std::string command = "exec '" HEMILUX_PROGRAM "' " + arguments;
        const int talk = open(stderr_path, O_WRONLY | O_CREAT | O_TRUNC | O_NOCTTY, 0600);
        const bool ready = chdir(place.path("").c_str()) == 0 && dup2(talk, STDERR_FILENO) >= 0;
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
        waitpid(std::exchange(child_, -1), &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

  private:
    pid_t child_;
};

/// Until the file contains the text; false when that takes too long.
inline bool wait_for(const Workplace& place, const std::string& file, const std::string& text) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (place.read(file).find(text) == std::string::npos) {
        if (std::chrono::steady_clock::now() > end)
            return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
}

} // namespace test
