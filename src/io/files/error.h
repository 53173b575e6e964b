#pragma once
// The ways in which files fail; the program turns them into exit codes 2, 3 and those of signals.

#include "io/files/printable.h"
#include "parallel/asked_to_end.h"

#include <cstddef>
#include <stdexcept>
#include <string>

namespace hemilux {

/// A file that cannot be used as input: what() is one line, "file:line: what was expected", or
/// "file: ...".
class InputError : public std::runtime_error {
  public:
    InputError(const std::string& file, std::size_t line, const std::string& message)
        : std::runtime_error(single_line(file + ":" + std::to_string(line) + ": " + message)) {}
    InputError(const std::string& file, const std::string& message)
        : std::runtime_error(single_line(file + ": " + message)) {}
};

/// A file that could not be written.
class OutputError : public std::runtime_error {
  public:
    OutputError(const std::string& file, const std::string& message)
        : std::runtime_error(single_line(file + ": " + message)) {}
};

} // namespace hemilux
