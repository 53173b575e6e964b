#pragma once
// The one place that opens files to be read. What can never end or would wait for ever is refused
// before it is opened: folders, devices, sockets and files that the kernel makes up (/proc). A pipe
// to which nobody writes is refused too.

#include <cstdint>
#include <functional>
#include <limits>
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

/// A function that is asked before an input takes so many bytes, and throws where they are too
/// many.
using InputGuard = std::function<void(const std::string& path, double bytes)>;

/// Sets what is asked by every function that reads a file, from now on and in all threads. A reader
/// whose result takes more than the file's own bytes asks for those itself.
void guard_inputs(InputGuard guard);
/// Asks whether an input may take so many bytes.
void ask_for_input(const std::string& path, double bytes);

/// A function that gets all that was read so far, again and again, and may throw to end the
/// reading.
using InputCheck = std::function<void(std::string_view content)>;

inline constexpr std::uint64_t whole_file = std::numeric_limits<std::uint64_t>::max();

/// Reads a whole file, or its first `most` bytes, for which it asks before it takes them. Throws
/// InputError, also where `check_input` would.
[[nodiscard]] std::string read_input(const std::string& path, InputKind kind,
                                     const InputCheck& check = {}, std::uint64_t most = whole_file);

} // namespace hemilux
