#pragma once
// The ways in which the program ends, for the shell, and the errors that lead there. Bad input and
// failing output are thrown as InputError and OutputError (io/files/error.h).

#include <stdexcept>

namespace hemilux {

enum ExitCode : int {
    exit_done = 0,
    exit_usage = 1,
    exit_input = 2,
    exit_output = 3, ///< a file cannot be written, or the system failed
    exit_interrupted = 130,
    exit_terminated = 143
};

/// This error says that what the user asked for cannot be done, whatever the scene; what() says
/// what to write instead.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

} // namespace hemilux
