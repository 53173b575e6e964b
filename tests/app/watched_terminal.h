#pragma once
// A terminal on which the program runs, and all that it shows.

#include "support/catch.h"

#include <cstdlib>
#include <fcntl.h>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <unistd.h>

namespace test {

class WatchedTerminal {
  public:
    WatchedTerminal() : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
        REQUIRE(master_ >= 0);
        REQUIRE(grantpt(master_) == 0);
        REQUIRE(unlockpt(master_) == 0);
        name_ = ptsname(master_);
        keep_open_ = open(name_.c_str(), O_WRONLY | O_NOCTTY); // reading ends without an error
        reader_ = std::thread([this] { read_until_end(); });
    }
    ~WatchedTerminal() { end(); }
    WatchedTerminal(const WatchedTerminal&) = delete;
    WatchedTerminal& operator=(const WatchedTerminal&) = delete;

    [[nodiscard]] const char* name() const { return name_.c_str(); }
    /// Returns what was shown so far.
    [[nodiscard]] std::string seen() const {
        const std::scoped_lock lock(mutex_);
        return seen_;
    }
    /// Ends reading, once the program has ended; returns all that was shown.
    std::string end() {
        if (reader_.joinable()) {
            CHECK(write(keep_open_, last_.data(), last_.size()) == ssize_t(last_.size()));
            reader_.join();
            close(keep_open_);
            close(master_);
        }
        return seen();
    }

  private:
    void read_until_end() {
        char buffer[256];
        while (seen().find(last_) == std::string::npos) {
            const ssize_t count = read(master_, buffer, sizeof buffer);
            if (count <= 0)
                return;
            const std::scoped_lock lock(mutex_);
            seen_.append(buffer, static_cast<std::size_t>(count));
        }
    }

    static constexpr std::string_view last_ = "the end of what a test watches";
    int master_, keep_open_ = -1;
    std::string name_, seen_;
    mutable std::mutex mutex_;
    std::thread reader_;
};

} // namespace test
