#pragma once
// A record of which files were written. One that fails does not keep the others from being written.

#include "app/settings/settings.h"

#include <functional>
#include <string>
#include <vector>

namespace hemilux {

struct WriteReport {
    std::vector<std::string> written;  ///< paths
    std::vector<std::string> failed;   ///< messages
    std::vector<std::string> left_out; ///< paths, because the user asked the program to end

    /// Calls `write` and notes whether it threw.
    void attempt(const std::string& path, const std::function<void()>& write);
    void add(const WriteReport& other);
    /// Returns the exit code; a failure counts more than an interruption.
    [[nodiscard]] int exit_code(bool interrupted) const;
    /// Reports to the user on stderr.
    void log(Verbosity verbosity) const;
    /// Reports that the user asked the program to end where nothing else says so: all was written.
    void log_interruption(Verbosity verbosity, bool interrupted) const;
};

} // namespace hemilux
