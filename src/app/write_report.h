#pragma once
// Which files were written: one that fails does not keep the others from being written.

#include "app/settings.h"

#include <functional>
#include <string>
#include <vector>

namespace hemilux {

struct WriteReport {
    std::vector<std::string> written; ///< paths
    std::vector<std::string> failed;  ///< messages

    /// Calls `write` and notes whether it threw.
    void attempt(const std::string& path, const std::function<void()>& write);
    void add(const WriteReport& other);
    /// Tells the user.
    void say(Talk talk) const;
};

} // namespace hemilux
