#include "io/files/temporary_file.h"

#include <algorithm>
#include <atomic>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hemilux {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = ".hemilux-", suffix = ".tmp";

/// Returns a name that no other process or thread of this machine uses.
std::string new_name() {
    static std::atomic<unsigned> counter{0};
    return std::string(prefix) + std::to_string(::getpid()) + "-" +
           std::to_string(counter.fetch_add(1)) + std::string(suffix);
}

bool is_number(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// Returns whether the file still has its name: a process that took it for stale may have been
/// faster.
bool has_name(int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

void remove_if_stale(const fs::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0)
        return;
    struct stat status {};
    const bool own = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
                     status.st_uid == ::geteuid();
    if (own && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
        ::unlink(path.c_str());
    ::close(descriptor);
}

} // namespace

bool is_temporary_name(std::string_view name) {
    if (!name.starts_with(prefix) || !name.ends_with(suffix) ||
        name.size() < prefix.size() + suffix.size())
        return false;
    name.remove_prefix(prefix.size());
    name.remove_suffix(suffix.size());
    const std::size_t dash = name.find('-');
    return dash != std::string_view::npos && is_number(name.substr(0, dash)) &&
           is_number(name.substr(dash + 1));
}

TemporaryFile make_temporary(const fs::path& folder, unsigned mode) {
    for (;;) {
        const std::string path = (folder / new_name()).string();
        const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (descriptor < 0)
            return {path, -1};
        // Some file systems have no locks; there none is ever taken for stale either.
        ::flock(descriptor, LOCK_EX);
        if (has_name(descriptor))
            return {path, descriptor};
        ::close(descriptor);
    }
}

void remove_stale_temporaries(const fs::path& folder) {
    std::error_code error;
    const fs::path here = folder.empty() ? fs::path(".") : folder;
    for (fs::directory_iterator entry(here, error), end; !error && entry != end;
         entry.increment(error))
        if (is_temporary_name(entry->path().filename().string()))
            remove_if_stale(entry->path());
}

} // namespace hemilux
