#include "io/files/temporary_file.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <memory>
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

/// The list. A slot belongs to the file in it until that is forgotten; what it holds belongs to who
/// takes it out: the file's thread or a signal handler.
std::array<std::atomic<char*>, 64> listed{};
static_assert(std::atomic<char*>::is_always_lock_free, "a signal handler must not wait for a lock");

/// Returns the slot of a path. Where none is free, a file that is left behind stays until another
/// process cleans up.
std::size_t listed_as(const std::string& path) {
    auto copy = std::make_unique<char[]>(path.size() + 1);
    std::memcpy(copy.get(), path.c_str(), path.size() + 1);
    for (std::size_t slot = 0; slot < listed.size(); ++slot)
        if (char* none = nullptr; listed[slot].compare_exchange_strong(none, copy.get())) {
            (void)copy.release();
            return slot;
        }
    return TemporaryFile::no_slot;
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
            return {path};
        // Some file systems have no locks; there none is ever taken for stale either.
        ::flock(descriptor, LOCK_EX);
        if (has_name(descriptor))
            return {path, descriptor, listed_as(path)};
        ::close(descriptor);
    }
}

void forget_temporary(const TemporaryFile& file) {
    if (file.slot < listed.size())
        delete[] listed[file.slot].exchange(nullptr);
}

void remove_listed_temporaries() noexcept {
    for (std::atomic<char*>& slot : listed)
        if (const char* const path = slot.exchange(nullptr))
            ::unlink(path);
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
