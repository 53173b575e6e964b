#pragma once
// The one place that opens files to be read. What can never end or would wait for ever is refused
// before it is opened: folders, devices, sockets and files that the kernel makes up (/proc). A pipe
// to which nobody writes is refused too.

#include <functional>
#include <string>
#include <string_view>

namespace hemilux {

enum class InputKind {
    regular, ///< a regular file only
    stream   ///< a pipe too, which can be read once
};

/// Throws InputError unless the path can be read as this kind.
void check_input(const std::string& path, InputKind kind);
[[nodiscard]] bool is_input(const std::string& path, InputKind kind);

/// A function that gets all that was read so far, again and again, and may throw to end the
/// reading.
using InputCheck = std::function<void(std::string_view content)>;

/// Reads a whole file. Throws InputError, also where `check_input` would.
[[nodiscard]] std::string read_input(const std::string& path, InputKind kind,
                                     const InputCheck& check = {});

} // namespace hemilux
