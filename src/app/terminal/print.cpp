#include "app/terminal/print.h"

#include "io/files/error.h"

#include <cerrno>
#include <cstdio>

namespace hemilux {

void print(const std::string& text) {
    const bool is_written =
        std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (!is_written && errno != EPIPE)
        throw OutputError("standard output", "cannot be written");
}

} // namespace hemilux
