#include "io/atomic_file.h"

#include "io/error.h"
#include "io/temporary_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace hemilux {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_size = 1 << 16;

/// Once for each folder.
void clean(const fs::path& folder) {
    static std::mutex mutex;
    static std::set<fs::path> cleaned;
    const std::lock_guard lock(mutex);
    if (cleaned.insert(folder).second)
        remove_stale_temporaries(folder);
}

} // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status))
        throw OutputError(path, "is a folder");
    if (fs::is_regular_file(status))
        target_ = fs::canonical(path, error).string();
    if (error && status.type() != fs::file_type::not_found)
        throw OutputError(path, "cannot open: " + error.message());
    const bool replace = !fs::exists(status) || fs::is_regular_file(status);
    if (replace) {
        const fs::path folder = fs::path(target_).parent_path();
        clean(folder);
        TemporaryFile temporary = make_temporary(folder);
        temporary_ = std::move(temporary.path);
        descriptor_ = temporary.descriptor;
    } else {
        descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    }
    if (descriptor_ < 0)
        fail("open");
}

AtomicFile::~AtomicFile() {
    if (descriptor_ < 0)
        return;
    ::close(descriptor_);
    if (!temporary_.empty())
        ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
    buffer_ += bytes;
    if (buffer_.size() >= buffer_size)
        flush();
}

void AtomicFile::commit(Durable durable) {
    flush();
    if (durable == Durable::yes && !temporary_.empty() && ::fsync(descriptor_) != 0)
        fail("write");
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    const bool renamed =
        closed == 0 && (temporary_.empty() || ::rename(temporary_.c_str(), target_.c_str()) == 0);
    if (renamed) {
        if (durable == Durable::yes)
            sync_folder();
        return;
    }
    const int error = errno;
    if (!temporary_.empty())
        ::unlink(temporary_.c_str());
    errno = error;
    fail(closed == 0 ? "rename" : "write");
}

/// The new name too. Some file systems cannot do that for folders; the file itself is safe then.
void AtomicFile::sync_folder() const {
    const std::string parent = fs::path(target_).parent_path().string();
    const int folder =
        ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0)
        return;
    ::fsync(folder);
    ::close(folder);
}

void AtomicFile::flush() {
    std::string_view left = buffer_;
    while (!left.empty()) {
        const ssize_t written = ::write(descriptor_, left.data(), left.size());
        if (written >= 0)
            left.remove_prefix(static_cast<std::size_t>(written));
        else if (errno != EINTR)
            fail("write");
    }
    buffer_.clear();
}

void AtomicFile::fail(const char* action) const {
    throw OutputError(path_, std::string("cannot ") + action + ": " + std::strerror(errno));
}

void write_atomically(const std::string& path, std::string_view content) {
    AtomicFile file(path);
    file.write(content);
    file.commit();
}

} // namespace hemilux
