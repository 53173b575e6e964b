#pragma once
// The files that outputs are written to before they get their names: `.hemilux-PROCESS-NUMBER.tmp`
// in the output's folder. A killed process leaves its own behind; the next one that writes there
// removes them. A process that writes one holds a lock on it (flock), which ends with the process.
// So no file in use is ever taken, even where folders are shared with other machines or containers.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace hemilux {

struct TemporaryFile {
    std::string path;
    int descriptor = -1;        ///< open for writing; -1: errno says why not
    std::size_t slot = no_slot; ///< its place in the list of those that have no name yet
    static constexpr std::size_t no_slot = static_cast<std::size_t>(-1);
};

/// Makes a new temporary file; the user's umask takes rights away from the mode.
[[nodiscard]] TemporaryFile make_temporary(const std::filesystem::path& folder,
                                           unsigned mode = 0666);

/// Takes a file off the list once it has got its name or was removed.
void forget_temporary(const TemporaryFile& file);

/// Removes the temporary files on the list. It is safe in a signal handler, which ends the process.
void remove_listed_temporaries() noexcept;

[[nodiscard]] bool is_temporary_name(std::string_view name);

/// Removes the temporary files in the folder that no process holds. Files that cannot be read or
/// removed are left.
void remove_stale_temporaries(const std::filesystem::path& folder);

} // namespace hemilux
