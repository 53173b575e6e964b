#pragma once
// The file that a path names. Two paths name one file where device and inode agree, whatever links,
// folders and spellings lead there. "-", /dev/stdout, /dev/fd/1 and /proc/self/fd/1 name what this
// process has open.

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hemilux {

/// The path that stands for standard output.
inline constexpr std::string_view standard_output = "-";

/// A file, a pipe, a socket or a terminal. Where it does not exist yet, device and inode are those
/// of its folder.
struct FileIdentity {
    std::uint64_t device = 0, inode = 0;
    std::string name; ///< name in its folder; empty where the file exists
    auto operator<=>(const FileIdentity&) const = default;
};

/// Returns the number of the descriptor of this process that a path names, whether or not it is
/// open, links being followed; empty for all other paths.
[[nodiscard]] std::optional<int> own_descriptor(const std::string& path);

/// Returns the identity of what is to be written. It is empty for devices that are no terminal, as
/// nothing is kept there, and if there is no folder.
[[nodiscard]] std::optional<FileIdentity> identity_of(const std::string& path);

/// Returns whether both paths name one pipe or device, which one of two readers alone would empty.
[[nodiscard]] bool is_same_stream(const std::string& a, const std::string& b);

/// Returns the path at which a new file would be made: a symbolic link whose target does not exist
/// is followed. Any other path is given back.
[[nodiscard]] std::string creation_path(const std::string& path);

} // namespace hemilux
